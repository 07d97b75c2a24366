"""Saving and loading trajectories."""

from __future__ import annotations

import h5py
import numpy as np
import pytest
from scenes import bouncing_ball, chain_on_a_body, cradle_run, puck

import saltus
from saltus.records.files import OPTIONS
from saltus.records.tables import ARRAYS, NUMBERS


def assert_same(a: saltus.Trajectory, b: saltus.Trajectory) -> None:
    for name in (*ARRAYS, "impacts", "impulses"):
        x, y = getattr(a, name), getattr(b, name)
        assert x.dtype == y.dtype
        assert x.tobytes() == y.tobytes(), name  # to the last bit, also of zeros and NaN
        assert not y.flags.writeable
    for name in (*NUMBERS, "coordinate_names", "pair_names"):
        assert getattr(a, name) == getattr(b, name), name
    for name in (*OPTIONS, "law"):
        assert getattr(a.options, name) == getattr(b.options, name), name


def test_a_file_is_complete(tmp_path):
    run = cradle_run()
    run.save(tmp_path / "run.h5")
    again = saltus.load(tmp_path / "run.h5")
    assert_same(run, again)
    assert again.model.source == run.model.source
    assert again.model.coordinate_names == run.model.coordinate_names
    np.testing.assert_array_equal(again.poses("ball_1"), run.poses("ball_1"))
    assert again.impact(0).pairs == run.impact(0).pairs
    # Going on gives the same bits as going on with the original.
    ends = [saltus.simulate(r.model, state=r.state(-1), duration=0.2).state(-1)
            for r in (run, again)]  # fmt: skip
    assert ends[0] == ends[1]
    again.save(tmp_path / "again.h5")
    assert_same(run, saltus.load(tmp_path / "again.h5"))
    assert [path.name for path in sorted(tmp_path.iterdir())] == ["again.h5", "run.h5"]


def test_options_of_the_model_are_kept(tmp_path):
    floating = saltus.load_urdf(
        chain_on_a_body(), gravity=(0, 0, -1.62), root_joint=saltus.JointType.floating
    )
    run = saltus.simulate(
        floating, v={"joint_0": 1.0}, duration=0.1, h=0.005, law=saltus.ImpactLaw.discrete_energy,
        max_impacts=77, rest=1e-9,
    )  # fmt: skip
    run.save(tmp_path / "run.h5")
    again = saltus.load(tmp_path / "run.h5")
    assert_same(run, again)
    assert again.options.max_impacts == 77
    assert again.model.n_q == 9
    assert again.model.gravity[2] == -1.62


def rubbed() -> saltus.Trajectory:
    return saltus.simulate(
        puck(restitution=0.5, friction=0.2), q={"z": 0.1}, v={"x": 2.0}, duration=0.5
    )


def test_friction_is_kept(tmp_path):
    run = rubbed()
    assert run.impulses["tangential"].any()
    run.save(tmp_path / "run.h5")
    again = saltus.load(tmp_path / "run.h5")
    assert_same(run, again)
    assert str(again.impact(0)) == str(run.impact(0))


def test_contacts_are_kept_where_they_were_recorded(tmp_path):
    run = saltus.simulate(
        puck(restitution=0.5, friction=0.2), v={"x": 2.0}, duration=0.5, record_contacts=True
    )
    assert len(run.contacts) > 0
    run.save(tmp_path / "run.h5")
    again = saltus.load(tmp_path / "run.h5")
    assert_same(run, again)
    assert again.contacts.dtype == run.contacts.dtype
    assert again.contacts.tobytes() == run.contacts.tobytes()
    assert not again.contacts.flags.writeable
    rubbed().save(tmp_path / "none.h5")
    with pytest.raises(saltus.ModelError, match="were not recorded"):
        _ = saltus.load(tmp_path / "none.h5").contacts


def test_files_from_before_there_were_points_are_read(tmp_path):
    run = rubbed()
    run.save(tmp_path / "old.h5")
    known = ["impact", "pair", "lambda", "tangential"]
    with h5py.File(tmp_path / "old.h5", "a") as file:
        old = file["impulses"][()][known]
        del file["impulses"]
        file["impulses"] = old
    again = saltus.load(tmp_path / "old.h5")
    for name in known:
        np.testing.assert_array_equal(again.impulses[name], run.impulses[name])
    assert np.isnan(again.impulses["point"]).all()
    assert np.isnan(again.impact(0).normals).all()
    assert str(again.impact(0)) == str(run.impact(0))


def test_files_from_before_there_was_friction_are_read(tmp_path):
    run = rubbed()
    run.save(tmp_path / "old.h5")
    with h5py.File(tmp_path / "old.h5", "a") as file:
        old = file["impulses"][()][["impact", "pair", "lambda"]]
        del file["impulses"]
        file["impulses"] = old
    again = saltus.load(tmp_path / "old.h5")
    for name in ("impact", "pair", "lambda"):
        np.testing.assert_array_equal(again.impulses[name], run.impulses[name])
    assert again.impulses.dtype == run.impulses.dtype
    assert not again.impulses["tangential"].any()
    assert np.isnan(again.impulses["point"]).all()
    assert np.isnan(again.impulses["normal"]).all()
    assert np.isnan(again.impact(0).points).all()
    assert not again.impulses.flags.writeable
    assert "friction" not in str(again.impact(0))


