"""Where models rest: known answers, limits, loops, and what has no rest."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.python.test_forces import H, arm, pendulum
from tests.python.test_loops import four_bar

import saltus
from saltus import At, ModelBuilder, ModelError

# 1e-12: Newton's method ends where a step is shorter
CLOSE = 1e-11


def test_a_pendulum_hangs_wherever_it_starts() -> None:
    model = pendulum().build()
    for start in (0.3, -2.0, 3.0):
        assert saltus.equilibrium(model, [start]).q[0] == pytest.approx(0, abs=CLOSE)
    state = saltus.equilibrium(model, [0.3])
    run = saltus.simulate(model, state=state, duration=1.0, h=H)
    assert np.abs(run.q).max() < 1e-10
    with pytest.raises(ModelError, match=r"is no minimum: swing would fall away"):
        saltus.equilibrium(model, [math.pi])


def test_a_servo_sags_by_the_torque_over_its_gain() -> None:
    builder = pendulum().add_position_servo("hold", joint="swing", kp=40.0, kd=1.0)
    model = builder.build()
    q = saltus.equilibrium(model, control={"hold": 1.0}).q[0]
    assert 40 * (1.0 - q) == pytest.approx(9.81 * math.sin(q), rel=1e-12)
    # a servo with too little effort gives way until the weight is as little
    builder = pendulum().add_position_servo("hold", joint="swing", kp=400.0, effort=5.0)
    q = saltus.equilibrium(builder.build(), control=[3.0]).q[0]
    assert 9.81 * math.sin(q) == pytest.approx(5.0, rel=1e-12)


def test_an_arm_rests_on_springs() -> None:
    builder = arm().add_joint_spring("shoulder", stiffness=50.0, rest=0.4)
    builder.add_spring("rope", a=At("lower", (0.8, 0, 0)), b="world", stiffness=30.0, length=0.5)
    model = builder.build()
    state = saltus.equilibrium(model, [0.2, 0.5])
    forces = model.lagrangian(state.q, np.zeros(2)).L_q
    np.testing.assert_allclose(forces, 0, atol=1e-9)
    step = saltus.Stepper(model, H).advance(state)
    np.testing.assert_allclose(step.q, state.q, rtol=0, atol=1e-11)


def test_a_limit_bears_what_it_stops() -> None:
    model = pendulum(lower=0.5, upper=2.0).build()
    assert saltus.equilibrium(model, [1.5]).q[0] == pytest.approx(0.5, abs=1e-9)


@pytest.mark.parametrize("start", [(0.3, 0.4), (-0.9, 0.9), (0.9, -0.9), (0.0, 0.0)])
def test_two_rods_between_their_stops(start: tuple[float, float]) -> None:
    """Level rods fall: the first onto its stop at -1, the second hangs down, at pi / 2 - 1 less."""
    model = arm().set_limit("shoulder", -1.0, 1.0).set_limit("elbow", -1.0, 1.0).build()
    q = saltus.equilibrium(model, start).q
    np.testing.assert_allclose(q, [-1.0, 1.0 - math.pi / 2], rtol=0, atol=1e-9)


def test_a_four_bar_hangs_where_its_potential_is_least() -> None:
    model = four_bar().build()
    state = saltus.equilibrium(model, [1.0, -0.5, -2.0])
    assert np.abs(model.loop_gaps(state.q)["pin"]).max() < 1e-12
    V = model.potential_energy(state.q)
    for turn in (-1e-3, 1e-3):
        start = state.q + np.array([turn, 0, 0])
        beside = saltus.close_loops(model, start, keep=["joint_0"]).q
        assert model.potential_energy(beside) > V
    run = saltus.simulate(model, q=state.q, duration=1.0, h=H)
    assert np.abs(run.q - state.q).max() < 1e-8
    kept = saltus.equilibrium(model, state.q + np.array([0.1, 0, 0]), keep=["joint_0"])
    assert kept.q[0] == pytest.approx(state.q[0] + 0.1, abs=1e-15)


def test_what_nothing_holds_has_no_rest() -> None:
    model = ModelBuilder().add_body("stone", saltus.Sphere(0.1), mass=1.0).build()
    with pytest.raises(ModelError, match="may have nothing that holds it"):
        saltus.equilibrium(model)
    with pytest.raises(ModelError, match="no actuator"):
        saltus.equilibrium(model, control={"lift": 9.81})


def test_a_ball_joint_finds_the_lowest_place() -> None:
    builder = ModelBuilder("bell").add_link(
        "bell", saltus.BodyInertia(1, (0.1, 0, -0.5), 0.01 * np.eye(3))
    )
    builder.add_joint("hook", "spherical", parent="world", child="bell")
    model = builder.build()
    q = model.random_configuration(np.random.default_rng(3))
    state = saltus.equilibrium(model, q)
    centre = model.pose(state.q, "bell").R @ [0.1, 0, -0.5]
    np.testing.assert_allclose(centre[:2], 0, atol=1e-10)
    assert centre[2] < 0
