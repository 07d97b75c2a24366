"""Derivatives of a step against 60-digit reference values, and what is said where there is none."""

from __future__ import annotations

import math

import numpy as np
import pytest
from derivative_scenes import (
    CASES,
    ball_above_floor,
    golden_columns,
    numbers,
    relative_error,
    step_of,
)

import saltus
from saltus import BodyInertia, ModelBuilder, Pose, Smoothness

# Damping is in it: then all laws of the library are nodal_energy, and this is another map.
OTHER = {"double_pendulum_wall_discrete"}
SIMULTANEOUS = [name for name, case in CASES.items() if "selections" in case]


@pytest.mark.parametrize("name", sorted(CASES.keys() - OTHER))
def test_the_step_has_the_reference_derivative(name):
    case = CASES[name]
    stepper, end = step_of(case)
    assert relative_error(end.q, numbers(case["q_next"])) < 1e-14
    d = stepper.derivative()
    A = np.hstack([golden_columns(case, "q"), golden_columns(case, "p")])
    size = max(1.0, np.abs(A).max())
    # rounding: a few sums of products a step
    assert np.abs(d.A - A).max() < 1e-13 * size
    assert np.abs(d.qfrc - golden_columns(case, "u")).max() < 1e-13 * size
    h = golden_columns(case, "h").reshape(-1)
    assert np.abs(d.h - h).max() < 1e-13 * max(1.0, np.abs(h).max())
    if d.impacts:
        e = golden_columns(case, "e").reshape(-1)
        assert np.abs(d.restitution.sum(axis=1) - e).max() < 1e-13 * max(1.0, np.abs(e).max())
    for impact, golden in zip(d.impacts, case["impacts"], strict=True):
        assert impact.t == pytest.approx(float(golden["time"]), rel=1e-12)
        assert min(impact.depth, 1e12) == pytest.approx(min(float(golden["depth"]), 1e12), rel=1e-9)


def test_masses_are_chained_by_the_gradient_of_the_model():
    case = CASES["double_pendulum_wall_nodal"]
    stepper, _ = step_of(case)
    _, _, l1, l2, _ = numbers(case["theta"])
    golden = golden_columns(case, "theta")

    def ten(depth: float) -> np.ndarray:
        """Return d (m, m c, I) / d m of a ball of radius .05 below its joint."""
        ball = 0.4 * 0.05**2
        about = ball + depth * depth
        return np.array([1, 0, 0, -depth, about, 0, 0, about, 0, ball])

    names = [link.name for link in stepper.model.links]
    for row in range(4):
        covector = np.eye(4)[row]
        inertia = stepper.model_gradient(covector[:2], covector[2:]).inertia
        upper, lower = inertia[names.index("upper")], inertia[names.index("lower")]
        assert upper @ ten(l1) == pytest.approx(golden[row, 0], abs=1e-13)
        assert lower @ ten(l2) == pytest.approx(golden[row, 1], abs=1e-13)


@pytest.mark.parametrize("name", SIMULTANEOUS)
def test_every_order_has_its_selection(name):
    case = CASES[name]
    stepper, _ = step_of(case)
    golden = case["selections"]
    found = stepper.selections()
    pairs = [stepper.model.pair_name(k) for k in range(stepper.model.n_pairs)]
    orders = {tuple(pairs.index(p) for p in s.pairs): s.A for s in found}
    for each in golden:
        order = tuple(p for p in each["order"])
        A = np.hstack([numbers(each["d_q"]), numbers(each["d_p"])])
        matches = [o for o in orders if np.abs(orders[o] - A).max() < 1e-12 * np.abs(A).max()]
        assert matches, f"{order} of {list(orders)}"
    assert len(found) == len(golden)


@pytest.mark.parametrize("name", SIMULTANEOUS)
def test_a_direction_takes_the_order_of_trajectories_along_it(name):
    case = CASES[name]
    stepper, _ = step_of(case)
    for each in case["directions"]:
        dq, dp = numbers(each["direction"]).reshape(2, -1)
        q, p = stepper.directional(dq, dp)
        golden = np.concatenate([numbers(each["q_next"]), numbers(each["p_next"])])
        assert relative_error(np.concatenate([q, p]), golden) < 1e-12