def test_a_model_without_collisions_is_loaded_so(tmp_path):
    run = saltus.simulate(cradle_run().model.without_collisions(), duration=0.1)
    run.save(tmp_path / "run.h5")
    assert saltus.load(tmp_path / "run.h5").model.pairs == []


def test_a_model_built_in_code_is_in_the_file(tmp_path):
    model = bouncing_ball().build()
    run = saltus.simulate(model, duration=1.0)
    run.save(tmp_path / "ball.h5")
    with h5py.File(tmp_path / "ball.h5") as file:
        assert file.attrs["model"] == "JSON in description/document"
        assert "urdf" not in file
    again = saltus.load(tmp_path / "ball.h5")
    assert_same(run, again)
    assert again.poses("ball").tobytes() == run.poses("ball").tobytes()
    assert_same(run, saltus.load(tmp_path / "ball.h5", model=model))
    with pytest.raises(saltus.ModelError, match="the model has swing_0"):
        saltus.load(tmp_path / "ball.h5", model=cradle_run().model)


@pytest.mark.parametrize("root_joint", saltus.JointType)
def test_a_single_link_with_any_root(tmp_path, root_joint):
    text = chain_on_a_body(1).partition("<joint")[0] + "</robot>"
    model = saltus.load_urdf(text, root_joint=root_joint)
    saltus.simulate(model, duration=0.1).save(tmp_path / "run.h5")
    assert saltus.load(tmp_path / "run.h5").model.coordinate_names == model.coordinate_names


def test_files_that_are_none(tmp_path):
    with pytest.raises(saltus.ModelError, match="no such file"):
        saltus.load(tmp_path / "nowhere.h5")
    (tmp_path / "text.h5").write_text("no HDF5")
    with pytest.raises(saltus.ModelError, match=r"text.h5 is no trajectory"):
        saltus.load(tmp_path / "text.h5")
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file["x"] = 1
    with pytest.raises(saltus.ModelError, match=r"other.h5 holds no trajectory"):
        saltus.load(tmp_path / "other.h5")
    cradle_run().save(tmp_path / "new.h5")
    with h5py.File(tmp_path / "new.h5", "a") as file:
        file.attrs["version"] = 99
    with pytest.raises(saltus.ModelError, match="format version 99"):
        saltus.load(tmp_path / "new.h5")
    cradle_run().save(tmp_path / "less.h5")
    with h5py.File(tmp_path / "less.h5", "a") as file:
        del file["q"]
    with pytest.raises(saltus.ModelError, match="no trajectory that saltus can read"):
        saltus.load(tmp_path / "less.h5")


def test_what_cannot_be_written_to(tmp_path):
    with pytest.raises(saltus.ModelError, match="there is no folder"):
        cradle_run().save(tmp_path / "nowhere" / "run.h5")
    with pytest.raises(saltus.ModelError, match="is a folder"):
        cradle_run().save(tmp_path)


def test_a_failed_save_leaves_the_old_file(tmp_path, monkeypatch):
    path = tmp_path / "run.h5"
    cradle_run().save(path)
    before = path.read_bytes()
    broken = saltus.simulate(cradle_run().model, duration=0.1)
    monkeypatch.setattr("saltus.records.files.ARRAYS", ("t", "nonsense"))
    with pytest.raises(AttributeError):
        broken.save(path)
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]


def test_other_programs_can_read_the_file(tmp_path):
    cradle_run().save(tmp_path / "run.h5")
    with h5py.File(tmp_path / "run.h5") as file:
        assert file.attrs["law"] == "nodal_energy"
        law = h5py.check_enum_dtype(file["impacts"].dtype["law"])
        assert law == {law.name: law.value for law in saltus.ImpactLaw}
        assert law["nodal_energy"] == 0
        assert file["urdf"].asstr()[()].startswith("<robot")


@pytest.mark.parametrize("effects", [saltus.JointEffects.limits, saltus.JointEffects.none])
def test_what_acts_in_the_joints_is_kept(tmp_path, effects):
    model = saltus.load_urdf(limited_arm(), effects=effects)
    saltus.simulate(model, duration=0.1).save(tmp_path / "run.h5")
    again = saltus.load(tmp_path / "run.h5").model
    assert again.limit_names == model.limit_names
    np.testing.assert_array_equal(again.damping, model.damping)


def limited_arm() -> str:
    """Return a link on a joint with limits and damping."""
    return """<robot name="arm"><link name="base"/><link name="arm"><inertial><mass value="1"/>
    <inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial></link>
    <joint name="elbow" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="2" effort="9" velocity="3"/><dynamics damping=".1"/></joint></robot>"""
