"""Curves of joints' springs and general actuators in files: the same model as in code."""

from __future__ import annotations

import numpy as np
import pytest

import saltus
from saltus import ModelBuilder, ModelError

URDF = """<robot name="arm"><link name="base"/>{links}<saltus>{block}</saltus></robot>"""
LINK = """<link name="{name}"><inertial><origin xyz="0.2 0 0"/><mass value="1"/>
<inertia ixx="0.01" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="{joint}" type="continuous"><parent link="{parent}"/><child link="{name}"/>
<origin xyz="0.4 0 0"/><axis xyz="0 1 0"/></joint>"""
CURVE = '<joint name="{}" angles="-1 0 0.5 2" forces="-3 0, 2 2.5" slopes="4 0.5"/>'


def arm(block: str) -> str:
    upper = LINK.format(name="upper", joint="shoulder", parent="base")
    lower = LINK.format(name="lower", joint="elbow", parent="upper")
    return URDF.format(links=upper + lower, block=block)


def plain() -> ModelBuilder:
    return saltus.read_urdf(arm(""))


def assert_same_run(file: saltus.Model, code: saltus.Model, **inputs) -> None:
    runs = [
        saltus.simulate(m, q=[0.3, -0.4], duration=0.5, progress=False, **inputs)
        for m in (file, code)
    ]
    np.testing.assert_array_equal(runs[0].q, runs[1].q)
    np.testing.assert_array_equal(runs[0].total, runs[1].total)


def test_a_curve_is_that_of_the_builder() -> None:
    file = saltus.load_urdf(arm(CURVE.format("elbow")))
    curve = ([-1, 0, 0.5, 2], [-3, 0, 2, 2.5])
    code = plain().add_joint_spring("elbow", curve=curve, slopes=(4, 0.5)).build()
    assert_same_run(file, code)
    natural = saltus.load_urdf(arm('<joint name="elbow" angles="-1 0 1" forces="-3 0 2"/>'))
    code = plain().add_joint_spring("elbow", curve=([-1, 0, 1], [-3, 0, 2])).build()
    assert_same_run(natural, code)


def test_a_curve_survives_the_file_of_a_run(tmp_path) -> None:
    model = saltus.load_urdf(arm(CURVE.format("elbow")))
    run = saltus.simulate(model, q=[0.3, -0.4], duration=0.1, progress=False)
    run.save(tmp_path / "run.h5")
    assert_same_run(saltus.load(tmp_path / "run.h5").model, model)


def test_an_actuator_is_that_of_the_builder() -> None:
    file = saltus.load_urdf(
        arm(
            '<actuator name="belt" joints="shoulder elbow" ratios="1 -0.5" gain="20"'
            ' bias="0.3 -20 -1" effort="5" control="-1 1"/>'
        )
    )
    code = plain().add_actuator(
        "belt", joints={"shoulder": 1, "elbow": -0.5}, gain=20, bias=(0.3, -20, -1), effort=5,
        control=(-1, 1),
    )  # fmt: skip
    assert_same_run(file, code.build(), control={"belt": 0.4})
    one = saltus.load_urdf(arm('<actuator name="any" joints="elbow" gain="2"/>'))
    assert_same_run(
        one, plain().add_actuator("any", joints={"elbow": 1}, gain=2).build(), control={"any": 1.0}
    )


@pytest.mark.parametrize(
    ("block", "message"),
    [
        ('<joint name="elbow" angles="0 1"/>', "2 displacements and 0 forces"),
        ('<joint name="elbow" forces="0 1"/>', "0 displacements and 2 forces"),
        ('<joint name="elbow" angles="0 1" forces="0 x"/>', '"x" in forces; it is numbers'),
        ('<joint name="elbow" angles="1 0" forces="0 1"/>', "displacement 0 follows 1"),
        ('<joint name="elbow" slopes="1 0"/>', "has slopes, which are of a curve"),
        ('<joint name="elbow" angles="0 1" forces="0 1" stiffness="3"/>', "stiffness or rest"),
        ('<joint name="knee" angles="0 1" forces="0 1"/>', "joints are shoulder, elbow"),
        ('<joint name="elbow" stiffness="1e300"/>', "stiffness 1e.300; it is finite"),
        ('<actuator name="a" joints="elbow" ratios="1 2"/>', "has 2 ratios for 1 joint"),
        ('<actuator name="a" joints=""/>', 'without attribute "joints"'),
        ('<actuator name="a" joints="knee"/>', "joints are shoulder, elbow"),
        ('<actuator name="a" joints="elbow" control="1 -1"/>', "controls from 1 to -1"),
        ('<actuator name="a" joints="elbow" bias="1 2"/>', "bias"),
    ],
)
def test_what_is_wrong_is_named_with_its_line(block: str, message: str) -> None:
    with pytest.raises(ModelError, match=r"URDF text:7: (joint|actuator|no joint) .*" + message):
        saltus.load_urdf(arm(block))
