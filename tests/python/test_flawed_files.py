"""URDF files that are not as URDF has them and that other readers read: a warning, or strict."""

from __future__ import annotations

import numpy as np
import pytest
from flawed_texts import arm, collision, diagonal, flawed, inertial, sound

import saltus
from saltus.cli.main import main

NUMBERS = {
    '<origin xyz="1, 2, 3"/>': "numbers are separated by spaces; commas are read as these",
    '<origin xyz="1,2,3"/>': "numbers are separated by spaces; commas are read as these",
    '<origin xyz="1. 2.0. 3"/>': "a number ends with a second dot; it is read without",
    '<origin xyz="1 2 3 4"/>': "3 numbers are needed, 4 given; the first of them are read",
    '<origin xyz="1 2 3"/><origin xyz="4 5 6"/>': "has a second <origin>; the first is in line 4 ",
}


@pytest.mark.parametrize("origin", list(NUMBERS))
def test_numbers_and_elements_that_are_too_many_or_ill_written(origin):
    what, _, reading = NUMBERS[origin].partition("; ")
    model = flawed(arm(joint=origin), what, reading)
    np.testing.assert_array_equal(model.pose(None, "arm").p, (1, 2, 3))


@pytest.mark.parametrize("wrong", ["0,1 0,2 0,3", "1 2", "1.2.3 0 0", "1;2;3", "1 2 3m"])
def test_numbers_that_may_mean_anything(wrong):
    with pytest.raises(saltus.ModelError, match=r":4: joint \"j\" has <origin"):
        saltus.load_urdf(arm(joint=f'<origin xyz="{wrong}"/>'))
    with pytest.raises(saltus.ModelError, match="1 number is needed, 2 given"):
        saltus.load_urdf(arm(body=inertial().replace('"1"', '"0,5"', 1)))


def test_numbers_of_the_block_are_as_they_must_be():
    for wrong in ("0, 0, 1", "0 0 1 0", "0 0 1.0."):
        block = f'<saltus><half_space normal="{wrong}"/></saltus>'
        with pytest.raises(saltus.ModelError, match="half_space"):
            saltus.load_urdf(arm(more=block))


def test_the_first_of_two_shapes():
    two = collision('<sphere radius="1"/><sphere radius="2"/>', "")
    model = flawed(arm(body=inertial() + two), "has two shapes in one <geometry>", "first is used")
    assert [repr(shape.shape) for shape in model.shapes] == ["Sphere(1.0)"]


def test_points_of_contact_of_radius_zero():
    text = arm(body=inertial() + collision('<sphere radius="0"/>'))
    model = flawed(text, '<sphere radius="0">: a size must be positive', "read as 1e-05 m")
    assert [repr(shape.shape) for shape in model.shapes] == ["Sphere(1e-05)"]
    plate = arm(body=inertial() + collision('<box size="1 1 0"/>'))
    assert repr(flawed(plate, "a size must be").shapes[0].shape) == "Box((0.5, 0.5, 5e-06))"
    for shape in ('<sphere radius="-1"/>', '<box size="1 -1 0"/>'):
        with pytest.raises(saltus.ModelError, match="a size must be positive"):
            saltus.load_urdf(arm(body=inertial() + collision(shape)))


def test_a_body_stands_on_points_of_contact():
    feet = "".join(
        collision('<sphere radius="0"/>', f'<origin xyz="{x} {y} -0.1"/>')
        for x, y in ((0.2, 0), (-0.1, 0.2), (-0.1, -0.2))
    )
    text = f'<robot name="r"><link name="body">{inertial(origin="")}{feet}</link></robot>'
    contact = saltus.ContactProperties(restitution=0.0, friction=0.5)
    with pytest.warns(saltus.ModelWarning, match="and 2 more like it"):
        model = saltus.load_urdf(text, root_joint="floating", floor=True, contact=contact)
    run = saltus.simulate(model, q={"root": saltus.Pose((0, 0, 0.3))}, duration=1.0)
    assert run.complete
    np.testing.assert_allclose(run.q[-1, :3], (0, 0, 0.1), atol=2e-5)  # of the radius


INF = np.inf
LIMITS = {
    '<limit lower="1" upper="0"/>': ("has lower limit 1 and upper limit 0", -INF, INF),
    '<limit lower="inf" upper="inf"/>': ("has lower limit inf", -INF, INF),
    "": ("has no <limit>, which such a joint needs", -INF, INF),
    '<limit effort="1" velocity="1"/>': ("has a <limit> without lower and upper", -INF, INF),
    '<limit lower="-1"/>': ("has a <limit> without upper", -1, INF),
    '<limit upper="2"/>': ("has a <limit> without lower", -INF, 2),
}


@pytest.mark.parametrize("limit", list(LIMITS))
@pytest.mark.parametrize("kind", ["revolute", "prismatic"])
def test_limits_that_are_crossed_or_missing(limit, kind):
    words, lower, upper = LIMITS[limit]
    [j] = flawed(arm(kind=kind, joint=limit), words, 'joint "j"', "unlimited").coordinates
    assert (j.lower, j.upper) == (lower, upper)


def test_limits_of_what_has_none_are_not_looked_at():
    crossed = '<limit lower="1" upper="0" effort="10" velocity="1"/>'
    for kind in ("continuous", "fixed", "planar"):
        sound(arm(kind=kind, joint=crossed))


