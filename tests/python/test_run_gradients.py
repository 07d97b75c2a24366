"""Gradients of runs by what their actuators have; of long ones, whose tapes are kept in parts."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest

import saltus
from saltus import ModelBuilder

NUMBERS = {"drive": (0.7, 0.05, -3.0, -0.2), "tie": (1.3, -0.1, -2.0, -0.4)}
CONTROL = [0.9, -0.4]


def arm(numbers: dict[str, tuple[float, ...]], *, effort: float = 1e3) -> saltus.Model:
    """Return two links in the air: one actuator of one joint, one of both through gears."""
    builder = saltus.read_urdf(saltus.scenes.chain(2))
    upper, lower = builder.joint_names[-2:]
    for name, joints in (("drive", {upper: 2.0}), ("tie", {upper: -0.5, lower: 1.5})):
        gain, *bias = numbers[name]
        builder.add_actuator(name, joints=joints, gain=gain, bias=bias, effort=effort)
    return builder.build()


def run(model: saltus.Model) -> saltus.Trajectory:
    # p of the start is 0 whatever the actuators have
    return saltus.simulate(
        model, [0.3, -0.2], duration=0.3, h=0.02, control=CONTROL, progress=False
    )


def end(model: saltus.Model) -> float:
    made = run(model)
    return float(made.q[-1] @ [1.0, -0.5] + made.p[-1] @ [0.3, 0.8])


@pytest.mark.parametrize("name", NUMBERS)
@pytest.mark.parametrize("column", range(4))
def test_a_run_is_differentiated_by_its_actuators(name, column):
    g = run(arm(NUMBERS)).gradient([1.0, -0.5], [0.3, 0.8])

    def cost(x: float) -> float:
        numbers = list(NUMBERS[name])
        numbers[column] += x
        return end(arm(NUMBERS | {name: tuple(numbers)}))

    h = 1e-3  # fourth order: truncation 1e-12, rounding 1e-12
    slope = (8 * (cost(h) - cost(-h)) - cost(2 * h) + cost(-2 * h)) / (12 * h)
    row = list(NUMBERS).index(name)
    assert g.actuators.shape == (2, 4)
    assert abs(slope) > 1e-4
    assert g.actuators[row, column] == pytest.approx(slope, rel=1e-8)


def test_what_pushes_all_it_can_does_not_depend_on_its_gains():
    g = run(arm(NUMBERS, effort=1e-3)).gradient([1.0, -0.5], [0.3, 0.8])
    np.testing.assert_array_equal(g.actuators, 0)


def cart(kp: float, kd: float) -> saltus.Model:
    """Return a cart that a servo holds as a spring and a damper do."""
    builder = ModelBuilder().add_body(
        "cart", saltus.Sphere(0.1), mass=2.0, joint="prismatic", axis=(1, 0, 0)
    )
    return builder.add_position_servo("servo", joint="cart", kp=kp, kd=kd).build()


def test_a_position_servo_by_its_gains():
    def last(kp: float, kd: float) -> saltus.Trajectory:
        return saltus.simulate(cart(kp, kd), duration=1.0, h=0.05, control=[0.7], progress=False)

    (row,) = last(5.0, 0.8).gradient([1.0], [0.0]).actuators

    def slope(dp: float, dd: float) -> float:
        def at(x: float) -> float:
            return float(last(5.0 + x * dp, 0.8 + x * dd).q[-1, 0])

        h = 1e-3
        return (8 * (at(h) - at(-h)) - at(2 * h) + at(-2 * h)) / (12 * h)

    assert row[0] - row[2] == pytest.approx(slope(1, 0), rel=1e-8)
    assert -row[3] == pytest.approx(slope(0, 1), rel=1e-8)


def test_a_run_of_more_steps_than_tapes_are_kept():
    """5000 linear steps: the gradient is that of a power of one step's matrix."""
    model, steps, h = cart(5.0, 0.0), 5000, 0.02
    stepper = saltus.Stepper(model, h=h, record=True)
    stepper.advance(model.state(q=[0.3]))
    A = np.linalg.matrix_power(stepper.derivative().A, steps)
    made = saltus.simulate(model, [0.3], duration=steps * h, h=h, progress=False)
    g = made.gradient([1.0], [0.5])
    # rounding of 5000 steps, and of the power: 5000 eps and some
    np.testing.assert_allclose([g.q[0], g.p[0]], [1.0, 0.5] @ A, rtol=1e-11)


def assert_same(g: saltus.RunGradient, full: saltus.RunGradient, rtol: float) -> None:
    """Compare all but what is by row."""
    for name in ("q", "p", "inertia", "damping", "actuators", "stiffness", "armature"):
        x, expected = getattr(g, name), getattr(full, name)
        np.testing.assert_allclose(x, expected, rtol=0, atol=rtol * np.abs(expected).max())
    assert g.h == pytest.approx(full.h, rel=rtol)
    for name, by_e in full.restitution.items():
        assert g.restitution[name] == pytest.approx(by_e, rel=rtol)


