"""What stands still costs nothing, and nothing that moves is taken for it."""

from __future__ import annotations

import numpy as np
import pytest

import saltus

H, G = 0.01, 9.81
HALF = (0.2, 0.15, 0.1)


def tower(count: int) -> saltus.ModelBuilder:
    builder = saltus.ModelBuilder("tower").add_floor()
    builder.set_default_contact(restitution=0.0, friction=0.5)
    for i in range(count):
        X = saltus.Pose((0, 0, 0.1 * (2 * i + 1)))
        builder.add_body(f"box_{i}", saltus.Box(HALF), mass=1.0, X=X, joint_name=f"free_{i}")
    return builder


def stood(model: saltus.Model, steps: int = 60) -> tuple[saltus.Stepper, saltus.State]:
    """Return a stepper whose bodies stand still."""
    stepper, state = saltus.Stepper(model, H), model.state()
    for _ in range(steps):
        state = stepper.advance(state)
    assert stepper.report.iterations == 0
    return stepper, state


def test_a_tower_comes_to_stand_to_the_last_bit_and_its_report_goes_on():
    model = tower(10).build()
    stepper, state = stood(model)
    np.testing.assert_array_equal(state.p, 0)
    np.testing.assert_allclose(state.q, model.state().q, rtol=0, atol=1e-14)  # rounding till then
    before = state
    for _ in range(1000):
        state = stepper.advance(state)
    np.testing.assert_array_equal(state.q, before.q)
    np.testing.assert_array_equal(state.p, 0)
    assert state.t == pytest.approx(before.t + 1000 * H, abs=1e-9)  # 1000 roundings of the sum
    floor = sum(c.impulse for c in stepper.report.contacts if "floor" in c.pair)
    assert floor == pytest.approx(10 * G * H, rel=1e-12)
    assert stepper.report.arcs == 1
    assert not stepper.report.impacts


def test_a_push_wakes_it_as_if_it_had_never_stood():
    model = tower(3).build()
    stepper, state = stood(model)
    push = np.zeros(model.n_v)
    push[model.velocity_names.index("free_2_vx")] = 3.0  # below what friction holds, and then above
    for force in (push, 3 * push):
        fresh = saltus.Stepper(model, H).advance(state, qfrc=force)
        woken = stepper.advance(state, qfrc=force)
        np.testing.assert_allclose(woken.q, fresh.q, rtol=0, atol=1e-14)  # rounding
        np.testing.assert_allclose(woken.p, fresh.p, rtol=0, atol=1e-13)
        assert stepper.report.iterations > 0
    assert woken.q[model.coordinate_names.index("free_2_x")] > 1e-6


def test_another_state_wakes_it():
    model = tower(2).build()
    stepper, state = stood(model)
    other = model.state(v={"free_1_vx": 0.1})
    other = saltus.State(t=state.t, q=state.q, p=other.p)
    after = stepper.advance(other)
    expected = saltus.Stepper(model, H).advance(other)
    np.testing.assert_allclose(after.q, expected.q, rtol=0, atol=1e-14)
    assert after.q[model.coordinate_names.index("free_1_x")] > 1e-4


def test_beside_one_that_moves_it_stands_with_the_same_bits():
    alone = tower(3).build()
    builder = tower(3)
    X = saltus.Pose((5, 0, 2))
    builder.add_body("ball", saltus.Sphere(0.1), mass=1.0, X=X, joint_name="ball_free")
    both = builder.build()
    _, state = stood(alone)
    stepper, beside = saltus.Stepper(both, H), both.state()
    for _ in range(60):
        beside = stepper.advance(beside)
        assert stepper.report.iterations > 0
    n = alone.n_q
    np.testing.assert_array_equal(beside.p[: alone.n_v], 0)
    np.testing.assert_allclose(beside.q[:n], state.q, rtol=0, atol=1e-14)
    at = beside.q[:n].copy()
    for _ in range(60):
        beside = stepper.advance(beside)
    np.testing.assert_array_equal(beside.q[:n], at)


