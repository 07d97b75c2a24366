"""Derivatives of steps with loops, couplings and prescribed joints: against whole steps."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from test_step_derivatives_friction import difference
from test_step_derivatives_random import random_inertia

import saltus
from saltus import At, ModelBuilder, Pose, State

Array = np.ndarray
ZERO = np.zeros(3)
Build = Callable[[Mapping[str, Array]], saltus.Model]


def two_arms(tie: str) -> Build:
    """Return two arms of three joints each, on one base, that a loop ties together."""

    def build(places: Mapping[str, Array]) -> saltus.Model:
        random = np.random.default_rng(11)
        builder = ModelBuilder("arms").set_gravity((1.0, -2.0, -9.0))
        builder.add_link("base", random_inertia(random))
        builder.add_joint("j_base", "prismatic", parent="world", child="base", axis=(1, 0.2, 0.1))
        for side, x in (("left", -0.4), ("right", 0.4)):
            parent = "base"
            for name, kind in (("upper", "spherical"), ("lower", "revolute"), ("tip", "prismatic")):
                link, joint = f"{side}_{name}", f"j_{side}_{name}"
                builder.add_link(link, random_inertia(random))
                at = np.array([x, 0.1, 0]) if parent == "base" else np.array([0.05, 0.1, -0.5])
                X = Pose(at + places.get(joint, ZERO))
                axis = random.normal(size=3)
                builder.add_joint(joint, kind, parent=parent, child=link, X_PJ=X, axis=axis)
                parent = link
        builder.add_position_servo("servo", joint="j_left_lower", kp=10, kd=1)
        turn = Rotation.from_rotvec((0.3, -0.2, 0.4)).as_matrix()
        a, b = At("left_tip", (0.1, 0, -0.1), R=turn), At("right_tip", (-0.1, 0.05, 0))
        if tie == "coupling":
            builder.add_coupling("j_left_lower", of="j_right_lower", polynomial=[0.1, -0.8, 0.3])
        elif tie == "prescribed":
            builder.set_prescribed("j_left_tip", function=lambda t: (0.1 + 0.3 * t * t, 0.6 * t))
        else:
            more = {"distance": 0.5} if tie == "distance" else {}
            builder.add_loop("tie", tie, a=a, b=b, **more)
        return builder.build()

    return build


TIES = ("point", "weld", "distance", "on_plane", "coupling", "prescribed")


def near(model: saltus.Model, x: float, seed: int = 0) -> State:
    """Return a closed state, x along a curve of such states."""
    random = np.random.default_rng(seed)
    q = model.integrate(model.neutral(), 0.3 * random.normal(size=model.n_v))
    v, dq, dv = random.normal(size=(3, model.n_v))
    return saltus.close_loops(model, model.integrate(q, x * dq), v + x * dv)


def rows(model: saltus.Model, origin: State, x: State) -> Array:
    return np.concatenate([model.difference(origin.q, x.q), x.p])


@pytest.mark.parametrize("tie", TIES)
def test_a_step_by_its_start(tie):
    model = two_arms(tie)({})
    start = near(model, 0.0)
    control = [0.3]
    stepper = saltus.Stepper(model, h=0.01, record=True)
    end = stepper.advance(start, control=control)
    along = difference(lambda x: rows(model, start, near(model, x)), 1e-3)
    dq, dp = along[: model.n_v], along[model.n_v :]
    forwards = np.concatenate(stepper.jvp(dq, dp))

    def moved(x: float) -> Array:
        after = saltus.Stepper(model, h=0.01).advance(near(model, x), control=control)
        return rows(model, end, after)

    expected = difference(moved, 1e-3)
    # loops are closed to 1e-15 and steps to 1e-12, over 1e-3
    assert np.abs(forwards - expected).max() < 1e-8 * np.abs(expected).max()
    A = stepper.derivative().A
    np.testing.assert_allclose(A @ along, forwards, atol=1e-12 * np.abs(forwards).max())


@pytest.mark.parametrize("tie", TIES)
def test_a_product_backwards_is_the_transpose(tie):
    model = two_arms(tie)({})
    stepper = saltus.Stepper(model, h=0.01, record=True)
    stepper.advance(near(model, 0.0), control=[0.3])
    dq, dp, dqfrc, by_q, by_p = np.random.default_rng(3).normal(size=(5, model.n_v))
    forwards = np.concatenate(stepper.jvp(dq, dp, [0.7], dqfrc=dqfrc))
    back = stepper.vjp(by_q, by_p)
    found = back.q @ dq + back.p @ dp + back.control[0] * 0.7 + back.qfrc @ dqfrc
    covector = np.concatenate([by_q, by_p])
    size = np.linalg.norm(covector) * np.linalg.norm(forwards)
    assert abs(covector @ forwards - found) < 1e-13 * size


@pytest.mark.parametrize("tie", TIES)
def test_a_step_by_forces_and_controls(tie):
    model = two_arms(tie)({})
    start, control = near(model, 0.0), np.array([0.3])
    qfrc, d = np.random.default_rng(4).normal(size=(2, model.n_v))

    def step(x: float, **options: bool) -> tuple[saltus.Stepper, State]:
        stepper = saltus.Stepper(model, h=0.01, **options)
        return stepper, stepper.advance(start, control=control + x, qfrc=qfrc + x * d)

    stepper, end = step(0.0, record=True)
    exact = np.concatenate(stepper.jvp(du=[1.0], dqfrc=d))
    expected = difference(lambda x: rows(model, end, step(x)[1]), 1e-2)
    assert np.abs(exact - expected).max() < 1e-8 * np.abs(expected).max()


@pytest.mark.parametrize("tie", TIES[:5])
def test_a_step_by_its_duration(tie):
    model = two_arms(tie)({})
    start = near(model, 0.0)

    def step(x: float, **options: bool) -> tuple[saltus.Stepper, State]:
        stepper = saltus.Stepper(model, h=0.01 + x, **options)
        return stepper, stepper.advance(start, control=[0.3])

    stepper, end = step(0.0, record=True)
    exact = np.concatenate(stepper.jvp(dh=1.0))
    expected = difference(lambda x: rows(model, end, step(x)[1]), 1e-4)
    assert np.abs(exact - expected).max() < 1e-8 * np.abs(expected).max()
    assert stepper.vjp(np.ones(model.n_v), np.zeros(model.n_v)).h == pytest.approx(
        exact[: model.n_v].sum(), rel=1e-10
    )


def test_a_motion_that_is_told_has_no_derivative_by_time():
    model = two_arms("prescribed")({})
    stepper = saltus.Stepper(model, h=0.01, record=True)
    stepper.advance(near(model, 0.0), control=[0.3])
    assert stepper.derivative().h.size == 0
    with pytest.raises(
        saltus.ModelError, match='by its duration: joint "j_left_tip prescribed" moves'
    ):
        stepper.jvp(dh=1.0)


@pytest.mark.parametrize("tie", ["coupling", "prescribed"])
def test_a_step_by_placements_that_close_no_loop(tie):
    """These need no closed start of their own, so that p and q may be held."""
    build = two_arms(tie)
    check_placements(build, near(build({}), 0.0), build({}))


def check_placements(build: Build, start: State, model: saltus.Model) -> None:
    stepper = saltus.Stepper(model, h=0.01, record=True)
    end = stepper.advance(start, control=[0.3])
    by_q, by_p = np.random.default_rng(5).normal(size=(2, model.n_v))
    exact = stepper.model_gradient(by_q, by_p).placements
    for joint in ("j_left_lower", "j_right_tip"):
        d = np.random.default_rng(6).normal(size=3)

        def cost(x: float, joint: str = joint, d: Array = d) -> float:
            moved = build({joint: x * d})
            # momenta that keep the loops closed: the rest of p is pushed away at the start
            after = saltus.Stepper(moved, h=0.01).advance(at_rate(moved, start), control=[0.3])
            return float(by_q @ model.difference(end.q, after.q) + by_p @ after.p)

        assert exact[joint] @ d == pytest.approx(difference(cost, 1e-3), rel=1e-7)


def at_rate(model: saltus.Model, state: State) -> State:
    """Return a state whose p is that nearest which the loops allow, in the metric of 1/M."""
    v = np.linalg.solve(model.mass_matrix(state.q), state.p)
    return saltus.close_loops(model, state.q, v)


def test_a_massless_slide_that_is_shaken():
    """A pendulum on it: by the angle and its momentum, through fifty steps."""
    builder = ModelBuilder().add_link("slide").set_gravity((0, -9.81, 0))
    builder.add_link("bob", saltus.BodyInertia(1, (0, -1, 0), np.zeros((3, 3))))
    builder.add_joint("slide", "prismatic", parent="world", child="slide", axis=(1, 0, 0))
    builder.add_joint("swing", "revolute", parent="slide", child="bob", axis=(0, 0, 1))
    shaken = builder.set_prescribed(
        "slide", function=lambda t: (0.3 * np.sin(4 * t), 1.2 * np.cos(4 * t))
    )
    model = shaken.build()

    def start(x: float) -> State:
        return saltus.close_loops(model, [0, 0.5 + x], [1.2, 0.3 - 2 * x], keep=["swing"])

    def run(x: float) -> saltus.Trajectory:
        return saltus.simulate(model, state=start(x), duration=0.5, h=0.01, progress=False)

    made, by_q, by_p = run(0.0), np.array([0.0, 1.0]), np.array([0.4, -0.7])
    g = made.gradient(by_q, by_p)
    along = difference(lambda x: rows(model, start(0.0), start(x)), 1e-3)
    expected = difference(lambda x: float(by_q @ run(x).q[-1] + by_p @ run(x).p[-1]), 1e-3)
    assert np.concatenate([g.q, g.p]) @ along == pytest.approx(expected, rel=1e-8)


@pytest.mark.parametrize("friction", [0.0, 0.2])
def test_a_loop_beside_a_contact_that_is_held(friction):
    """Two balls on a floor that slide, a rod between them that is a distance."""
    builder = ModelBuilder().add_half_space("floor", (0, 0, 1))
    for name, x in (("a", 0.0), ("b", 0.5)):
        builder.add_link(f"{name}_slide", saltus.BodyInertia(0.1, ZERO, 1e-3 * np.eye(3)))
        builder.add_link(name, saltus.BodyInertia(1, ZERO, 1e-3 * np.eye(3)))
        X = Pose((x, 0, 0))
        along, up = (1, 0, 0), (0, 0, 1)
        slide = f"{name}_slide"
        builder.add_joint(f"{name}_x", "prismatic", parent="world", child=slide, X_PJ=X, axis=along)
        builder.add_joint(f"{name}_z", "prismatic", parent=slide, child=name, axis=up)
        builder.add_shape(name, saltus.Sphere(0.1))
        builder.add_motor(f"{name}_push", joint=f"{name}_x")
    builder.add_loop("rod", "distance", a="a", b="b", distance=0.5)
    model = builder.set_default_contact(restitution=0, friction=friction).build()
    start = model.state([0, 0.1, 0, 0.1], [1.0, 0, 1.0, 0])
    control = np.array([0.8, -0.3])

    def step(x: float, **options: bool) -> tuple[saltus.Stepper, State]:
        stepper = saltus.Stepper(model, h=0.01, **options)
        moved = State(0.0, start.q + x * np.array([1.0, 0, 1.0, 0]), start.p * (1 + x))
        return stepper, stepper.advance(moved, control=control + x)

    stepper, end = step(0.0, record=True)
    assert stepper.report.sustained == 2
    exact = np.concatenate(stepper.jvp([1.0, 0, 1.0, 0], start.p, [1.0, 1.0]))
    expected = difference(lambda x: rows(model, end, step(x)[1]), 1e-2)
    np.testing.assert_allclose(exact, expected, atol=1e-9 * np.abs(expected).max())


def test_what_hits_with_a_loop_is_refused():
    model = two_arms("distance")({}).builder().add_half_space("floor", (0, 0, 1), -1.6)
    model = model.add_shape("left_tip", saltus.Sphere(0.1)).build()
    state = near(model, 0.0)
    stepper = saltus.Stepper(model, h=0.01, record=True)
    for _ in range(200):
        state = stepper.advance(state)
        if stepper.report.impacts:
            break
    assert stepper.report.impacts
    with pytest.raises(saltus.ModelError, match="an impact of bodies with loops or prescribed"):
        stepper.derivative()


def test_a_run_of_a_four_bar():
    """A gradient by damping and by the start, through two hundred steps."""

    def build(damping: float) -> saltus.Model:
        builder = ModelBuilder().set_gravity((0, -9.81, 0))
        parent, at = "world", 0.0
        for k, (m, length) in enumerate(((1, 0.4), (2, 1), (1.5, 0.8))):
            inertia = saltus.BodyInertia(m, (length / 2, 0, 0), np.diag([0.1, 0.1, 0.1]))
            builder.add_link(f"rod_{k}", inertia)
            X = Pose((at, 0, 0))
            builder.add_joint(
                f"joint_{k}", "revolute", parent=parent, child=f"rod_{k}", axis=(0, 0, 1), X_PJ=X
            )
            parent, at = f"rod_{k}", length
        builder.set_damping("joint_0", damping)
        pin = At("rod_2", (0.8, 0, 0))
        return builder.add_loop("pin", "point", a=pin, b=At("world", (1, 0, 0))).build()

    start = saltus.close_loops(build(0.1), [1.2, -1.0, -1.4], [0.3, 0, 0])

    def run(damping: float) -> saltus.Trajectory:
        return saltus.simulate(build(damping), state=start, duration=2.0, h=0.01, progress=False)

    by_q = np.array([1.0, -0.5, 0.3])
    gradient = run(0.1).gradient(by_q, np.zeros(3))
    expected = difference(lambda x: float(by_q @ run(0.1 + x).q[-1]), 1e-3)
    assert gradient.damping[0] == pytest.approx(expected, rel=1e-7)