def hitting_arm() -> saltus.Model:
    """Return a driven arm of two links between two walls."""
    builder = saltus.read_urdf(saltus.scenes.chain(2))
    builder.add_shape(builder.link_names[-1], saltus.Sphere(0.05), saltus.Pose((0, 0, -0.5)))
    for name, side in (("left", 1.0), ("right", -1.0)):
        builder.add_half_space(name, (side, 0, 0), -0.25)
    for joint in builder.joint_names[-2:]:
        builder.add_motor(f"motor of {joint}", joint=joint)
        builder.set_damping(joint, 0.2)
    return builder.set_default_contact(restitution=0.7, friction=0).build()


# 203 steps: the last rows are fewer steps apart
@pytest.mark.parametrize("every", [2, 7, 50, 203, 500])
def test_rows_some_steps_apart_have_the_same_gradient(every):
    model, h, steps = hitting_arm(), 0.01, 203
    control = np.random.default_rng(3).normal(size=(steps, 2))
    arguments = {"duration": steps * h, "h": h, "control": control, "progress": False}
    start = model.state([0.9, 0.3])
    full, sparse = (
        saltus.simulate(model, state=start, record_every=k, **arguments) for k in (1, every)
    )
    assert len(full.impacts) >= 2
    parts = -(-steps // every)
    assert len(sparse) == parts + 1
    by_q, by_p = np.random.default_rng(4).normal(size=(2, parts + 1, 2))
    at = np.minimum(np.arange(parts + 1) * every, steps)
    rows = np.zeros((2, steps + 1, 2))
    rows[0, at], rows[1, at] = by_q, by_p
    g, expected = sparse.gradient(by_q, by_p, control=control), full.gradient(*rows)
    # rounding, where a part starts without the guesses of steps before
    assert_same(g, expected, 1e-12)
    np.testing.assert_allclose(g.control, expected.control, atol=1e-12 * abs(g.control).max())
    sums = np.add.reduceat(expected.qfrc, at[:-1])
    np.testing.assert_allclose(g.qfrc, sums, atol=1e-12 * np.abs(sums).max())


def test_controls_that_are_held_from_row_to_row_need_not_be_told():
    model, every = arm(NUMBERS), 8
    arguments = {"duration": 0.64, "h": 0.02, "progress": False}

    def policy(state: saltus.State) -> list[float]:
        return [0.5 + state.t, -0.3]

    made = saltus.simulate(
        model, [0.3, -0.2], control=policy, control_every=every, record_every=every, **arguments
    )
    g = made.gradient([1.0, -0.5], [0.3, 0.8])
    assert g.control.shape == (4, 2)
    held = np.repeat(made.control[:-1], every, axis=0)
    full = saltus.simulate(model, [0.3, -0.2], control=held, **arguments)
    expected = full.gradient([1.0, -0.5], [0.3, 0.8])
    assert_same(g, expected, 1e-12)
    by_step = expected.control.reshape(4, every, 2).sum(axis=1)
    np.testing.assert_allclose(g.control, by_step, rtol=1e-12)
    others = saltus.simulate(model, [0.3, -0.2], control=policy, record_every=every, **arguments)
    with pytest.raises(saltus.ModelError, match=r"step 7 made again .* control, forces or qfrc"):
        others.gradient([1.0, -0.5], [0.3, 0.8])


def test_rows_that_tell_no_steps():
    model = arm(NUMBERS)
    rows = np.zeros((4, 2))
    made = saltus.Trajectory.from_states(model, [0.0, 0.1, 0.15, 0.5], rows, h=0.05)
    with pytest.raises(saltus.ModelError, match="not as many steps apart; derivatives need rows"):
        made.gradient([1.0, 0.0], [0.0, 0.0])
    made = run(model)
    with pytest.raises(saltus.ModelError, match="control is 3 by 2; it is 15 by 2, a row for each"):
        made.gradient([1.0, 0.0], [0.0, 0.0], control=np.zeros((3, 2)))


def test_more_steps_between_two_rows_than_tapes_are_kept():
    model, steps, h = cart(5.0, 0.3), 10_000, 0.002
    arguments = {"duration": steps * h, "h": h, "control": [0.7], "progress": False}
    full, ends = (saltus.simulate(model, [0.3], record_every=k, **arguments) for k in (1, steps))
    assert len(ends) == 2
    assert_same(ends.gradient([1.0], [0.5]), full.gradient([1.0], [0.5]), 1e-12)


LONG = """
import resource, saltus
model = saltus.load_urdf(saltus.scenes.chain(2))
arguments = dict(h=1e-3, record_every=20000, progress=False)
short = saltus.simulate(model, [0.1, 0.2], duration=1e-3 * 20000, **arguments)
short.gradient([1.0, 0.0], [0.0, 0.0])
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
run = saltus.simulate(model, [0.1, 0.2], duration=1e-3 * 200000, **arguments)
run.gradient([1.0, 0.0], [0.0, 0.0])
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)
"""


def test_a_long_run_takes_no_more_memory_than_a_short_one():
    told = subprocess.run(  # in its own process: memory that others took is no matter
        [sys.executable, "-c", LONG], check=True, capture_output=True, text=True
    )
    assert int(told.stdout) < 2000  # kB, of ten times the steps; tapes of all would be 480 MB
