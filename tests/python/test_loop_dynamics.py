"""Accelerations and forces of models with loops: against steps, the tree alone, closed forms."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from tests.python.test_loops import chain, four_bar

import saltus
from saltus import At, BodyInertia, ModelBuilder, ModelError, Pose

Z = (0.0, 0.0, 1.0)


def pin(builder: ModelBuilder) -> None:
    builder.add_loop("pin", "point", a=At("rod_2", (0.8, 0, 0)), b=At("world", (1, 0, 0)))


def pin_twice(builder: ModelBuilder) -> None:
    pin(builder)
    builder.add_loop("again", "point", a=At("rod_2", (0.8, 0, 0)), b=At("world", (1, 0, 0)))


def strut(builder: ModelBuilder) -> None:
    builder.add_loop(
        "strut", "distance", a=At("rod_2", (0.8, 0, 0.1)), b=At("rod_0", (0.1, 0.05, 0)),
        distance=0.7,
    )  # fmt: skip


def rail(builder: ModelBuilder) -> None:
    R = np.array([[0.0, 0.6, 0.8], [0, -0.8, 0.6], [1, 0, 0]])
    builder.add_loop("rail", "on_plane", a=At("rod_2", (0.8, 0, 0)), b=At("rod_0", R=R))


def gears(builder: ModelBuilder) -> None:
    builder.add_coupling("joint_2", of="joint_0", polynomial=(0.1, -0.7, 0.3, 0.2))


def told(builder: ModelBuilder) -> None:
    builder.set_prescribed("joint_1", [0, 1, 2, 3], [0, 0.5, 0.1, 0.3])


LOOPS = [pin, pin_twice, strut, rail, gears, told]


def rods() -> ModelBuilder:
    builder = chain([(1, 0.4), (2, 1), (1.5, 0.8)]).add_joint_spring("joint_1", stiffness=3.0)
    return builder.set_armature("joint_0", 0.05)


def balls() -> ModelBuilder:
    """Return three rods on ball joints, and a body that flies."""
    builder = ModelBuilder("balls")
    parent = "world"
    for k in range(3):
        rod = saltus.solid_box(1.0 + k, (0.5, 0.1, 0.2)).seen_from(Pose((0.25, 0, 0)))
        builder.add_link(f"rod_{k}", rod)
        X = Pose((0 if k == 0 else 0.5, 0, 0))
        builder.add_joint(f"ball_{k}", "spherical", parent=parent, child=f"rod_{k}", X_PJ=X)
        parent = f"rod_{k}"
    return builder.add_body("load", saltus.Box((0.1, 0.2, 0.3)), mass=2.0)


def weld(builder: ModelBuilder) -> None:
    turn = np.array([[0.6, -0.8, 0], [0.8, 0.6, 0], [0, 0, 1.0]])
    builder.add_loop("weld", "weld", a=At("rod_2", (0.5, 0, 0)), b=At("load", (0.1, 0, 0), turn))


def tie(builder: ModelBuilder) -> None:
    builder.add_loop("tie", "distance", a=At("rod_1"), b=At("load", (0.1, 0, 0)), distance=0.4)


CASES: list[tuple[Callable[[], ModelBuilder], Callable[[ModelBuilder], None]]] = [
    *((rods, loop) for loop in LOOPS),
    (balls, weld),
    (balls, tie),
]
each_case = pytest.mark.parametrize(("make", "loop"), CASES, ids=lambda case: case.__name__)


def built(make: Callable[[], ModelBuilder], loop: Callable[[ModelBuilder], None]) -> saltus.Model:
    builder = make()
    loop(builder)
    return builder.build()


def closed(model: saltus.Model, seed: int, t: float = 0.0) -> saltus.State:
    """Return a random state whose loops are closed."""
    random = np.random.default_rng(seed)
    for _ in range(20):
        q, v = model.random_configuration(random), random.normal(size=model.n_v)
        try:
            return saltus.close_loops(model, q, v, t=t)
        except ModelError:  # no configuration is near
            continue
    raise AssertionError("no start was found")


def gradients(model: saltus.Model, q: np.ndarray, t: float) -> np.ndarray:
    """Return the gradients of all rows of the loops (n_v, m), by differences of fourth order."""

    def h(dq: np.ndarray) -> np.ndarray:
        gaps = model.loop_gaps(model.integrate(q, dq), t)
        return np.concatenate([gaps[name] for name in model.loop_names])

    step = 1e-3
    unit = step * np.eye(model.n_v)
    rows = [(8 * (h(e) - h(-e)) - (h(2 * e) - h(-2 * e))) / (12 * step) for e in unit]
    return np.array(rows)


@each_case
def test_accelerations_are_those_of_short_steps(make, loop) -> None:
    model = built(make, loop)
    for seed in range(3):
        t = 0.4 * seed
        state = closed(model, seed, t)
        v = model.velocity(state)
        forces = np.random.default_rng(seed).normal(size=model.n_v)
        a = model.accelerations(state.q, v, forces, t=t)

        def rate(h: float, state=state, v=v, forces=forces) -> np.ndarray:
            after = saltus.Stepper(model, h).advance(state, qfrc=forces)
            return (model.velocity(after) - v) / h

        # twice as fine: 1e-8 of the third derivative is left; rounding 1e-12 of v
        fine = 2 * rate(5e-5) - rate(1e-4)
        np.testing.assert_allclose(a, fine, rtol=0, atol=1e-5 * (1 + np.abs(a).max()))


@each_case
def test_the_rest_of_the_tree_is_what_loops_push(make, loop) -> None:
    """M a + c - forces of the tree alone is A lambda, and A^T a is what keeps the loops closed."""
    model, tree = built(make, loop), make().build()
    for seed in range(5):
        t = 0.3 * seed
        state = closed(model, seed, t)
        v = model.velocity(state)
        forces = np.random.default_rng(seed).normal(size=model.n_v)
        a = model.accelerations(state.q, v, forces, t=t)
        rest = tree.inverse_dynamics(state.q, v, a) - forces
        A = gradients(model, state.q, t)
        # rows that say the same twice differ by the rounding of differences
        share = np.linalg.lstsq(A, rest, rcond=1e-8)[0]
        # 1e-9: differences of fourth order, A to 1e-11
        np.testing.assert_allclose(A @ share, rest, rtol=0, atol=1e-9 * (1 + np.abs(rest).max()))


@each_case
def test_loops_stay_closed_to_second_order(make, loop) -> None:
    """A^T a is minus the second difference of h along the motion at constant v."""
    model = built(make, loop)
    if loop is told:
        pytest.skip("its h depends on time")
    for seed in range(5):
        state = closed(model, seed)
        v = model.velocity(state)
        a = model.accelerations(state.q, v)

        def h(s: float, state=state, v=v) -> np.ndarray:
            gaps = model.loop_gaps(model.integrate(state.q, s * v))
            return np.concatenate([gaps[name] for name in model.loop_names])

        step = 2e-3
        pairs = [h(k * step) + h(-k * step) - 2 * h(0) for k in (1, 2)]
        bend = (16 * pairs[0] - pairs[1]) / (12 * step**2)
        needed = gradients(model, state.q, 0.0).T @ a
        # step^4 of the sixth derivative along v, rounding 1e-16 / step^2
        np.testing.assert_allclose(needed, -bend, rtol=0, atol=1e-7 * (1 + np.abs(bend).max()))


@each_case
def test_inverse_dynamics_are_the_forces_that_loops_do_not_take(make, loop) -> None:
    model, tree = built(make, loop), make().build()
    for seed in range(5):
        t = 0.3 * seed
        state = closed(model, seed, t)
        v = model.velocity(state)
        random = np.random.default_rng(seed)
        a = model.accelerations(state.q, v, random.normal(size=model.n_v), t=t)
        forces = model.inverse_dynamics(state.q, v, a, t=t)
        again = model.accelerations(state.q, v, forces, t=t)
        np.testing.assert_allclose(again, a, rtol=0, atol=1e-9 * (1 + np.abs(a).max()))
        if loop is told:
            assert forces[1] == 0
            continue
        A = gradients(model, state.q, t)
        push = A.T @ np.linalg.solve(tree.mass_matrix(state.q), forces)
        np.testing.assert_allclose(push, 0, rtol=0, atol=1e-8 * (1 + np.abs(forces).max()))


def test_rows_are_as_each_alone_and_errors_name_them() -> None:
    model = four_bar().build()
    states = [closed(model, seed) for seed in range(4)]
    q = np.array([state.q for state in states])
    v = np.array([model.velocity(state) for state in states])
    a = model.accelerations(q, v)
    for k in range(4):
        np.testing.assert_array_equal(a[k], model.accelerations(q[k], v[k]))
        np.testing.assert_array_equal(a[k], model.at(q[k]).accelerations(v[k]))
        np.testing.assert_array_equal(
            model.inverse_dynamics(q, v, a)[k], model.inverse_dynamics(q[k], v[k], a[k])
        )
    v[2] += 1.0
    with pytest.raises(ModelError, match=r'row 2: loop "pin" opens at a rate of .*close_loops'):
        model.accelerations(q, v)


def test_what_opens_a_loop_is_named() -> None:
    model = four_bar().build()
    state = closed(model, 1)
    v = model.velocity(state)
    with pytest.raises(ModelError, match='loop "pin" is open by'):
        model.accelerations([0.1, 0.2, 0.3])
    with pytest.raises(ModelError, match='loop "pin" would open, its accelerations are off by'):
        model.inverse_dynamics(state.q, v, [1.0, 0.0, 0.0])
    with pytest.raises(ModelError, match='loop "pin" would open'):
        model.inverse_dynamics(state.q, v)  # a = 0 does not keep it closed at this rate
    rest = model.inverse_dynamics(state.q)
    np.testing.assert_allclose(model.accelerations(state.q, None, rest), 0, atol=1e-12)


@pytest.mark.parametrize(("accelerates", "n"), [(True, 3), (False, 2)])
def test_a_function_says_its_acceleration_where_it_is_asked(accelerates: bool, n: int) -> None:
    """A pendulum on a slide that is shaken: a = -(g sin + x'' cos) / l."""

    def shaken(t: float) -> tuple[float, ...]:
        return (math.sin(4 * t), 4 * math.cos(4 * t), -16 * math.sin(4 * t))[:n]

    builder = ModelBuilder("pivot").set_gravity((0, -9.81, 0)).add_link("slide")
    builder.add_link("bob", BodyInertia(1, (0, -1, 0), np.zeros((3, 3))))
    builder.add_joint("slide", "prismatic", parent="world", child="slide", axis=(1, 0, 0))
    builder.add_joint("swing", "revolute", parent="slide", child="bob", axis=Z)
    model = builder.set_prescribed("slide", function=shaken).build()
    t, angle = 0.3, 0.7
    q, v = [math.sin(4 * t), angle], [4 * math.cos(4 * t), 0.9]
    if not accelerates:
        with pytest.raises(ModelError, match='"slide prescribed" returns displacement and rate'):
            model.accelerations(q, v, t=t)
        return
    a = model.accelerations(q, v, t=t)
    told = -16 * math.sin(4 * t)
    expected = [told, -9.81 * math.sin(angle) - told * math.cos(angle)]
    np.testing.assert_allclose(a, expected, rtol=1e-13)
    with pytest.raises(ModelError, match='loop "slide prescribed" is open by'):
        model.accelerations(q, v)  # at t = 0 it is elsewhere
