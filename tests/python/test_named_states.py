"""States by name: from SRDF's group states, and from builders."""

from __future__ import annotations

import re
import warnings

import numpy as np
import pytest
from scenes import chain_on_a_body

import saltus

ARM = """<robot name="arm"><link name="base"/>
{links}
<joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/>
<axis xyz="0 0 1"/><limit lower="-1.57" upper="1.57" effort="9" velocity="3"/></joint>
<joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/>
<axis xyz="0 1 0"/></joint>
<joint name="finger" type="prismatic"><parent link="lower"/><child link="left"/>
<axis xyz="0 1 0"/><limit lower="0" upper="0.04" effort="9" velocity="3"/></joint>
<joint name="other_finger" type="prismatic"><parent link="lower"/><child link="right"/>
<axis xyz="0 -1 0"/><limit lower="0" upper="0.04" effort="9" velocity="3"/>
<mimic joint="finger"/></joint>
<joint name="tip" type="fixed"><parent link="lower"/><child link="end"/></joint></robot>"""
LINK = """<link name="{}"><inertial><mass value="1"/><inertia ixx=".1" iyy=".1" izz=".1" ixy="0"
 ixz="0" iyz="0"/></inertial></link>"""
ARM = ARM.format(links="".join(LINK.format(x) for x in ("upper", "lower", "left", "right", "end")))


def srdf(*states: str) -> str:
    return f"<robot name='arm'>{''.join(states)}</robot>"


def group_state(name: str, group: str = "arm", **joints: object) -> str:
    values = "".join(f"<joint name='{j}' value='{x}'/>\n" for j, x in joints.items())
    return f"<group_state name='{name}' group='{group}'>\n{values}</group_state>\n"


def load(*states: str, **options: object) -> saltus.Model:
    return saltus.load_urdf(ARM, srdf=srdf(*states), **options)


def quietly(*states: str, **options: object) -> saltus.Model:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return load(*states, **options)


def test_group_states_are_states():
    model = quietly(
        group_state("home", shoulder=0.5, elbow=-1), group_state("open", "hand", finger=0.03)
    )
    assert model.state_names == ["home", "open"]
    home = model.state("home")
    assert home == model.state({"shoulder": 0.5, "elbow": -1})
    assert model.state("open", t=2.0).t == 2.0
    assert model.state("open").q[model.coordinate("finger")] == 0.03
    assert model.state("home", v={"elbow": 1.0}) == model.state(home.q, [0, 1, 0])


def test_a_name_stands_for_q_wherever_q_is_taken():
    model = quietly(group_state("home", shoulder=0.5))
    q = {"shoulder": 0.5}
    assert model.pose("home", "lower").p.tolist() == model.pose(q, "lower").p.tolist()
    np.testing.assert_array_equal(model.mass_matrix("home"), model.mass_matrix(q))
    np.testing.assert_array_equal(model.at("home").q, model.state(q).q)
    run = saltus.simulate(model, "home", duration=0.01)
    assert run.state(0) == model.state("home")


def test_unknown_names():
    model = quietly(group_state("home"), group_state("ready"))
    with pytest.raises(saltus.ModelError, match='no state "hom"; there are home, ready'):
        model.state("hom")
    with pytest.raises(saltus.ModelError, match='no state "hom"; there are none'):
        saltus.load_urdf(ARM).state("hom")


def test_one_name_in_two_groups():
    model = quietly(
        group_state("home", "left", shoulder=0.1), group_state("home", "right", elbow=0.2)
    )
    assert model.state_names == ["left/home", "right/home"]
    with pytest.raises(saltus.ModelError, match="there are left/home, right/home"):
        model.state("home")
    with pytest.warns(saltus.ModelWarning, match='two states are named "arm/home"; the first'):
        model = load(group_state("home", shoulder=0.1), group_state("home", shoulder=0.2))
    assert model.state("arm/home").q[0] == 0.1


@pytest.mark.parametrize(
    ("joints", "words", "strict"),
    [
        ({"wrist": 1, "neck": 2}, '"wrist", which the robot has not; it is not used', False),
        ({"tip": 0}, '"tip", which is fixed; it is not used', False),
        ({"shoulder": 1.5708}, '"shoulder" at 1.5708, outside of its limits -1.57 to 1.57', True),
        ({"elbow": "1 2"}, '"elbow" with 2 numbers; it takes 1 number', True),
        ({"finger": 0.02, "other_finger": 0.03}, "to 0.03, which is 0.02 as it mimics", True),
    ],
)
def test_what_does_not_fit_is_told(joints, words, strict):
    with pytest.warns(saltus.ModelWarning, match=rf"SRDF text:\d.*{re.escape(words)}"):
        model = load(group_state("home", **joints))
    saltus.simulate(model, "home", duration=0.01)
    if strict:
        with pytest.raises(saltus.ModelError, match=re.escape(words)):
            load(group_state("home", **joints), strict=True)


def test_mimics_that_say_the_same_are_no_news():
    model = quietly(group_state("open", finger=0.03, other_finger=0.0301))
    assert model.state("open").q[model.coordinate("finger")] == 0.03


