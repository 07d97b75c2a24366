"""resolve_overlap: no overlap is left, of parts or of whole shapes, or an error names the pair."""

from __future__ import annotations

import numpy as np
import pytest

import saltus

BOX = saltus.Box((0.1, 0.1, 0.1))


def about(axis, angle: float) -> list[float]:
    axis = np.asarray(axis) / np.linalg.norm(axis)
    return [*(np.sin(angle / 2) * axis), np.cos(angle / 2)]


def pair_of(a: object, b: object) -> saltus.Model:
    builder = saltus.ModelBuilder().set_gravity((0, 0, 0))
    return builder.add_body("a", a, mass=1).add_body("b", b, mass=1).build()


def expect_apart(model: saltus.Model, q) -> np.ndarray:
    with pytest.raises(saltus.ModelError, match="overlap"):
        saltus.Stepper(model).advance(model.state(q))
    out = saltus.resolve_overlap(model, q)
    saltus.Stepper(model).advance(model.state(out))  # refuses overlap, of whole shapes too
    return out


@pytest.mark.parametrize(
    ("a", "b", "turn"),
    [
        (saltus.Box((1, 0.1, 0.1)), saltus.Box((0.1, 1, 0.1)), about((0, 0, 1), 0)),
        (saltus.Capsule(0.1, 1), saltus.Capsule(0.1, 1), about((1, 0, 0), 1.5)),
        (BOX, saltus.Capsule(0.02, 1), about((3, 2, 0), 0.36)),
        (BOX, BOX, about((8, 14, 20), 0.25)),
        (saltus.Cylinder(0.1, 0.1), saltus.Cylinder(0.1, 0.1), about((1, 0, 0), 0.5)),
    ],
)
def test_shapes_that_cross_or_are_in_one_place(a, b, turn):
    model = pair_of(a, b)
    expect_apart(model, model.normalized([0, 0, 0, 0, 0, 0, 1, 0.001, 0, 0, *turn]))


def test_crates_half_inside_each_other():
    builder = saltus.ModelBuilder().add_floor()
    for i in (0, 1):
        X = saltus.Pose((0, 0, 0.1 + 0.1 * i))
        builder.add_body(f"crate_{i}", BOX, mass=1, X=X)
    model = builder.build()
    expect_apart(model, model.neutral())


def test_three_cubes_in_one_place():
    builder = saltus.ModelBuilder().set_gravity((0, 0, 0))
    for i in range(3):
        builder.add_body(f"cube_{i}", BOX, mass=1)
    model = builder.build()
    q = [[0.05 * i, 0.01 * i, 0.02 * i, *about((1, 0.7, 0.4), 0.39 * i)] for i in range(3)]
    expect_apart(model, model.normalized(np.concatenate(q)))


def test_random_heaps():
    rng = np.random.default_rng(0)
    for _ in range(15):
        builder = saltus.ModelBuilder().add_floor()
        count = int(rng.integers(2, 6))
        for i in range(count):
            size = rng.uniform(0.05, 0.2, 3)
            shapes = (
                saltus.Box(size),
                saltus.Sphere(size[0]),
                saltus.Capsule(size[0] / 2, size[1]),
                saltus.Cylinder(size[0], size[1]),
                saltus.Ellipsoid(size),
            )
            builder.add_body(f"body_{i}", shapes[int(rng.integers(5))], mass=1)
        model = builder.build()
        places = [
            [*rng.uniform(-0.2, 0.2, 2), rng.uniform(0, 0.3), *rng.normal(size=4)]
            for _ in range(count)
        ]
        out = saltus.resolve_overlap(model, model.normalized(np.concatenate(places)))
        saltus.Stepper(model).advance(model.state(out))


def test_what_no_joint_moves_apart_is_named():
    builder = saltus.ModelBuilder().set_gravity((0, 0, 0))
    for i, z in enumerate((0, 0.19)):
        builder.add_body(f"slide_{i}", BOX, mass=1, joint=saltus.JointType.prismatic,
                         axis=(1, 0, 0), X=saltus.Pose((0, 0, z)))  # fmt: skip
    model = builder.build()
    with pytest.raises(saltus.ModelError, match=r"no joint moves .*slide_0 ~ slide_1 by 0\.01 m"):
        saltus.resolve_overlap(model, [0, 0])


def test_what_has_no_way_out_is_named():
    """Two walls, and a ball between them that is too large."""
    builder = saltus.ModelBuilder().set_gravity((0, 0, 0))
    builder.add_half_space("left", (1, 0, 0), -0.05).add_half_space("right", (-1, 0, 0), -0.05)
    builder.add_body("ball", saltus.Sphere(0.1), mass=1)
    model = builder.build()
    with pytest.raises(saltus.ModelError, match=r"still overlap: ball ~ left by .*ball ~ right by"):
        saltus.resolve_overlap(model, model.neutral())


def test_limits_are_kept_on_the_way_out():
    """A foot below the floor: the knee may bend back by 0.1 rad only, so that the hip lifts it."""
    builder = saltus.ModelBuilder("leg").add_floor()
    parent, at, inertia = "world", 0.9, saltus.BodyInertia(1, (0, 0, -0.25), 0.02 * np.eye(3))
    for name, bounds in (("hip", (-2.0, 2.0)), ("knee", (-0.1, 2.0))):
        builder.add_link(name, inertia)
        builder.add_joint(
            name, "revolute", parent=parent, child=name, axis=(0, 1, 0),
            X_PJ=saltus.Pose((0, 0, at)), lower=bounds[0], upper=bounds[1],
        )  # fmt: skip
        parent, at = name, -0.5
    builder.add_shape("knee", saltus.Sphere(0.05), saltus.Pose((0, 0, -0.5)))
    model = builder.build()
    q = saltus.resolve_overlap(model, [0.1, -0.1])
    assert q[1] >= -0.1 - 1e-9
    assert model.gaps(q).phi.min() > -1e-9
    saltus.simulate(model, q=q, duration=0.1)
    # beyond a limit at the start: back into it, if there is room
    q = saltus.resolve_overlap(model, [1.5, -0.5])
    np.testing.assert_allclose(q, [1.5, -0.1], atol=0.3)
    saltus.simulate(model, q=q, duration=0.1)