def gripper(driver: str, mimic: str, kind: str = "revolute", more: str = "") -> str:
    limit = '<limit lower="-1" upper="1" effort="1" velocity="1"/>'
    return (
        '<robot name="gripper"><link name="palm"/>'
        f'<joint name="driver" type="{driver}"><parent link="palm"/><child link="left"/>{limit}'
        f'</joint><link name="left">{inertial()}</link>\n'
        f'<joint name="follower" type="{kind}"><parent link="palm"/><child link="right"/>'
        f'<origin xyz="1 0 0"/><axis xyz="0 0 2"/>{limit}\n<mimic {mimic}/></joint>'
        f'<link name="right">{inertial()}</link>{more}</robot>'
    )


def test_a_mimic_joint_whose_driver_is_locked_stands_still():
    text = gripper("fixed", 'joint="driver" multiplier="-1" offset="0.1"')
    model = flawed(text, 'joint "follower" mimics joint "driver", which is fixed', "stands at 0.1")
    assert model.coordinate_names == []
    R = saltus.rotation_from_rpy(0, 0, 0.1)
    np.testing.assert_allclose(model.pose(None, "right").R, R, atol=1e-15)
    np.testing.assert_allclose(model.pose(None, "right").p, (1, 0, 0))
    slide = gripper("fixed", 'joint="driver" offset="0.1"', "prismatic")
    np.testing.assert_allclose(flawed(slide, "fixed").pose(None, "right").p, (1, 0, 0.1))


def test_a_chain_of_mimics_below_a_locked_driver():
    tip = (
        '<joint name="tip" type="continuous"><parent link="right"/><child link="end"/>'
        '<axis xyz="0 0 1"/><mimic joint="follower" multiplier="3" offset="1"/></joint>'
        f'<link name="end">{inertial()}</link>'
    )
    text = gripper("fixed", 'joint="driver" multiplier="-1" offset="0.1"', more=tip)
    with pytest.warns(saltus.ModelWarning, match="and 1 more like it"):
        model = saltus.load_urdf(text)
    R = saltus.rotation_from_rpy(0, 0, 0.1 + 1.3)
    np.testing.assert_allclose(model.pose(None, "end").R, R, atol=1e-15)


def test_a_mimic_joint_whose_driver_is_not_there_moves_by_itself():
    model = flawed(
        gripper("revolute", 'joint="drover"'),
        'mimics joint "drover", which does not exist; joints are driver, follower', "is not used",
    )  # fmt: skip
    assert model.coordinate_names == ["driver", "follower"]


def test_a_mimic_of_itself_is_an_error():
    with pytest.raises(saltus.ModelError, match="cycle"):
        saltus.load_urdf(gripper("revolute", 'joint="follower"'))


def test_expressions_of_xacro_are_called_so():
    words = "an expression of xacro that was not expanded"
    for attribute in ('xyz="$(optenv MOUNT 0 0 0.1)"', 'rpy="0 0 ${angle}"'):
        with pytest.raises(saltus.ModelError, match=rf":4: joint \"j\" has <origin .*: {words}"):
            saltus.load_urdf(arm(joint=f"<origin {attribute}/>"))
    named = arm().replace('"arm"', '"${prefix}arm"')
    assert flawed(named, words).link_names == ["base", "${prefix}arm"]


def test_xacro_in_srdf():
    for text, words in (
        ("<xacro:arm/>", "<xacro:arm> is of a xacro file"),
        ("<group name='a'><xacro:arm/></group>", "<xacro:arm> is of a xacro file"),
        ("<disable_collisions link1='${p}arm' link2='base'/>", 'has link1="${p}arm": an express'),
    ):
        with pytest.raises(saltus.ModelError, match="SRDF text:2:") as error:
            saltus.load_urdf(arm(), srdf=f"<robot name='arm'>\n{text}</robot>")
        assert words in str(error.value)


def test_warnings_of_a_kind_are_one():
    many = "".join(
        f'<link name="l{i}"/><joint name="j{i}" type="revolute" fancy="1"><parent link="base"/>'
        f'<child link="l{i}"/><mimic joint="lost"/><glow/></joint>'
        for i in range(50)
    ).replace('type="revolute"', 'type="fixed"')
    with pytest.warns(saltus.ModelWarning) as caught:
        saltus.load_urdf(arm(more=many))
    texts = [str(each.message) for each in caught]
    assert len(texts) == 3  # an attribute, an element, a <mimic> of what is fixed
    assert all(text.endswith("(and 49 more like it)") for text in texts)


def test_on_the_command_line(tmp_path, capsys):
    path = tmp_path / "arm.urdf"
    path.write_text(arm(body=inertial(1, diagonal(0.00305792, 0.0236436, 0.0268997))))
    assert main(["info", str(path)]) == 0
    assert "less than 2 %" in capsys.readouterr().err
    assert main(["info", str(path), "--strict"]) == 2
    assert "no body can have" in capsys.readouterr().err
    path.write_text(arm(body=collision('<box size="1 1 1"/>')))
    assert main(["info", str(path)]) == 2
    assert main(["info", str(path), "--inertia", "from_shapes"]) == 0
    assert "1000 kg" in capsys.readouterr().out