def test_limits_that_do_not_act_are_none():
    model = quietly(group_state("home", shoulder=3), effects="none")
    assert model.state("home").q[0] == 3


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("<group_state group='arm'/>", '<group_state> is without attribute "name"'),
        ("<group_state name='a'><joint value='1'/></group_state>", 'without attribute "name"'),
        ("<group_state name='a'><joint name='elbow'/></group_state>", 'without attribute "value"'),
        (group_state("a", elbow="up"), 'joint "elbow" has value="up"; it is a number, or several'),
        (group_state("a", elbow="nan"), 'has value="nan"'),
        (group_state("a", elbow="1 ${x}"), "xacro"),
    ],
)
def test_what_no_state_is(text, words):
    with pytest.raises(saltus.ModelError, match=re.escape(words)):
        load(text)


def test_free_roots():
    text = srdf(group_state("up", root="{}"))
    half = np.sqrt(0.5)
    options = {"root_joint": "floating"}
    model = saltus.load_urdf(
        chain_on_a_body(), srdf=text.format(f"1 2 3 0 0 {half} {half}"), **options
    )
    assert model.pose("up", "frame").p.tolist() == [1, 2, 3]
    np.testing.assert_allclose(model.pose("up", "frame").R @ [1, 0, 0], [0, 1, 0], atol=1e-12)
    with pytest.raises(saltus.ModelError, match="a quaternion of length 2"):
        saltus.load_urdf(chain_on_a_body(), srdf=text.format("1 2 3 0 0 0 2"), **options)


def test_virtual_joints_are_the_roots_own():
    text = (
        "<robot name='x'><virtual_joint name='base' type='floating' parent_frame='odom' "
        "child_link='frame'/><group_state name='up' group='all'><joint name='base' "
        "value='1 2 3 0 0 0 1'/><joint name='joint_0' value='0.5'/></group_state></robot>"
    )
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        free = saltus.load_urdf(chain_on_a_body(), srdf=text, root_joint="floating")
        fixed = saltus.load_urdf(chain_on_a_body(), srdf=text)
    assert free.state("up").q.tolist() == [1, 2, 3, 0, 0, 0, 1, 0.5, 0]
    assert fixed.state("up").q.tolist() == [0.5, 0]
    pinocchio = srdf(group_state("up", root_joint="1 2 3 0 0 0 1"))
    free = saltus.load_urdf(chain_on_a_body(), srdf=pinocchio, root_joint="floating")
    assert free.state("up").q.tolist() == [1, 2, 3, 0, 0, 0, 1, 0, 0]


def test_states_of_builders():
    builder = saltus.read_urdf(chain_on_a_body(), root_joint="floating")
    up = saltus.Pose((0, 0, 1), saltus.rotation_from_rpy(0, 0, 1))
    builder.add_state("up", q={"root": up, "joint_0": 0.2}, v={"root": (1, 0, 0, 0, 0, 3)})
    builder.add_state("rest")
    model = builder.build()
    assert model.state_names == ["up", "rest"]
    assert model.state("up") == model.state(
        {"root": up, "joint_0": 0.2}, {"root": (1, 0, 0, 0, 0, 3)}
    )
    assert model.state("rest") == model.state()
    put = saltus.ModelBuilder("hall").add(model, "a_", parent="world").build()
    assert put.state_names == ["a_up", "a_rest"]
    assert put.state("a_up").q.tolist() == model.state("up").q.tolist()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (
            {"q": {"elbw": 1}},
            '"elbw", which does not exist; joints that move are shoulder, elbow, f',
        ),
        ({"q": {"tip": 1}}, 'names joint "tip", which is fixed'),
        ({"q": {"other_finger": 1}}, '"other_finger", which mimics joint "finger" and follows it'),
        ({"q": {"elbow": (1, 2)}}, 'has 2 numbers in q["elbow"]; the joint takes 1 number'),
        ({"q": {"elbow": np.nan}}, 'has nan in q["elbow"]'),
        ({"q": {"elbow": "up"}}, "q[\"elbow\"] = 'up' is no number"),
        ({"q": {"shoulder": 2}}, 'q["shoulder"] = 2, outside of its limits -1.57 to 1.57'),
        ({"q": 3}, "q = 3; it is a mapping of joints' names to numbers"),
        ({"v": {"elbow": np.inf}}, 'has inf in v["elbow"]'),
        ({"name": "home"}, 'two states are named "home"'),
        ({"name": ""}, "a state has no name"),
    ],
)
def test_states_that_none_are(arguments, words):
    builder = saltus.read_urdf(ARM).add_state("home", q={"shoulder": 1})
    with pytest.raises(saltus.ModelError, match=re.escape(words)):
        builder.add_state(**{"name": "next", **arguments})
    assert builder.build().state_names == ["home"]


def test_limits_that_are_set_later_are_told():
    builder = saltus.read_urdf(ARM).add_state("home", q={"shoulder": 1})
    builder.set_limit("shoulder", -0.5, 0.5)
    with pytest.warns(saltus.ModelWarning, match="= 1, beyond the shoulder upper limit 0.5; no ru"):
        builder.build()
