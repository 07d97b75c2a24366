"""Jacobians, momenta and dynamics: shapes, rows, names, errors; numbers are test_frames.cpp's."""

from __future__ import annotations

import numpy as np
import pytest
from scenes import chain, cradle

import saltus


@pytest.fixture(scope="module")
def model() -> saltus.Model:
    builder = saltus.ModelBuilder("mixed")
    builder.add_body("base", saltus.Sphere(0.2), mass=2.0)
    builder.add_body(
        "arm",
        saltus.Box((0.1, 0.2, 0.3)),
        mass=1.0,
        X=saltus.Pose((0.3, 0, 0)),
        parent="base",
        joint="spherical",
    )
    builder.add_body(
        "hand",
        saltus.Capsule(0.05, 0.1),
        mass=0.5,
        X=saltus.Pose((0, 0.4, 0)),
        parent="arm",
        joint="revolute",
    )
    return builder.build()


def rows_of(model: saltus.Model, count: int):
    rng = np.random.default_rng(count)
    q = np.stack([model.random_configuration(rng) for _ in range(count)])
    return q, rng.normal(size=(count, model.n_v)), rng.normal(size=(count, model.n_v))


def test_one_configuration_has_no_rows(model):
    (q,), (v,), (a,) = rows_of(model, 1)
    n = model.n_v
    assert model.jacobian(q, "hand").shape == (6, n)
    assert model.jacobian(q, "hand", (0, 0, 0.1)).shape == (3, n)
    assert model.inverse_dynamics(q, v, a).shape == (n,)
    assert model.accelerations(q, v).shape == (n,)
    assert model.gravity_forces(q).shape == (n,)
    assert model.centre_of_mass(q).shape == (3,)
    assert model.momentum(q, v).shape == (6,)
    assert model.all_poses(q).shape == (len(model.links), 4, 4)
    assert model.all_shape_poses(q).shape == (len(model.shapes), 4, 4)


def test_rows_are_the_configurations_one_by_one(model):
    q, v, a = rows_of(model, 5)
    tau = model.inverse_dynamics(q, v, a)
    results = {
        "jacobian": model.jacobian(q, "hand"),
        "point": model.jacobian(q, "hand", (0, 0, 0.1)),
        "tau": tau,
        "a": model.accelerations(q, v, tau),
        "gravity": model.gravity_forces(q),
        "centre": model.centre_of_mass(q),
        "momentum": model.momentum(q, v),
        "poses": model.all_poses(q),
        "shapes": model.all_shape_poses(q),
    }
    np.testing.assert_allclose(results["a"], a, atol=1e-11)
    for row in range(5):
        frames = model.at(q[row])
        expected = {
            "jacobian": frames.jacobian("hand"),
            "point": frames.jacobian("hand", (0, 0, 0.1)),
            "tau": frames.inverse_dynamics(v[row], a[row]),
            "a": frames.accelerations(v[row], tau[row]),
            "gravity": frames.gravity_forces(),
            "centre": frames.centre_of_mass(),
            "momentum": frames.momentum(v[row]),
            "poses": frames.all_poses(),
            "shapes": frames.all_shape_poses(),
        }
        for name, value in expected.items():
            np.testing.assert_array_equal(results[name][row], value, err_msg=name)


def test_poses_are_the_same_everywhere(model):
    q, _, _ = rows_of(model, 4)
    every, shapes = model.all_poses(q), model.all_shape_poses(q)
    for i, link in enumerate(model.links):
        np.testing.assert_array_equal(every[:, i], model.poses(q, link.name))
        np.testing.assert_array_equal(every[2, i], model.pose(q[2], link).matrix())
    for i, shape in enumerate(model.shapes):
        np.testing.assert_array_equal(shapes[:, i], model.shape_poses(q, shape.name))
        placed = model.pose(q[1], shape.link).matrix() @ shape.X_LG.matrix()
        np.testing.assert_allclose(shapes[1, i], placed, atol=1e-15)


def test_a_jacobian_times_v_is_the_velocity(model):
    q, v, _ = rows_of(model, 3)
    rates = np.einsum("rij,rj->ri", model.jacobian(q, "hand"), v)
    np.testing.assert_allclose(rates, model.velocities(q, v, "hand"), atol=1e-14)


def test_a_free_base_moves_by_its_own_velocity(model):
    (q,), _, _ = rows_of(model, 1)
    J = model.jacobian(q, "base")
    np.testing.assert_allclose(J[3:, :3], np.eye(3), atol=1e-15)  # v, then w, both in the world
    np.testing.assert_allclose(J[:3, 3:6], np.eye(3), atol=1e-15)
    assert not J[:, 6:].any()