@pytest.mark.parametrize(
    ("name", "verdict"),
    [
        ("chain3_mixed", Smoothness.smooth),
        ("cradle_with_gaps", Smoothness.smooth),
        ("corner_pi_2", Smoothness.smooth),
        ("cradle_touching_100", Smoothness.one_sided),
        ("cradle_touching_2_02_-1", Smoothness.selection),
        ("corner_pi_3", Smoothness.selection),
    ],
)
def test_the_verdict(name, verdict):
    stepper, _ = step_of(CASES[name])
    assert stepper.derivative().smoothness == verdict


def test_the_spread_of_selections_is_that_of_their_matrices():
    stepper, _ = step_of(CASES["cradle_touching_2_02_-1"])
    own, other = (selection.A for selection in stepper.selections())
    spread = np.abs(own - other).max() / np.abs(own).max()
    (impact,) = stepper.derivative().impacts
    assert impact.spread == pytest.approx(spread, rel=1e-12)
    assert 0.02 < spread < 0.03  # 2.3e-2 at tau = .03


def test_masses_that_are_no_coxeter_group_depend_on_the_order():
    builder = ModelBuilder().set_gravity((0, 0, 0))
    for i, (x, mass) in enumerate(((-0.3, 1.0), (0.0, 0.5), (0.3, 1.0))):
        at = Pose((x, 0, 0))
        builder.add_body(f"b{i}", saltus.Sphere(0.1), mass=mass, X=at, joint="prismatic")
    stepper = saltus.Stepper(builder.build(), h=0.2, record=True)
    stepper.advance(stepper.model.state(v=[1.0, 0.0, -1.0]))
    assert stepper.derivative().smoothness == Smoothness.order_dependent


def test_a_slow_impact_grazes():
    """A ball thrown up just reaches the ceiling: depth u^2 / 2 g is 50 times what touches."""
    builder = ModelBuilder().add_half_space("ceiling", (0, 0, -1), -1.0)
    builder.add_body("ball", saltus.Sphere(0.1), mass=1.0, joint="prismatic", axis=(0, 0, 1))
    u, t, g = 1e-4, 0.01, 9.81
    # it falls from there on: a longer step would not see it touch
    stepper = saltus.Stepper(builder.build(), h=t + u / (2 * g), record=True)
    start = stepper.model.state(q=[0.9 - u * t - g * t * t / 2], v=[g * t + u])
    stepper.advance(start)
    (impact,) = stepper.report.impacts
    assert impact.t == pytest.approx(t, rel=1e-6)
    d = stepper.derivative()
    assert d.smoothness == Smoothness.grazing
    assert d.impacts[0].depth == pytest.approx(u * u / (2 * g), rel=1e-6)
    # large, and right: it comes dq / u sooner, with g dq / u more to turn round
    assert d.A[1, 0] == pytest.approx(-2 * g / u, rel=1e-6)


def test_the_height_after_a_bounce_is_continuous_in_the_drop_height():
    builder = ModelBuilder().add_half_space("floor", (0, 0, 1))
    builder.add_body("ball", saltus.Sphere(0.1), mass=1.0, joint="prismatic", axis=(0, 0, 1))
    model = builder.set_default_contact(restitution=0.9).build()
    stepper = saltus.Stepper(model, h=0.01)

    def height(drop: float) -> float:
        state = model.state(q=[0.1 + drop])
        for _ in range(60):
            state = stepper.advance(state)
        return float(state.q[0])

    # slope 2.5 or so: 1e-9 m of drop change the height by no more, whatever step the impact is in
    drops = np.linspace(1.0, 1.1, 101)
    assert max(abs(height(x + 1e-9) - height(x)) for x in drops) < 1e-8


