"""Inertias of URDF files that no body has, or that are not there: how they are read."""

from __future__ import annotations

import numpy as np
import pytest
from flawed_texts import BALL, arm, collision, diagonal, flawed, inertial, sound, swing
from mesh_texts import obj

import saltus


def test_a_moment_without_a_mass_of_what_is_fixed_to_the_world():
    massless = inertial(0, diagonal(0.05, 0.06, 0.03), "")
    model = flawed(arm(base=massless), 'link "base" has an inertia but no mass', "not used")
    assert swing(model) == pytest.approx(swing(sound(arm())))
    link = f'<link name="stand">{massless}</link>'
    fixed = '<joint name="f" type="fixed"><parent link="base"/><child link="stand"/></joint>' + link
    flawed(arm(more=fixed), 'link "stand" has an inertia but no mass', "fixed to the world")


def test_a_moment_without_a_mass_of_what_is_welded_is_added():
    foot = f'<link name="foot">{inertial(0, diagonal(0.02, 0.02, 0.02), "")}</link>'
    weld = '<joint name="f" type="fixed"><parent link="arm"/><child link="foot"/></joint>'
    model = flawed(arm(more=foot + weld), 'link "foot" has an inertia but no mass', "is added")
    assert swing(model) == pytest.approx(swing(sound(arm())) + 0.02)


def test_what_moves_needs_a_mass():
    text = arm(body=inertial(0, BALL, ""))
    with pytest.raises(saltus.ModelError, match=r':3: link "arm" has an inertia but no mass, and'):
        saltus.load_urdf(text)


def test_parts_of_an_inertial_that_are_not_there():
    at = '<origin xyz="0 0 -0.5"/>'
    point = arm(body=f'<inertial>{at}<mass value="2"/></inertial>')
    assert swing(flawed(point, "has no <inertia> in <inertial>", "point mass")) == 2 * 0.5**2
    moments = '<inertia ixx="0.1" iyy="0.1" izz="0.1"/>'
    model = flawed(arm(body=inertial(1, moments)), '<inertia> without attribute "ixy"', "2 more")
    assert swing(model) == pytest.approx(0.35)
    base = f"<inertial>{BALL}</inertial>"
    with pytest.warns(saltus.ModelWarning) as caught:
        saltus.load_urdf(arm(base=base))
    assert "has no <mass> in <inertial>; it is read as 0" in str(caught[0].message)


NEAR = inertial(1, diagonal(0.00305792, 0.0236436, 0.0268997))  # by 0.7 % of the greatest


def test_moments_that_are_off_by_little():
    model = flawed(arm(body=NEAR), 'link "arm" has principal moments', "less than 2 %")
    assert swing(model) == pytest.approx(0.0236436 + 0.25)
    limit = 1.0 / (1 - 0.06)  # of the greatest, where each is changed by 2 % of it
    assert flawed(arm(body=inertial(1, diagonal(0.5, 0.5, 0.999 * limit))), "principal moments")
    for moments in ((0.5, 0.5, 1.001 * limit), (-0.001, 1, 1)):
        with pytest.raises(
            saltus.ModelError, match=r'no body can have.*inertia="as_given" of load'
        ):
            saltus.load_urdf(arm(body=inertial(1, diagonal(*moments))))


def test_any_moments_as_given():
    text = arm(body=inertial(1, diagonal(0.1, 0.2, 5)))
    with pytest.warns(saltus.ModelWarning, match=r"\(0.1 0.2 5\) .* used as they are"):
        model = saltus.load_urdf(text, inertia="as_given")
    assert swing(model) == pytest.approx(0.45)
    assert saltus.simulate(model, q={"j": 1.0}, duration=1.0).complete


def test_checks_of_a_link_in_code():
    body = saltus.BodyInertia(1.0, (0, 0, -0.5), np.diag([0.1, 0.2, 5]))
    near = saltus.BodyInertia(1.0, (0, 0, -0.5), np.diag([0.00305792, 0.0236436, 0.0268997]))
    for inertia, check, ok in (
        (near, "strict", False), (near, "lenient", True), (body, "lenient", False),
        (body, saltus.InertiaCheck.as_given, True),
    ):  # fmt: skip
        builder = saltus.ModelBuilder().add_link("arm", inertia, check=check)
        builder.add_joint("j", "revolute", parent="world", child="arm")
        if ok:
            with pytest.warns(saltus.ModelWarning, match="principal moments"):
                builder.build()
        else:
            with pytest.raises(saltus.ModelError, match="principal moments"):
                builder.build()


def test_a_robot_without_inertias_is_told_the_way_out():
    box = '<geometry><box size="0.2 0.3 0.4"/></geometry>'
    for element in ("collision", "visual"):
        bare = arm(body=f'<{element}><origin xyz="0 0 -0.5"/>{box}</{element}>')
        with pytest.raises(saltus.ModelError, match=r'moves no mass.*inertia="from_shapes"'):
            saltus.load_urdf(bare)
        model = sound(bare, inertia="from_shapes")
        assert model.links[1].mass == pytest.approx(24.0)
        assert swing(model) == pytest.approx(24 * (0.2**2 + 0.4**2) / 12 + 24 / 4)
        assert len(model.visuals) == (element == "visual")
        assert sound(bare, inertia="from_shapes", visuals=False).visuals == []


def test_masses_of_the_file_are_kept_beside_those_of_shapes():
    box = collision('<box size="1 1 1"/>', "")
    model = sound(arm(base=box, body=inertial(3) + box), inertia="from_shapes")
    assert [link.mass for link in model.links] == [1000.0, 3.0]


def test_meshes_are_filled_to_their_hulls(tmp_path):
    (tmp_path / "a.obj").write_text(obj())
    (tmp_path / "a.urdf").write_text(
        arm(body='<visual><geometry><mesh filename="a.obj"/></geometry></visual>')
    )
    model = sound(tmp_path / "a.urdf", inertia="from_shapes")
    assert model.links[1].mass == pytest.approx(1000 / 6)


def test_the_mass_of_the_root_is_shown():
    assert sound(arm(base=inertial(5))).links[0].mass == 5


def test_a_free_root_without_a_mass_is_named():
    with pytest.raises(saltus.ModelError, match=r'"root" moves no mass.*link "base" has none'):
        saltus.load_urdf(arm(), root_joint="floating")


def test_a_run_with_masses_of_shapes_is_loaded_with_them(tmp_path):
    model = sound(arm(body=collision('<box size="1 1 1"/>')), inertia="from_shapes")
    run = saltus.simulate(model, q={"j": 0.1}, duration=0.1, progress=False)
    run.save(tmp_path / "run.h5")
    assert saltus.load(tmp_path / "run.h5").model.links[1].mass == model.links[1].mass
