"""Models and runs go to other processes and are the same there, to the last bit."""

from __future__ import annotations

import copy
import multiprocessing
import pickle

import numpy as np
import pytest
from scenes import bouncing_ball, cradle, puck

import saltus


def again(thing):
    return pickle.loads(pickle.dumps(thing))


def everything() -> saltus.Model:
    """Return a model that has some of all that a builder can be told."""
    rng = np.random.default_rng(1)
    solid = saltus.Convex(rng.normal(size=(40, 3)) * 0.1)
    builder = saltus.ModelBuilder("zoo", root="ground").set_gravity((0.1, -0.2, -9.7))
    builder.set_solver(saltus.TreeSolver.sweep).add_warning("a warning")
    shapes = [
        saltus.Sphere(0.1),
        saltus.Capsule(0.05, 0.1),
        saltus.Box((0.1, 0.1, 0.07)),
        saltus.Cylinder(0.1, 0.05),
        saltus.Ellipsoid((0.1, 0.08, 0.06)),
        solid,
    ]
    for i, shape in enumerate(shapes):
        body = saltus.BodyInertia(1.0 + i, (0, 0, 0.01), np.diag([0.1, 0.11, 0.12]))
        builder.add_link(f"body_{i}", body)
        placed = saltus.Pose((0.5 * i, 0, 0.3), saltus.rotation_from_rpy(0.1 * i, 0.2, 0.3))
        floating = saltus.JointType.floating
        builder.add_joint(f"free_{i}", floating, parent="ground", child=f"body_{i}", X_PJ=placed)
        builder.add_shape(f"body_{i}", shape, saltus.Pose((0, 0, 0.01)))
    hinge = {"axis": (1, 2, 3), "lower": -1.0, "upper": 2.0, "damping": 0.1, "friction": 0.2}
    revolute = saltus.JointType.revolute
    for i in range(2):
        builder.add_link(f"arm_{i}", saltus.solid_box(0.5, (0.1, 0.02, 0.02)))
        mimic = saltus.Mimic("hinge_0", -0.5, 0.1) if i else None
        builder.add_joint(
            f"hinge_{i}", revolute, parent=f"body_{i}", child=f"arm_{i}", mimic=mimic, **hinge
        )
    builder.add_half_space("floor", (0.01, 0.02, 1), -0.1)
    builder.add_floor("ice", normal=(0, 0.1, 1), offset=-0.2, restitution=0.1, friction=0.01)
    builder.add_floor("wall", normal=(1, 0, 0), offset=-9, material="brick")
    builder.set_contact("steel", "brick", restitution=0.9, friction=0.2)
    builder.add_body("cube", saltus.Box((0.1, 0.1, 0.1)), density=500, X=saltus.Pose((0, 3, 0)))
    builder.set_adjacent_links(saltus.AdjacentLinks.watched)
    other = saltus.ModelBuilder("other").set_adjacent_links(saltus.AdjacentLinks.watched)
    other.add_body("ball", saltus.Sphere(0.1), mass=1, X=saltus.Pose((0, 5, 0)))
    builder.add(other, "other_")
    builder.add_exclusion("body_0", "body_1").add_body_exclusion("body_2", "ground")
    builder.set_group("body_3", "round").add_group_exclusion("round", "round")
    builder.set_material("body_0", "steel").set_material("ground", "clay")
    builder.set_contact("steel", "clay", restitution=0.3, friction=0.4)
    return builder.set_default_contact(restitution=0.6, friction=0.1).build()


def assert_same_runs(model: saltus.Model, other: saltus.Model, **options) -> None:
    runs = [saltus.simulate(each, progress=False, **options) for each in (model, other)]
    for name in ("t", "q", "v", "p", "total", "shadow", "impacts", "impulses"):
        a, b = (getattr(run, name) for run in runs)
        assert a.tobytes() == b.tobytes(), name
    assert runs[0].pair_names == runs[1].pair_names