def test_one_row_stands_for_all(model):
    q, v, _ = rows_of(model, 3)
    np.testing.assert_array_equal(
        model.inverse_dynamics(q, v[0]), model.inverse_dynamics(q, np.tile(v[0], (3, 1)))
    )
    np.testing.assert_array_equal(
        model.momentum(q, v, about=(1, 2, 3)),
        model.momentum(q, v, about=np.tile([1, 2, 3], (3, 1))),
    )
    assert model.accelerations(q[0], v).shape == (3, model.n_v)
    assert model.all_poses(np.zeros((0, model.n_q))).shape == (0, len(model.links), 4, 4)


def test_names_are_taken():
    model = chain(3)
    q, v = {"joint_1": 0.4}, {"joint_2": 1.0}
    forces = model.inverse_dynamics(q, v, {"joint_0": 2.0})
    a = model.accelerations(q, v, dict(zip(model.velocity_names, forces, strict=True)))
    np.testing.assert_allclose(a, [2, 0, 0], atol=1e-12)


def test_momentum_about_points(model):
    (q,), (v,), _ = rows_of(model, 1)
    whole = model.momentum(q, v)
    about = model.momentum(q, v, about=(1, 2, 3))
    np.testing.assert_allclose(about[:3], whole[:3] - np.cross((1, 2, 3), whole[3:]), atol=1e-13)
    np.testing.assert_array_equal(about[3:], whole[3:])
    # of a free base these are its momenta, and that of its angular velocity is about its origin
    p, base = model.state(q, v).p, model.pose(q, "base").p
    np.testing.assert_allclose(whole[3:], p[:3], atol=1e-13)
    np.testing.assert_allclose(model.momentum(q, v, about=base)[:3], p[3:6], atol=1e-13)


def test_frames_move_on(model):
    q, _, _ = rows_of(model, 2)
    frames = model.at(q[0])
    first = frames.jacobian("hand")
    mass = frames.mass_matrix()
    assert frames.set(q[1]) is frames
    np.testing.assert_array_equal(frames.q, q[1])
    np.testing.assert_array_equal(frames.jacobian("hand"), model.jacobian(q[1], "hand"))
    frames.set(q[0])
    np.testing.assert_array_equal(frames.jacobian("hand"), first)
    np.testing.assert_array_equal(mass, model.mass_matrix(q[0]))
    np.testing.assert_array_equal(frames.gaps().phi, model.gaps(q[0]).phi)
    np.testing.assert_array_equal(frames.shape_pose(2).p, model.at(q[0]).shape_pose("hand").p)
    assert frames.mass == pytest.approx(3.5)
    assert "Frames('mixed'" in repr(frames)
    assert frames.model.name == "mixed"


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda m: m.jacobian(np.zeros((2, 3)), "hand"), "rows of q have 3 entries; the model has"),
        (lambda m: m.jacobian(None, "hnd"), "no link 'hnd'; there are world, base, arm, hand"),
        (lambda m: m.jacobian(None, "hand", (0, 1)), "point = (0, 1); it has three finite numbers"),
        (lambda m: m.jacobian(np.zeros((2, 3, 4)), "hand"), "q has shape (2, 3, 4)"),
        (
            lambda m: m.inverse_dynamics(None, np.ones((2, 10)), np.ones((3, 10))),
            "v has 2 rows and",
        ),
        (lambda m: m.inverse_dynamics(None, {"arm": (1, 2)}), "takes an angular velocity x y z"),
        (lambda m: m.inverse_dynamics(None, None, [1, 2]), "a has 2 entries; the model has 10"),
        (lambda m: m.accelerations(None, None, {"elbow": 1}), 'no velocity "elbow"; there are'),
        (lambda m: m.momentum(None, None, about=3), "about = 3; it is a point"),
        (lambda m: m.all_poses(np.full((2, m.n_q), np.nan)), "row 0 of q is not finite"),
        (lambda m: m.all_poses(np.zeros((2, m.n_q))), "row 0 of q has the quaternion"),
        (lambda m: m.at({"arm": 3}), 'joint "arm" takes a quaternion'),
    ],
)
def test_errors_name_what_is_wrong(model, call, message):
    with pytest.raises(saltus.ModelError) as error:
        call(model)
    assert message in str(error.value)


def test_without_mass_there_is_no_centre():
    with pytest.raises(saltus.ModelError, match="nothing that moves has mass"):
        saltus.ModelBuilder().build().centre_of_mass(None)


def test_a_cradle_of_many_balls_is_one_pass():
    model = cradle(30)
    q = np.random.default_rng(1).normal(size=(20, model.n_q))
    every = model.all_poses(q)
    assert every.shape == (20, 61, 4, 4)
    np.testing.assert_array_equal(every[:, 60], model.poses(q, "ball_29"))
