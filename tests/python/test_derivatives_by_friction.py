"""Derivatives of steps and runs by coefficients of friction, against differences of whole steps."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from test_step_derivatives_friction import UP, ball, difference, thrown

import saltus
from saltus import ModelBuilder, Smoothness, State

Array = np.ndarray
Build = Callable[[float], saltus.Model]


def last(stepper: saltus.Stepper, start: State) -> Array:
    end = stepper.advance(start)
    return np.concatenate([end.q, end.p])


def by_friction(build: Build, friction: float, start: State, h: float = 0.01) -> tuple:
    """Return the derivative of a step, and that by one friction of all pairs: exact, differences.

    q of free bodies is taken along velocities.
    """
    model = build(friction)
    stepper = saltus.Stepper(model, h=h, record=True)
    end = stepper.advance(start)
    d = stepper.derivative()
    exact = d.friction.sum(axis=1)
    np.testing.assert_allclose(np.concatenate(stepper.jvp(dfriction=1.0)), exact, atol=1e-14)
    covectors = np.random.default_rng(3).normal(size=(2, model.n_v))
    back = stepper.vjp(*covectors)
    # the transpose, to rounding of a few sums
    assert back.friction.sum() == pytest.approx(np.concatenate(covectors) @ exact, abs=1e-12)
    own = stepper.model_gradient(*covectors).friction
    assert sum(own.values()) == pytest.approx(back.friction.sum(), abs=1e-15)
    assert set(own) <= set(d.rubbing)

    def moved(x: float) -> Array:
        after = saltus.Stepper(build(friction + x), h=h).advance(start)
        return np.concatenate([model.difference(end.q, after.q), after.p])

    return d, exact, difference(moved, 1e-4)


def wrong(exact: Array, expected: Array) -> float:
    assert np.abs(expected).max() > 1e-6
    return float(np.abs(exact - expected).max() / np.abs(expected).max())


def test_a_ball_that_slides_on_a_slope():
    slope = 0.3
    normal, along = [np.sin(slope), 0, np.cos(slope)], [np.cos(slope), 0, -np.sin(slope)]
    q = np.concatenate([0.1 * np.array(normal), [0, 0, 0, 1]])
    start = State(0.0, q, np.concatenate([along, np.zeros(3)]))
    d, exact, expected = by_friction(lambda mu: ball(mu, 0.5, slope), 0.05, start)
    assert d.rubbing == ["ball ~ floor"]
    # differences of eighth order with a step of 1e-4: rounding 1e-12 and the solver's 1e-12
    assert wrong(exact, expected) < 1e-8
    # it loses m g cos(slope) h of momentum, for each of its friction
    lost = -9.81 * np.cos(slope) * 0.01
    assert d.friction[6:9, 0] @ along == pytest.approx(lost, rel=1e-3)  # rolls a little: 2nd order


def test_a_ball_that_slides_and_spins():
    start = thrown(ball(0.3, 0.5), 0.1, (3, 0.5, 0), (0, 0, 0.2))
    _, exact, expected = by_friction(lambda mu: ball(mu, 0.5), 0.3, start)
    assert wrong(exact, expected) < 1e-8


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
def test_a_ball_that_slides_in_its_impact(restitution):
    start = thrown(ball(0.3, restitution), 0.105, (3, 0.5, -1), (0, 0, 0.2))
    d, exact, expected = by_friction(lambda mu: ball(mu, restitution), 0.3, start)
    assert len(d.impacts) == 1
    assert d.smoothness == Smoothness.smooth
    assert wrong(exact, expected) < 1e-8


@pytest.mark.parametrize("v_z", [0.0, -1.0], ids=["held", "in its impact"])
def test_what_sticks_does_not_depend_on_its_friction(v_z):
    model = ball(0.3, 0.5)
    # a ball that rolls where it is held; it sticks where it hits
    start = thrown(model, 0.1 if v_z == 0 else 0.105, (0.1, 0, v_z), (0, 1.0, 0.2))
    d, exact, expected = by_friction(lambda mu: ball(mu, 0.5), 0.3, start)
    assert d.rubbing == ["ball ~ floor"]
    np.testing.assert_array_equal(exact, 0)
    np.testing.assert_allclose(expected, 0, atol=1e-10)


def box(friction: float, restitution: float = 0.0) -> saltus.Model:
    builder = ModelBuilder().add_half_space("floor", UP)
    builder.add_body("box", saltus.Box((0.2, 0.3, 0.1)), mass=1.0, joint="floating")
    return builder.set_default_contact(restitution=restitution, friction=friction).build()


def test_a_box_that_slides_on_four_corners():
    """Which corner pushes how much is not determined; what they do together is."""
    start = thrown(box(0.2), 0.1, (1.0, 0.4, 0), (0, 0, 0))
    d, exact, expected = by_friction(box, 0.2, start)
    assert len(d.rubbing) == 4
    assert wrong(exact, expected) < 1e-8


def test_a_box_that_lands_flat_and_slides():
    start = thrown(box(0.2), 0.102, (1.0, 0.4, -0.5), (0, 0, 0))
    d, exact, expected = by_friction(box, 0.2, start)
    assert len(d.impacts) == 1
    assert wrong(exact, expected) < 1e-8


def tilted(restitution: float, v: tuple, w: tuple) -> tuple[Build, State]:
    """Return a box whose lowest corner hits the floor first."""
    model = box(0.2, restitution)
    R = Rotation.from_rotvec((0.5, -0.4, 0.2)).as_matrix()
    low = -np.abs(R[2] * [0.2, 0.3, 0.1]).sum()
    q = model.state({"box": saltus.Pose((0, 0, -low + 0.004), R)}).q
    p = model.mass_matrix(q) @ np.concatenate([v, w])
    return (lambda mu: box(mu, restitution)), State(0.0, q, p)


@pytest.mark.parametrize("restitution", [0.0, 0.125, 0.8])
def test_a_box_that_hits_with_a_corner(restitution):
    build, start = tilted(restitution, (1.0, 0.5, -1.0), (1.0, -2.0, 0.5))
    d, exact, expected = by_friction(build, 0.2, start)
    assert len(d.rubbing) == len(d.impacts) == 1
    assert wrong(exact, expected) < 1e-7


def test_frictions_are_those_of_their_pairs():
    """Two balls on two floors' materials: a column each, and one does not move the other."""

    def build(left: float, right: float) -> saltus.Model:
        builder = ModelBuilder().add_floor(material="ground")
        for name, x in (("left", -1.0), ("right", 1.0)):
            X = saltus.Pose((x, 0, 0))
            builder.add_body(name, saltus.Sphere(0.1), mass=1.0, joint="floating", X=X)
        for name, mu in (("left", left), ("right", right)):
            builder.set_material(name, name)
            builder.set_contact(name, "ground", restitution=0, friction=mu)
        builder.set_default_contact(restitution=0)
        return builder.build()

    model = build(0.1, 0.2)
    q = np.array([0, 0, 0.1, 0, 0, 0, 1.0] * 2)
    start = State(0.0, q, np.array([1.0, 0, 0, 0, 0, 0, 0, 2.0, 0, 0, 0, 0]))
    stepper = saltus.Stepper(model, h=0.01, record=True)
    stepper.advance(start)
    d = stepper.derivative()
    assert sorted(d.rubbing) == ["left ~ floor", "right ~ floor"]
    for name, at in (("left", 0), ("right", 6)):
        column = d.friction[:, d.rubbing.index(name + " ~ floor")].reshape(2, 12)
        other = column[:, 6 - at : 12 - at]
        np.testing.assert_allclose(other, 0, atol=1e-14)
        assert np.abs(column[:, at : at + 6]).max() > 1e-2

    def moved(x: float) -> Array:
        return last(saltus.Stepper(build(0.1, 0.2 + x), h=0.01), start)[14:]

    expected = difference(moved, 1e-4)
    assert wrong(d.friction[12:, d.rubbing.index("right ~ floor")], expected) < 1e-8
    column = np.concatenate(stepper.jvp(dfriction=[float(r[0] == "r") for r in d.rubbing]))
    np.testing.assert_allclose(column, d.friction[:, d.rubbing.index("right ~ floor")], atol=1e-15)
    with pytest.raises(saltus.ModelError, match="dfriction has 3 entries; it has 2, one for each"):
        stepper.jvp(dfriction=[1.0, 2.0, 3.0])