def test_a_model_keeps_all_that_it_was_built_of():
    model = everything()
    copied = again(model)
    for name in ("name", "source", "warnings", "link_names", "joint_names", "coordinate_names"):
        assert getattr(copied, name) == getattr(model, name), name
    np.testing.assert_array_equal(copied.gravity, model.gravity)
    assert copied.pair_names == model.pair_names
    assert copied.pair_kinds() == model.pair_kinds()
    assert repr(copied.solvers) == repr(model.solvers)
    for a, b in zip(copied.coordinates, model.coordinates, strict=True):
        for name in ("lower", "upper", "velocity", "effort", "damping", "friction"):
            assert getattr(a, name) == getattr(b, name)
    for pair in range(model.n_pairs):
        a, b = copied.contact_properties(pair), model.contact_properties(pair)
        assert (a.restitution, a.friction) == (b.restitution, b.friction)
    assert pickle.dumps(copied) == pickle.dumps(model)


def test_steps_are_the_same_bits():
    assert_same_runs(everything(), again(everything()), duration=0.5)
    model = saltus.load_urdf(saltus.scenes.cradle(5))
    assert again(model).source == model.source
    assert_same_runs(model, again(model), q={"swing_0": 0.3}, duration=1.0)


def test_a_model_without_collisions_stays_so():
    model = cradle().without_collisions()
    assert again(model).n_pairs == 0
    assert_same_runs(model, again(model), q={"swing_0": 0.3}, duration=0.6)


def test_shapes_and_parts():
    for shape in (saltus.Sphere(0.1), saltus.Box((1, 2, 3)), saltus.HalfSpace()):
        assert repr(again(shape)) == repr(shape)
    hull = saltus.Convex([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])
    assert again(hull).vertices.tobytes() == hull.vertices.tobytes()
    assert again(hull).faces == hull.faces
    body = saltus.solid_box(2.0, (0.1, 0.2, 0.3))
    assert repr(again(body)) == repr(body)
    assert again(saltus.Mimic("a", 2.0, 0.1)).offset == 0.1
    assert again(puck(friction=0.3).contact_properties(0)).friction == 0.3


def test_copies_are_the_model():
    model = bouncing_ball().build()
    for copied in (copy.copy(model), copy.deepcopy(model)):
        assert repr(copied) == repr(model)


def test_runs_from_before_trajectory_moved_are_read():
    own = run(cradle(2), 0.3)
    old = pickle.dumps(own, protocol=2).replace(b"csaltus.runs.trajectory", b"csaltus.trajectory")
    assert b"csaltus.trajectory\nTrajectory" in old
    assert pickle.loads(old).q.tobytes() == own.q.tobytes()


def test_options_but_no_functions():
    options = saltus.StepOptions(
        0.002, "compensated", False, order=saltus.ImpactOrder.symmetric, certify=True,
        max_iterations=9, max_impacts=8, max_halvings=3, max_impulses=7, rest=1e-9,
        simultaneous=1e-8, strict=True,
    )  # fmt: skip
    names = [name for name in vars(saltus.StepOptions) if not name.startswith("_")]
    assert len(names) == 12
    for name in names:
        assert getattr(again(options), name) == getattr(options, name)
    with pytest.raises(TypeError, match="whose law is a function have no pickle"):
        pickle.dumps(saltus.StepOptions(law=lambda problem: problem.p))


def run(model: saltus.Model, angle: float) -> saltus.Trajectory:
    return saltus.simulate(model, q={"swing_0": angle}, duration=0.7, progress=False)


def test_processes_share_a_model():
    angles = (0.2, 0.3)
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        runs = pool.starmap(run, [(cradle(), angle) for angle in angles])
    for angle, there in zip(angles, runs, strict=True):
        here = run(cradle(), angle)
        assert there.q.tobytes() == here.q.tobytes()
        assert there.impulses.tobytes() == here.impulses.tobytes()
        assert there.summary() == here.summary()