@pytest.mark.parametrize("speed", [1e-13, 1e-15, 1e-16])
def test_what_rolls_ever_so_slowly_goes_on(speed):
    """From x = 0, where 1e-18 m are not rounded away."""
    builder = saltus.ModelBuilder("ball").add_floor()
    builder.set_default_contact(restitution=0.0, friction=0.0)
    builder.add_body("ball", saltus.Sphere(0.1), mass=1.0, X=saltus.Pose((0, 0, 0.1)))
    model = builder.build()
    x = next(i for i, name in enumerate(model.coordinate_names) if name.endswith("_x"))
    name = next(name for name in model.velocity_names if name.endswith("_vx"))
    stepper, state = saltus.Stepper(model, H), model.state(v={name: speed})
    for _ in range(200):
        state = stepper.advance(state)
    assert state.q[x] == pytest.approx(200 * H * speed, rel=1e-12)


@pytest.mark.parametrize("offset", [1e-9, 1e-12, 1e-14])
def test_what_begins_to_fall_falls(offset):
    """The angle of a rod on its end grows as cosh(w t), also on a plate that rests."""
    builder = saltus.ModelBuilder("rod on a plate").add_floor()
    builder.set_default_contact(restitution=0.0, friction=0.8)
    X = saltus.Pose((0, 0, 0.05))
    builder.add_body("plate", saltus.Box((0.5, 0.5, 0.05)), mass=50.0, X=X)
    builder.add_link("rod", saltus.BodyInertia(0.1, (0, 0, 0.5), np.eye(3) * 0.1 / 12))
    builder.add_joint("hinge", "revolute", parent="plate", child="rod", axis=(0, 1, 0))
    model = builder.build()
    stepper, state = saltus.Stepper(model, H), model.state({"hinge": offset})
    hinge, count = model.coordinate_names.index("hinge"), 300
    for _ in range(count):
        state = stepper.advance(state)
    w = np.sqrt(G * 0.5 / (0.25 + 1 / 12))
    # the plate rests, so that the angle follows the pendulum's midpoint rule
    rate = 2 / H * np.arctanh(w * H / 2)
    assert state.q[hinge] == pytest.approx(offset * np.cosh(rate * count * H), rel=2e-2)


def test_a_force_of_time_is_never_slept_through():
    """A gust that comes after a second finds the box awake."""
    builder = tower(1)

    def gust(now):
        return [20.0 if now.t > 1 else 0.0]

    model = builder.add_force("gust", gust, coordinates=["free_0_vx"]).build()
    stepper, state = saltus.Stepper(model, H), model.state()
    for _ in range(130):
        state = stepper.advance(state)
    t = 130 * H - 1  # it pushes 20 N against friction of 9.81 N / 2
    assert state.q[model.coordinate_names.index("free_0_x")] == pytest.approx(
        (20 - G / 2) * t**2 / 2, rel=0.1
    )


def test_a_robot_that_stands_wakes_with_its_control():
    """A servo holds a mast on a heavy base; the target moves after it has stood."""
    builder = saltus.ModelBuilder("mast").add_floor()
    builder.set_default_contact(restitution=0.0, friction=0.8)
    builder.add_body("base", saltus.Box((0.5, 0.5, 0.05)), mass=50.0, X=saltus.Pose((0, 0, 0.05)))
    builder.add_link("mast", saltus.BodyInertia(0.1, (0, 0, 0.2), np.eye(3) * 1e-3))
    builder.add_joint("hinge", "revolute", parent="base", child="mast", axis=(0, 1, 0))
    builder.add_position_servo("servo", joint="hinge", kp=20.0, kd=2.0)
    model = builder.build()
    stepper, state = saltus.Stepper(model, H), model.state()
    idle = 0
    for _ in range(400):
        state = stepper.advance(state, control=[0.0])
        idle += stepper.report.iterations == 0
    assert idle > 100
    for _ in range(400):
        state = stepper.advance(state, control=[0.2])
    hinge = state.q[model.coordinate_names.index("hinge")]
    # the servo's torque is the weight's: k (0.2 - q) + m g l sin q = 0
    assert 20 * (0.2 - hinge) + 0.1 * G * 0.2 * np.sin(hinge) == pytest.approx(0, abs=1e-6)