def test_the_edge_of_the_cone_is_told():
    """A ball that does not turn, on a slope as steep as its friction: with less it would slide."""

    def made(friction: float) -> saltus.StepDerivative:
        builder = ModelBuilder().add_half_space("floor", UP).set_gravity((9.81 * 0.3, 0, -9.81))
        builder.add_link("slide", saltus.BodyInertia(0, (0, 0, 0), np.zeros((3, 3))))
        builder.add_joint("x", "prismatic", parent="world", child="slide", axis=(1, 0, 0))
        builder.add_link("ball", saltus.BodyInertia(1, (0, 0, 0), 0.004 * np.eye(3)))
        builder.add_shape("ball", saltus.Sphere(0.1))
        builder.add_joint("z", "prismatic", parent="slide", child="ball", axis=(0, 0, 1))
        model = builder.set_default_contact(restitution=0, friction=friction).build()
        stepper = saltus.Stepper(model, h=0.01, record=True)
        stepper.advance(model.state(q={"z": 0.1}))
        return stepper.derivative()

    edge, sticks, slides = made(0.3), made(0.301), made(0.299)
    assert edge.smoothness == Smoothness.one_sided
    assert sticks.smoothness == slides.smoothness == Smoothness.smooth
    # at the edge it is that of a contact that sticks
    np.testing.assert_allclose(edge.A, sticks.A, atol=1e-12)
    np.testing.assert_array_equal(edge.friction, 0)
    # m g h of momentum, and half of that times h / m of way
    np.testing.assert_allclose(slides.friction[[0, 2], 0], [-9.81 * 5e-5, -0.0981], rtol=1e-12)


