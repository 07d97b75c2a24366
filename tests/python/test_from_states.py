"""Runs of given rows, and builders that are changed: what Python adds to the C++ tests."""

from __future__ import annotations

import gc
import pickle

import numpy as np
import pytest
from scenes import chain, cradle_run

import saltus


def free_body() -> saltus.Model:
    return saltus.ModelBuilder().add_body("b", saltus.Box((0.1, 0.2, 0.3)), mass=2.0).build()


def test_rows_of_a_run_make_the_run_again():
    run = cradle_run()
    by_v = saltus.Trajectory.from_states(run.model, run.t, run.q, run.v)
    by_p = saltus.Trajectory.from_states(run.model, run.t, run.q, p=run.p)
    for name in ("t", "q", "kinetic", "potential", "shadow"):
        np.testing.assert_array_equal(getattr(by_p, name), getattr(run, name), err_msg=name)
    np.testing.assert_array_equal(by_v.v, run.v)
    np.testing.assert_array_equal(by_p.p, run.p)
    np.testing.assert_array_equal(by_p.v, run.v)
    np.testing.assert_allclose(by_v.p, run.p, atol=1e-14)
    assert by_p.energy_error == run.energy_error
    assert by_p.complete
    assert len(by_p.impacts) == len(by_p.impulses) == len(by_p.fallbacks) == 0
    assert by_p.options.h == pytest.approx(0.01)


def test_they_are_saved_and_pickled_as_other_runs(tmp_path):
    model = chain(2)
    run = saltus.Trajectory.from_states(model, [0, 0.5, 0.5, 1], np.ones((4, 2)), h=0.25)
    assert not run.v.any()
    assert run.options.h == 0.25
    run.save(tmp_path / "run.h5")
    again = saltus.load(tmp_path / "run.h5")
    np.testing.assert_array_equal(again.potential, run.potential)
    np.testing.assert_array_equal(again.t, [0, 0.5, 0.5, 1])
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(run)).q, run.q)


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        (([], np.zeros((0, 7))), "t has no entries"),
        (([0, 1], np.zeros((3, 7))), "q has shape (3, 7); with these times and this model it has"),
        (([0, 1], np.zeros((2, 6))), "q has shape (2, 6)"),
        (([0], np.zeros((1, 7))), "row 0 of q has the quaternion"),
        (([1, 0], np.zeros((2, 7))), "t[1] = 0.000000 is before"),
        (([0, np.nan], np.zeros((2, 7))), "t[1] is not finite"),
        (([0], "xy"), "q is no array of numbers"),
        (([[0]], np.zeros((1, 7))), "t has shape (1, 1); it must have shape (rows,)"),
    ],
)
def test_wrong_rows_are_explained(rows, message):
    with pytest.raises(saltus.ModelError) as error:
        saltus.Trajectory.from_states(free_body(), *rows)
    assert message in str(error.value)


def test_velocities_are_judged_too():
    model = free_body()
    q = [model.neutral()]
    for given, message in (
        ({"v": np.full((1, 6), np.inf)}, "row 0 of v[0] = inf is not finite"),
        ({"p": np.zeros((1, 7))}, "p has shape (1, 7)"),
        ({"v": np.zeros((1, 6)), "p": np.zeros((1, 6))}, "give either v or p"),
        ({"h": -1.0}, "h = -1.000000 s; it is positive"),
    ):
        with pytest.raises(saltus.ModelError) as error:
            saltus.Trajectory.from_states(model, [0.0], q, **given)
        assert message in str(error.value)


def test_parts_of_a_builder_outlive_their_names():
    link = saltus.read_urdf(saltus.scenes.chain(2)).link("link_0")  # keeps its builder
    gc.collect()
    link.mass = 3.0
    assert link.mass == 3.0


def test_every_property_of_a_joint_is_set_and_kept():
    builder = saltus.read_urdf(saltus.scenes.chain(2))
    joint = builder.joint("joint_1")
    assert (joint.type, joint.parent, joint.child) == (
        saltus.JointType.continuous,
        "link_0",
        "link_1",
    )
    new = {"lower": -1.0, "upper": 2.0, "velocity": 3.0, "effort": 4.0, "damping": 0.1}
    for name, value in {**new, "friction": 0.2}.items():
        setattr(joint, name, value)
        assert getattr(joint, name) == value
    joint.axis, joint.X_PJ = (0, 0, 2), saltus.Pose((1, 2, 3))
    joint.mimic = saltus.Mimic("joint_0", 0.5)
    model = builder.build()
    assert model.n_q == 1
    np.testing.assert_array_equal(model.joint("joint_1").axis, (0, 0, 1))
    np.testing.assert_array_equal(model.joint("joint_1").X_PJ.p, (1, 2, 3))
    assert model.joint("joint_1").mimic.multiplier == 0.5
    joint.mimic = None
    assert builder.build().n_q == 2
    builder.link("link_0").inertia = saltus.BodyInertia(5.0, (0, 0, 1), np.eye(3))
    assert builder.build().link("link_0").inertia.c_J[2] == 1
    builder.link("link_0").material = "steel"
    assert builder.link("link_0").material == "steel"
    assert builder.link("link_1").material is None


def test_a_changed_model_is_not_saved_as_the_text_it_was_read_from(tmp_path):
    builder = saltus.read_urdf(saltus.scenes.chain(1))
    builder.link("link_0").mass = 7.0
    run = saltus.simulate(builder.build(), duration=0.1)
    run.save(tmp_path / "run.h5")
    again = saltus.load(tmp_path / "run.h5")
    assert again.model is None or again.model.link("link_0").mass == 7.0


def test_a_models_builder_builds_it_again():
    model = free_body()
    again = model.builder().build()
    np.testing.assert_array_equal(again.mass_matrix(None), model.mass_matrix(None))
    assert again.link_names == model.link_names
