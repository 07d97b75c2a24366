"""Derivatives of steps with friction, and of laws that match energies, against differences."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

import saltus
from saltus import BodyInertia, ModelBuilder, Pose, State

Array = np.ndarray


def difference(f: Callable[[float], Array], h: float) -> Array:
    """Return f'(0) by central differences of eighth order."""
    weights = (4 / 5, -1 / 5, 4 / 105, -1 / 280)
    return sum(w * (f(k * h) - f(-k * h)) for k, w in enumerate(weights, 1)) / h


def errors(
    model: saltus.Model,
    start: State,
    *,
    normal: Array | None = None,
    turns: bool = True,
    h: float = 0.01,
    by: float = 1e-4,
    law: str = "nodal_energy",
    qfrc: Array | None = None,
) -> tuple[float, float]:
    """Return how far jvp is from differences and vjp from jvp, along a random direction.

    `normal`: of a contact of a free body that is held, which the direction is to keep; without
    `turns` its orientation too.
    """
    random = np.random.default_rng(7)
    n = model.n_v
    dq, dp, by_q, by_p = random.normal(size=(4, n))
    if normal is not None:
        for x in (dq, dp):
            x[:3] -= normal * (normal @ x[:3])
            if not turns:
                x[3:5] = 0
    dh = 0.1 * random.normal()
    forces = {} if qfrc is None else {"qfrc": qfrc}
    stepper = saltus.Stepper(model, h=h, law=law, record=True)
    end = stepper.advance(start, **forces)
    forwards = np.concatenate(stepper.jvp(dq, dp, dh=dh))
    g = stepper.vjp(by_q, by_p)
    back = g.q @ dq + g.p @ dp + g.h * dh
    covector = np.concatenate([by_q, by_p])
    size = np.linalg.norm(covector) * np.linalg.norm(forwards)

    def moved(x: float) -> Array:
        state = State(0.0, model.integrate(start.q, x * dq), start.p + x * dp)
        after = saltus.Stepper(model, h=h + x * dh, law=law).advance(state, **forces)
        return np.concatenate([model.difference(end.q, after.q), after.p])

    expected = difference(moved, by)
    wrong = np.abs(forwards - expected).max() / np.abs(expected).max()
    return float(wrong), float(abs(covector @ forwards - back) / size)


def ball(friction: float, restitution: float, slope: float = 0.0) -> saltus.Model:
    builder = ModelBuilder().add_half_space("floor", (np.sin(slope), 0, np.cos(slope)))
    builder.add_body("ball", saltus.Sphere(0.1), mass=1.0, joint="floating")
    return builder.set_default_contact(restitution=restitution, friction=friction).build()


def thrown(model: saltus.Model, z: float, v: tuple, w: tuple) -> State:
    q = np.array([0, 0, z, 0, 0, 0, 1.0])
    return State(0.0, q, model.mass_matrix(q) @ np.concatenate([v, w]))


UP = np.array([0, 0, 1.0])


@pytest.mark.parametrize(
    ("v", "w"), [((1, 0.3, 0), (-3, 10, 0.5)), ((3, 0.5, 0), (0, 0, 0.2))], ids=["rolls", "slides"]
)
def test_a_ball_on_the_floor(v, w):
    model = ball(0.3, 0.5)
    wrong, transposed = errors(model, thrown(model, 0.1, v, w), normal=UP, by=1e-5)
    assert wrong < 1e-8
    assert transposed < 1e-13


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
@pytest.mark.parametrize(
    ("v", "w"),
    [((0.1, 0.05, -1), (0.3, 0.2, 0.2)), ((3, 0.5, -1), (0, 0, 0.2))],
    ids=["sticks", "slides"],
)
def test_a_ball_that_hits_the_floor(v, w, restitution):
    model = ball(0.3, restitution)
    wrong, transposed = errors(model, thrown(model, 0.105, v, w))
    assert wrong < 1e-8
    assert transposed < 1e-13


@pytest.mark.parametrize("friction", [0.05, 0.6])
def test_a_ball_on_a_slope(friction):
    model = ball(friction, 0.5, slope=0.3)
    normal = np.array([np.sin(0.3), 0, np.cos(0.3)])
    q = np.concatenate([0.1 * normal, [0, 0, 0, 1]])
    along = np.array([np.cos(0.3), 0, -np.sin(0.3)])
    speed = 1.0 if friction < 0.1 else 0.0
    p = np.concatenate([speed * along + [0, 0.2 * speed, 0], np.zeros(3)])
    wrong, transposed = errors(model, State(0.0, q, p), normal=normal, by=1e-3)
    assert wrong < 1e-8
    assert transposed < 1e-13


def box(friction: float) -> saltus.Model:
    builder = ModelBuilder().add_half_space("floor", UP)
    builder.add_body("box", saltus.Box((0.2, 0.3, 0.1)), mass=1.0, joint="floating")
    return builder.set_default_contact(restitution=0, friction=friction).build()