def tumble(friction: float, restitution: float, steps: int = 34) -> saltus.Trajectory:
    build, start = tilted(restitution, (1.0, 0.5, -1.0), (1.0, -2.0, 0.5))
    model = build(friction)
    return saltus.simulate(model, state=start, duration=steps * 0.005, h=0.005, progress=False)


def test_a_run_by_friction_and_restitution():
    """A box that tumbles: impacts of one corner after the other, between them it slides."""
    friction, restitution = 0.2, 0.125
    run = tumble(friction, restitution)
    assert len(run.impacts) == 8
    c = np.array([1.0, -0.5, 2.0, 0.3, 0.2, -0.4])
    g = run.gradient(c, np.zeros(6))
    assert all(name.endswith("~ floor") for name in {**g.friction, **g.restitution})

    def cost(x: float, y: float) -> Array:
        q = tumble(friction + x, restitution + y).q[-1]
        return np.atleast_1d(c @ run.model.difference(run.q[-1], q))

    mu, e = sum(g.friction.values()), sum(g.restitution.values())
    assert mu == pytest.approx(difference(lambda x: cost(x, 0), 1e-5)[0], rel=1e-6)
    assert e == pytest.approx(difference(lambda x: cost(0, x), 1e-5)[0], rel=1e-6)


def test_a_contact_that_slides_in_the_kick_alone():
    """Where an arc ends a corner slides by Coulomb's law at that instant, not as in the arc."""
    random, h = np.random.default_rng(1), 1 / 148
    turns = random.normal(size=(8, 3, 4))[1]
    v = [*turns[1, :3] / 2, *3 * turns[2, :3]]

    def made(friction: float) -> saltus.Trajectory:
        builder = ModelBuilder().add_floor(friction=friction, restitution=0.01)
        builder.add_body("cube", saltus.Box((0.0524,) * 3), mass=0.37, joint="floating")
        model = builder.build()
        q = model.normalized([0, 0, 0.15, *turns[0]])
        return saltus.simulate(model, q, v, duration=16 * h, h=h, progress=False)

    friction = 0.05 + 33 * 0.0075
    run = made(friction)
    c = np.array([1.0, -0.5, 2.0, 0.3, 0.2, -0.4])
    g = run.gradient(c, 2 * c)

    def cost(x: float) -> Array:
        end = made(friction + x)
        off = run.model.difference(run.q[-1], end.q[-1])
        return np.atleast_1d(c @ off + 2 * c @ (end.p[-1] - run.p[-1]))

    # steps' own tolerance of 1e-12 over those of the differences, and a run of 16
    assert sum(g.friction.values()) == pytest.approx(difference(cost, 1e-5)[0], rel=1e-6)