def test_held_contacts_stay_on_their_surface():
    """A ball without friction on a slope, that a motor along the slope pushes."""
    builder = ModelBuilder().add_half_space("slope", (math.sin(0.3), 0, math.cos(0.3)))
    builder.add_body("ball", saltus.Sphere(0.1), mass=1.0, joint="floating")
    model = builder.set_default_contact(restitution=0.5).build()
    stepper = saltus.Stepper(model, h=0.01, record=True)
    n, t = np.array([math.sin(0.3), 0, math.cos(0.3)]), np.array([math.cos(0.3), 0, -math.sin(0.3)])
    q = np.concatenate([0.1 * n, [0, 0, 0, 1]])
    state = stepper.advance(saltus.State(0.0, q, np.zeros(6)))
    assert stepper.report.sustained == 1
    d = stepper.derivative()
    assert d.smoothness == Smoothness.smooth
    along, across = np.concatenate([t, np.zeros(3)]), np.concatenate([n, np.zeros(3)])
    zero = np.zeros(6)
    # along the slope it moves as if it were free, across it not at all
    np.testing.assert_allclose(
        np.concatenate(stepper.jvp(along, zero)), [*along, *zero], atol=1e-12
    )
    np.testing.assert_allclose(
        np.concatenate(stepper.jvp(zero, along)), [*(0.01 * along), *along], atol=1e-12
    )
    np.testing.assert_allclose(np.concatenate(stepper.jvp(zero, across)), 0, atol=1e-12)
    assert state.q[:3] @ n == pytest.approx(0.1, abs=1e-12)


def test_a_limit_that_is_held_holds_its_derivative():
    builder = ModelBuilder()
    builder.add_link("arm", BodyInertia(1, (0.5, 0, 0), 0.1 * np.eye(3)))
    builder.add_joint(
        "shoulder", "revolute", parent="world", child="arm", axis=(0, 1, 0), lower=-1, upper=0.2
    )
    model = builder.build()
    stepper = saltus.Stepper(model, h=0.01, record=True)
    stepper.advance(model.state(q=[0.2]))
    assert stepper.report.sustained == 1
    np.testing.assert_allclose(stepper.derivative().A, 0, atol=1e-13)


def test_nothing_is_recorded_unasked_and_errors_say_so():
    model = saltus.load_urdf(saltus.scenes.chain(1))
    stepper = saltus.Stepper(model)
    stepper.advance(model.state())
    with pytest.raises(saltus.ModelError, match="record=True"):
        stepper.derivative()
    stepper = saltus.Stepper(model, record=True)
    with pytest.raises(saltus.ModelError, match="advance comes first"):
        stepper.jvp()
    stepper.advance(model.state())
    with pytest.raises(saltus.ModelError, match="dq"):
        stepper.jvp(dq=[1, 2, 3])


def test_a_recording_stepper_makes_the_same_steps():
    model = saltus.load_urdf(saltus.urdf_dir() / "newtons_cradle_3.urdf")
    plain, recording = saltus.Stepper(model), saltus.Stepper(model, record=True)
    state = other = model.state(q={"swing_0": 0.3})
    for _ in range(60):
        state, other = plain.advance(state), recording.advance(other)
        assert state == other


def test_what_is_not_differentiated_is_named():
    def refused(model, state, words, law="nodal_energy", **forces):
        stepper = saltus.Stepper(model, law=law, record=True)
        stepper.advance(state, **forces)
        with pytest.raises(saltus.ModelError, match=words):
            stepper.derivative()
        with pytest.raises(saltus.ModelError, match=words):  # and again: nothing half done is left
            stepper.vjp(np.zeros(model.n_v), np.zeros(model.n_v))

    def law(problem):
        return problem.p - 2 * problem.N.T @ np.linalg.solve(
            problem.N @ np.linalg.solve(problem.M, problem.N.T), problem.u
        )

    model = ball_above_floor(CASES["bouncing_ball"])
    refused(model, saltus.State(0.0, [0.101], [-3.0]), "law of your own", law=law)
    refused(model, saltus.State(0.0, [0.101], [-3.0]), "law compensated", law="compensated")


def test_forces_that_are_functions_tell_their_slopes_and_no_time():
    def build(told: bool) -> saltus.Model:
        def spring(now):
            Q = [-3.0 * now.q[0]]
            return (Q, [[-3.0]], [[0.0]]) if told else Q

        builder = saltus.read_urdf(saltus.scenes.chain(1))
        return builder.add_force("spring", spring, coordinates=[builder.joint_names[-1]]).build()

    stepper = saltus.Stepper(build(False), record=True)
    stepper.advance(stepper.model.state())
    with pytest.raises(saltus.ModelError, match='force "spring" does not tell'):
        stepper.derivative()
    stepper = saltus.Stepper(build(True), record=True)
    stepper.advance(stepper.model.state())
    d = stepper.derivative()
    assert d.h.size == 0
    with pytest.raises(saltus.ModelError, match="function of time"):
        stepper.jvp(dh=1.0)