def test_a_box_at_rest_stays_where_it_is_moved():
    """Its corners are redundant: what they do together has a derivative, their shares have not."""
    model = box(0.4)
    q = np.array([0, 0, 0.1, 0, 0, 0, 1.0])
    stepper = saltus.Stepper(model, record=True)
    stepper.advance(State(0.0, q, np.zeros(6)), qfrc=[1.0, 0.5, 0, 0, 0, 0.02])
    A = stepper.derivative().A
    moves = np.zeros((6, 6))
    moves[0, 0] = moves[1, 1] = moves[5, 5] = 1  # along the floor, and about the vertical
    flat = [0, 1, 5]
    np.testing.assert_allclose(A[:6][:, flat], moves[:, flat], atol=1e-9)
    np.testing.assert_allclose(A[:, 6:], 0, atol=1e-9)


def arm(friction: float, restitution: float) -> saltus.Model:
    builder = ModelBuilder("arm").add_half_space("floor", UP, -0.75)
    for i, (parent, at) in enumerate((("world", (0, 0, 0)), ("arm_0", (0, 0, -0.4)))):
        builder.add_link(f"arm_{i}", BodyInertia(1, (0.02, 0.01, -0.2), 0.02 * np.eye(3)))
        builder.add_joint(
            f"joint_{i}",
            "revolute",
            parent=parent,
            child=f"arm_{i}",
            X_PJ=Pose(at),
            axis=(0.1 * i, 1, 0.2 * i),
            damping=0.05,
        )
    builder.add_shape("arm_1", saltus.Sphere(0.05), Pose((0, 0, -0.4)))
    return builder.set_default_contact(restitution=restitution, friction=friction).build()


@pytest.mark.parametrize(("friction", "restitution"), [(0.3, 0.5), (0.9, 0.5), (0.3, 0), (0.9, 0)])
def test_an_arm_that_hits_the_floor(friction, restitution):
    model = arm(friction, restitution)
    state = model.state([0.9, -0.5], [-2.0, 1.0])
    stepper = saltus.Stepper(model)
    for _ in range(100):
        after = stepper.advance(state)
        if stepper.report.impacts:
            break
        state = after
    assert stepper.report.impacts
    if restitution > 0:  # which share of the impulse is normal is not determined
        stepper = saltus.Stepper(model, record=True)
        stepper.advance(state)
        with pytest.raises(saltus.ModelError, match="fewer freedoms"):
            stepper.derivative()
        return
    wrong, transposed = errors(model, state, by=1e-5)
    assert wrong < 1e-6
    assert transposed < 1e-12


def test_dry_friction_of_joints():
    builder = saltus.read_urdf(saltus.scenes.chain(2))
    for name in builder.joint_names:
        builder.set_friction(name, 0.3)
    model = builder.build()
    for v in ([2.0, -3.0], [2.0, 0.0]):  # both slide; one may stick
        wrong, transposed = errors(model, model.state([0.3, 0.2], v), by=1e-4)
        assert wrong < 1e-8
        assert transposed < 1e-13


def pendulum_and_wall() -> saltus.Model:
    builder = ModelBuilder().add_half_space("wall", (-1, 0, 0), -0.6)
    for name, parent, at, mass, length in (
        ("upper", "world", (0, 0, 0), 1.0, 1.0),
        ("lower", "upper", (0, 0, -1.0), 0.7, 0.8),
    ):
        builder.add_link(name, BodyInertia(mass, (0, 0, -length), 0.001 * np.eye(3)))
        axis = (0, -1, 0)
        builder.add_joint(
            f"joint_{name}", "revolute", parent=parent, child=name, X_PJ=Pose(at), axis=axis
        )
    return builder.add_shape("lower", saltus.Sphere(0.05), Pose((0, 0, -0.8))).build()


@pytest.mark.parametrize("law", ["nodal_energy", "discrete_energy", "shadow_energy"])
def test_laws_that_match_energies(law):
    model = pendulum_and_wall()
    start = State(0.0, [0.25, 0.1], [8.48870329556745824538, 2.79629513162252774383])
    wrong, transposed = errors(model, start, h=0.05, law=law)
    assert wrong < 1e-8
    assert transposed < 1e-12
    stepper = saltus.Stepper(model, h=0.05, law=law, record=True)
    stepper.advance(start)
    assert len(stepper.report.impacts) == 1
    assert not stepper.report.impacts[0].fallback
    A = stepper.derivative().A
    zero, one = np.zeros((2, 2)), np.eye(2)
    omega = np.block([[zero, -one], [one, zero]])
    error = np.abs(A.T @ omega @ A - omega).max()
    if law == "discrete_energy":  # symplectic, to rounding; the others to O(h^2)
        assert error < 1e-11
    else:
        assert 1e-4 < error < 1
