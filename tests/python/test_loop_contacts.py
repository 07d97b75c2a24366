"""Loops with contacts, and what is no loop: impacts in their metric, messages, files."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.python.test_forces import GOLDEN, H
from tests.python.test_loops import chain, crank, four_bar

import saltus
from saltus import At, BodyInertia, JointType, ModelBuilder, ModelError, Pose


@pytest.mark.parametrize("friction", [0.0, 0.6])
@pytest.mark.parametrize("restitution", [0.0, 0.7])
def test_contacts_feel_a_coupling_as_they_feel_a_mimic_joint(
    restitution: float, friction: float
) -> None:
    """Impacts, friction and resting in the metric of the loops are those in fewer coordinates."""

    def arm(**joint: object) -> ModelBuilder:
        builder = ModelBuilder("arm")
        builder.add_floor(offset=-0.6, restitution=restitution, friction=friction)
        parent, at = "world", 0.0
        for k in range(3):
            name = f"rod_{k}"
            builder.add_link(name, BodyInertia(1, (0.2, 0, 0), np.diag([1e-3, 0.02, 0.02])))
            builder.add_joint(
                name, JointType.revolute, parent=parent, child=name, axis=(0, 1, 0),
                X_PJ=Pose((at, 0, 0)), **(joint if k == 2 else {}),
            )  # fmt: skip
            builder.add_shape(name, saltus.Sphere(0.05), Pose((0.4, 0, 0)))
            parent, at = name, 0.4
        return builder

    coupled = arm().add_coupling("rod_2", of="rod_1", polynomial=(0, -1)).build()
    mimic = arm(mimic=saltus.Mimic("rod_1", -1.0, 0.0)).build()
    runs = [
        saltus.simulate(m, q={"rod_1": -0.3} | more, duration=2.0, h=0.005, progress=False)
        for m, more in ((coupled, {"rod_2": 0.3}), (mimic, {}))
    ]
    assert len(runs[0].impacts) == len(runs[1].impacts) > 0
    # 1e-7: both solve to rounding, which impacts magnify by some digits in 2 s
    np.testing.assert_allclose(runs[0].q[:, :2], runs[1].q, rtol=0, atol=1e-7)
    np.testing.assert_allclose(
        runs[0].impulses["lambda"], runs[1].impulses["lambda"], rtol=1e-6, atol=1e-9
    )


def test_impacts_are_in_the_metric_of_what_the_loops_leave_free() -> None:
    """The slider-crank has one freedom: an elastic impact turns its velocity round, exactly."""
    model = crank()
    start = GOLDEN["crank"]["start"]
    stepper = saltus.Stepper(model, H)
    state = model.state(start["q"], start["v"])
    before = state
    while not stepper.report.impacts:
        before, state = state, stepper.advance(state)
    energy = [model.kinetic_energy(s) + model.potential_energy(s.q) for s in (before, state)]
    assert energy[1] == pytest.approx(energy[0], rel=1e-3)
    assert model.velocity(state) @ model.velocity(before) < 0


def test_a_looped_leg_stands_on_a_floor_with_friction() -> None:
    """Contacts, friction and a loop at once: the leg falls, lands and comes to rest, closed."""
    builder = ModelBuilder("leg")
    builder.add_floor(restitution=0, friction=0.8)
    builder.add_link("body", BodyInertia(2, (0, 0, 0), 0.02 * np.eye(3)))
    builder.add_joint("lift", JointType.prismatic, parent="world", child="body", axis=(0, 0, 1))
    y = (0.0, 1.0, 0.0)
    for side, x in (("left", -0.1), ("right", 0.1)):
        for part, parent, at in (
            ("thigh", "body", (x, 0, 0)),
            ("shin", f"{side}_thigh", (0, 0, -0.3)),
        ):
            name = f"{side}_{part}"
            builder.add_link(name, BodyInertia(0.3, (0, 0, -0.15), np.diag([2e-3, 2e-3, 1e-4])))
            builder.add_joint(
                name, JointType.revolute, parent=parent, child=name, axis=y, X_PJ=Pose(at),
                damping=0.3,
            )  # fmt: skip
    builder.add_shape("left_shin", saltus.Sphere(0.03), Pose((0, 0, -0.3)))
    builder.add_loop(
        "foot", "point", a=At("left_shin", (0, 0, -0.3)), b=At("right_shin", (0, 0, -0.3))
    )
    model = builder.build()
    state = saltus.close_loops(
        model, {"lift": 0.6, "left_thigh": 0.3, "left_shin": -0.5, "right_thigh": -0.3,
                "right_shin": 0.5},
    )  # fmt: skip
    run = saltus.simulate(model, state=state, duration=2.0, h=0.005, progress=False)
    assert run.complete
    worst = max(np.abs(model.loop_gaps(q)["foot"]).max() for q in run.q)
    assert worst < 1e-12
    energy = run.kinetic + run.potential
    assert energy[-1] < energy[0] - 1
    assert run.kinetic[-1] < 1e-3


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda b: b.add_loop("l", "point", a=At("hand"), b=At("world")).build(),
         'loop "l" holds link "hand", which does not exist; links are world, rod_0'),
        (lambda b: b.add_loop("l", "point", a=At("rod_0"), b=At("rod_0")), "both ends on link"),
        (lambda b: b.add_loop("l", "pin", a=At("rod_0"), b=At("world")),
         "type = 'pin' is no LoopType"),
        (lambda b: b.add_loop("l", "distance", a=At("rod_0"), b=At("world")),
         "has distance 0; it is positive"),
        (lambda b: b.add_loop("l", "point", a=At("rod_0"), b=At("world"), distance=1),
         "has distance 1; .* and 0 of all others"),
        (lambda b: b.add_coupling("joint_0", of="joint_0", polynomial=(0, 1)), "to itself"),
        (lambda b: b.add_coupling("joint_0", of="joint_1", polynomial=()), "no polynomial"),
        (lambda b: b.add_coupling("elbow", of="joint_1", polynomial=(0, 1)).build(),
         'joint "elbow", which does not exist; joints are joint_0, joint_1'),
        (lambda b: b.add_loop("l", "point", a=At("rod_0", (math.nan, 0, 0)), b=At("world")),
         'loop "l" has a placement that is not finite'),
    ],
)  # fmt: skip
def test_what_is_no_loop_is_named(make, message: str) -> None:
    with pytest.raises(ModelError, match=message):
        make(chain([(1, 1), (1, 1)]))


def test_loops_that_are_open_at_the_start_are_named() -> None:
    model = four_bar().build()
    with pytest.raises(ModelError, match=r'loop "pin" is open by 1\.2 at the start; close_loops'):
        saltus.simulate(model, duration=0.1)
    q = saltus.close_loops(model, [1.0, -0.5, -2.0]).q
    with pytest.raises(ModelError, match='loop "pin" opens at a rate of'):
        saltus.simulate(model, q=q, v=[1.0, 0, 0], duration=0.1)
    state = saltus.close_loops(model, q, [1.0, 0, 0], keep=["joint_0"])
    assert model.velocity(state)[0] == pytest.approx(1.0, abs=1e-12)
    saltus.simulate(model, state=state, duration=0.1)


def test_loops_that_cannot_be_closed_are_named() -> None:
    builder = chain([(1, 1), (1, 1)])
    builder.add_loop("pin", "point", a=At("rod_1", (1, 0, 0)), b=At("world", (3, 0, 0)))
    with pytest.raises(ModelError, match='loop "pin" stays open by 1'):
        saltus.close_loops(builder.build(), [0.3, -0.2])


def four_bar_text() -> str:
    links, parent, at = "", "world", 0.0
    for name, length in (("crank", 0.4), ("coupler", 1.0), ("rocker", 0.8)):
        links += f"""<link name="{name}"><inertial><origin xyz="{length / 2} 0 0"/><mass value="1"/>
        <inertia ixx="0.01" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial></link>
        <joint name="{name}" type="continuous"><parent link="{parent}"/><child link="{name}"/>
        <origin xyz="{at} 0 0"/><axis xyz="0 0 1"/></joint>"""
        parent, at = name, length
    return f"""<robot name="four-bar"><link name="world"/>{links}<saltus>
    <loop name="pin" type="point" link1="rocker" xyz1="0.8 0 0" link2="world" xyz2="1 0 0"/>
    </saltus></robot>"""


def test_loops_are_read_from_a_file(tmp_path) -> None:
    text = four_bar_text()
    model = saltus.load_urdf(text)
    assert model.loop_names == ["pin"]
    state = saltus.close_loops(model, [1.0, -0.5, -2.0], {"crank": 1.0}, keep=["crank"])
    run = saltus.simulate(model, state=state, duration=0.1, h=H)
    assert np.abs(model.loop_gaps(run.q[-1])["pin"]).max() < 1e-14
    run.save(tmp_path / "run.h5")
    assert saltus.load(tmp_path / "run.h5").model.loop_names == ["pin"]
    with pytest.raises(ModelError, match='has type="pin"; known are point, weld'):
        saltus.load_urdf(text.replace('type="point"', 'type="pin"'))
    with pytest.raises(ModelError, match='names link "rockr", which does not exist'):
        saltus.load_urdf(text.replace('link1="rocker"', 'link1="rockr"'))
    coupled = text.replace(
        "<saltus>", '<saltus><coupling joint="rocker" of="crank" polynomial="0 x"/>'
    )
    with pytest.raises(ModelError, match='has "x" in polynomial; it is numbers'):
        saltus.load_urdf(coupled)
    assert saltus.load_urdf(coupled.replace("0 x", "0 1")).loop_names == ["pin", "rocker coupling"]
    told = text.replace("<saltus>", '<saltus><prescribed joint="crank" times="0 1" values="1 2"/>')
    assert saltus.load_urdf(told).loop_names == ["pin", "crank prescribed"]
