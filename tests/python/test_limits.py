"""Joints' limits and dry friction, against reference values, and what a file's joints do."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.python.test_forces import GOLDEN, H, assert_rows, pendulum

import saltus
from saltus import BodyInertia, JointEffects, JointType, ModelBuilder, ModelError, Pose


def test_bounces_on_a_limit_are_the_reference() -> None:
    model = pendulum().set_limit("swing", 0.3, math.inf, restitution=0.5).build()
    assert model.limit_names == ["swing lower limit"]
    run = saltus.simulate(model, q=[1.0], duration=2.2, h=H, record_contacts=True)
    expected = GOLDEN["bounces"]
    first = len(expected["impacts"])
    np.testing.assert_allclose(run.impacts["t"][:first], expected["impacts"], atol=1e-12)
    np.testing.assert_allclose(run.impulses["lambda"][:first], expected["impulses"], atol=1e-12)
    assert_rows(run, expected["rows"])
    held = run.contacts[-1]
    assert run.pair_names[held["pair"]] == "swing lower limit"
    assert held["lambda"] / H == pytest.approx(expected["held_force"], abs=1e-12)


def test_a_limit_without_rebound_holds_to_the_last_bit() -> None:
    model = pendulum().set_limit("swing", 0.3, math.inf).build()
    run = saltus.simulate(model, q=[1.0], duration=3.0, h=H)
    assert len(run.impacts) == 1
    assert np.abs(run.q[60:, 0] - 0.3).max() < 1e-14
    assert np.abs(run.p[60:]).max() == 0
    assert np.diff(run.total).max() < 1e-5 * run.kinetic.max()  # the midpoint rule's own swing


@pytest.mark.parametrize("g", [9.81, 1e-2, 1e-5, 1e-6, 1e-8, 1e-10])
@pytest.mark.parametrize("bound", [0.0, 3.0])
def test_a_joint_does_not_creep_through_its_limit(g: float, bound: float) -> None:
    """However little presses it: an arc that would sink by less than touches was left free."""
    builder = ModelBuilder("rod").set_gravity((0, -g * math.cos(bound), 0) if bound else (0, -g, 0))
    builder.add_link("rod", BodyInertia(1, (0.5, 0, 0), np.diag([0.001, 1 / 12, 1 / 12])))
    builder.add_joint("hinge", "revolute", parent="world", child="rod", axis=(0, 0, 1))
    model = builder.set_limit("hinge", bound, 5.0).build()
    run = saltus.simulate(model, q=[bound], duration=5.0, h=H)
    moved = run.q[:, 0] - bound
    assert moved.min() > -1e-12 * max(1.0, bound)
    if bound == 0.0:  # it is pressed all the time
        assert moved.max() < 1e-12


def test_limits_let_go() -> None:
    """A pendulum that a motor lifts off its limit moves as a free one."""
    builder = pendulum().set_limit("swing", 0.3, math.inf).add_motor("m", joint="swing")
    run = saltus.simulate(
        builder.build(), q=[0.3], duration=0.5, h=H, control=[[0.0]] * 20 + [[9.0]] * 40
    )
    assert np.abs(run.q[:21, 0] - 0.3).max() < 1e-15
    assert run.q[-1, 0] > 0.5


def test_a_chain_falls_on_all_its_limits_at_once() -> None:
    """Five rods swing until each is at its limit: one impulse a limit, not a cascade."""
    builder = ModelBuilder("chain").set_gravity((0, -9.81, 0))
    parent = "world"
    for k in range(5):
        builder.add_link(f"rod_{k}", BodyInertia(1, (0.5, 0, 0), np.diag([0, 1 / 12, 1 / 12])))
        builder.add_joint(
            f"hinge_{k}",
            JointType.revolute,
            parent=parent,
            child=f"rod_{k}",
            axis=(0, 0, 1),
            X_PJ=Pose((0 if k == 0 else 1, 0, 0)),
            lower=-0.5 if k == 0 else 0.0,
            upper=1.0,
        )
        parent = f"rod_{k}"
    model = builder.build()
    run = saltus.simulate(model, q={f"hinge_{k}": 0.3 for k in range(5)}, duration=4.0, h=H)
    assert len(run.impulses) < 200
    np.testing.assert_allclose(run.q[-1], [-0.5, 0, 0, 0, 0], atol=1e-10)
    assert np.abs(run.v[-1]).max() < 1e-10
    assert np.diff(run.total).max() < 1e-3 * run.kinetic.max()


def test_coordinates_start_within_their_limits() -> None:
    model = pendulum(lower=0.3, upper=1.0).build()
    np.testing.assert_array_equal(model.neutral(), [0.3])
    np.testing.assert_array_equal(model.state().q, [0.3])
    with pytest.raises(ModelError, match='joint "swing" starts at 2, beyond its upper limit 1;'):
        saltus.simulate(model, q=[2.0], duration=0.1)


def test_limits_of_a_joint_that_mimics_narrow_those_of_the_other() -> None:
    builder = pendulum(lower=-1.0, upper=1.0)
    builder.add_link("follower", BodyInertia(0.1, (0, -1, 0), np.zeros((3, 3))))
    builder.add_joint(
        "follower",
        JointType.revolute,
        parent="world",
        child="follower",
        axis=(0, 0, 1),
        mimic=saltus.Mimic("swing", -2.0, 0.2),  # -2 q + 0.2 in [-0.5, 0.8]
        lower=-0.5,
        upper=0.8,
    )
    model = builder.build()
    assert model.limit_names == ["swing lower limit", "swing upper limit"]
    run = saltus.simulate(model, q=[0.3], v=[5.0], duration=0.02, h=H)
    assert len(run.impacts) == 1
    assert run.impacts["t"][0] == pytest.approx(0.01, abs=1e-3)  # 0.05 rad at 5 rad/s
    assert run.q.max() < 0.35


def test_a_dry_pendulum_stops_where_the_reference_does() -> None:
    model = pendulum(friction=1.2).build()
    run = saltus.simulate(model, q=[1.2], duration=8.0, h=H)
    expected = GOLDEN["dry"]
    assert_rows(run, expected["rows"])
    stopped = round(expected["stopped_since"] / H)
    assert (run.q[stopped:] == run.q[stopped]).all()  # no creep, to the last bit
    assert (run.p[stopped:] == 0).all()
    assert run.q[-1, 0] == pytest.approx(expected["stops_at"], abs=1e-12)
    # what is lost is what friction took; the theory's own balance is 1e-4 at this step
    assert run.energy_error < 1e-4


def test_the_work_of_dry_friction_balances_to_second_order() -> None:
    model = pendulum(friction=0.4).build()
    coarse, fine = (
        saltus.simulate(model, q=[1.2], duration=1.0, h=h).energy_error for h in (0.01, 0.005)
    )
    assert coarse / fine == pytest.approx(4, rel=0.2)


def test_a_block_with_dry_friction_stops_by_itself() -> None:
    builder = ModelBuilder("slide").set_gravity((0, 0, 0))
    builder.add_body("block", saltus.Box((0.1, 0.1, 0.1)), mass=2.0, joint="prismatic")
    model = builder.set_friction("block", 6.0).build()  # 3 m/s^2
    run = saltus.simulate(model, v=[1.0], duration=1.0, h=H)
    assert run.q[-1, 0] == pytest.approx(1 / 6, abs=0.2 * 3 * H**2)  # v^2 / (2 a)
    assert (run.v[40:] == 0).all()
    pushed = saltus.simulate(model, duration=0.5, h=H, qfrc=[5.9])
    assert (pushed.q == 0).all()  # less than the friction moves nothing
    moved = saltus.simulate(model, duration=0.5, h=H, qfrc=[8.0])
    assert moved.v[-1, 0] == pytest.approx(0.5, abs=1e-12)  # (8 - 6) / 2 over 0.5 s


def test_an_arm_is_held_by_friction_alone() -> None:
    builder = ModelBuilder("arm")
    parent = "world"
    for k in range(3):
        builder.add_link(f"link_{k}", BodyInertia(1, (0.3, 0, 0), np.diag([0, 0.03, 0.03])))
        builder.add_joint(
            f"joint_{k}",
            JointType.revolute,
            parent=parent,
            child=f"link_{k}",
            axis=(0, 1, 0),
            X_PJ=Pose((0 if k == 0 else 0.6, 0, 0)),
            friction=30.0,
        )
        parent = f"link_{k}"
    q = [0.3, -0.4, 0.2]
    run = saltus.simulate(builder.build(), q=q, duration=5.0, h=H)
    assert (run.q == run.q[0]).all()


ROBOT = """
<robot name="elbow">
  <link name="base"/>
  <link name="arm">
    <inertial><origin xyz="0 0 -0.5"/><mass value="1"/>
      <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
  </link>
  <joint name="elbow" type="revolute">
    <parent link="base"/><child link="arm"/><axis xyz="0 1 0"/>
    <limit lower="-0.2" upper="0.5" effort="4" velocity="3"/>
    <dynamics damping="0.3" friction="0.1"/>
  </joint>
  <transmission name="drive">
    <type>transmission_interface/SimpleTransmission</type>
    <joint name="elbow"/>
    <actuator name="elbow_motor"><mechanicalReduction>50</mechanicalReduction></actuator>
  </transmission>
  <saltus>
    <joint name="elbow" armature="0.02" limit_restitution="0.1"/>
  </saltus>
</robot>
"""


def test_what_a_file_says_of_a_joint_acts() -> None:
    model = saltus.load_urdf(ROBOT)
    assert model.limit_names == ["elbow lower limit", "elbow upper limit"]
    assert model.control_names == ["elbow_motor"]
    assert (model.damping[0], model.friction[0], model.armature[0]) == (0.3, 0.1, 0.02)
    assert model.contact_properties(model.n_pairs).restitution == 0.1
    run = saltus.simulate(model, duration=2.0, h=H, control={"elbow_motor": 40.0})
    assert run.q.max() <= 0.5 + 1e-12
    # 40 N m asked, 4 N m is the joint's effort
    assert run.work["elbow_motor"][-1] == pytest.approx(4 * (run.q[-1, 0] - run.q[0, 0]), rel=1e-3)


@pytest.mark.parametrize(
    ("effects", "limits", "damping", "friction", "motors"),
    [
        ("none", 0, 0.0, 0.0, 0),
        (JointEffects.limits, 2, 0.0, 0.0, 0),
        (JointEffects.damping | JointEffects.motors, 0, 0.3, 0.0, 1),
        (JointEffects.friction, 0, 0.0, 0.1, 0),
        ("all", 2, 0.3, 0.1, 1),
    ],
)
def test_effects_choose_what_acts(
    effects: JointEffects | str, limits: int, damping: float, friction: float, motors: int
) -> None:
    model = saltus.load_urdf(ROBOT, effects=effects)
    assert len(model.limit_names) == limits
    assert (model.damping[0], model.friction[0]) == (damping, friction)
    assert model.n_u == motors
    (elbow,) = model.coordinates
    assert (elbow.lower, elbow.damping) == (-0.2, 0.3)  # known, whether it acts or not


def test_transmissions_that_are_no_motors_are_told() -> None:
    text = ROBOT.replace("SimpleTransmission", "DifferentialTransmission")
    with pytest.warns(saltus.ModelWarning, match="DifferentialTransmission"):
        model = saltus.load_urdf(text)
    assert model.n_u == 0


def test_a_typo_in_the_block_is_told_with_its_line() -> None:
    text = ROBOT.replace('<joint name="elbow" armature', '<joint name="elbw" armature')
    with pytest.raises(ModelError, match=r'URDF text:\d+: no joint "elbw"; joints are elbow'):
        saltus.load_urdf(text)


def test_a_robot_falls_on_a_floor_and_its_limits_hold() -> None:
    """Contacts, limits and dry friction share their load in one law."""
    builder = saltus.read_urdf(ROBOT.replace('<link name="base"/>', '<link name="base"/>'))
    builder.add_shape("arm", saltus.Sphere(0.05), Pose((0, 0, -1.0)))
    builder.add_floor("wall", normal=(-1, 0, 0), offset=-0.3, restitution=0.2, friction=0.5)
    model = builder.build()
    run = saltus.simulate(model, q=[0.1], duration=3.0, h=H, control={"elbow_motor": -3.0})
    assert run.complete
    assert (run.q >= -0.2 - 1e-12).all()
    assert (run.q <= 0.5 + 1e-12).all()


def test_a_mimic_joint_that_comes_first_narrows_the_limits_of_the_other() -> None:
    mimic = saltus.Mimic("swing", 1.0, 0.0)
    builder = ModelBuilder("pair")
    for name in ("follower", "swing"):
        builder.add_link(name, BodyInertia(1, (0, -1, 0), np.zeros((3, 3))))
    revolute = JointType.revolute
    axis = (0.0, 0.0, 1.0)
    builder.add_joint(
        "follower", revolute, parent="world", child="follower", axis=axis, mimic=mimic,
        lower=-0.5, upper=0.5,
    )  # fmt: skip
    builder.add_joint(
        "swing", revolute, parent="world", child="swing", axis=axis, lower=-1.0, upper=0.2
    )
    builder.build()  # one after the other they would have crossed or been lost
    assert builder.build().neutral()[0] == 0.0
    with pytest.raises(saltus.ModelError, match=r"starts at 0\.3, beyond its upper limit 0\.2"):
        saltus.simulate(builder.build(), q=[0.3], duration=H, h=H)
    with pytest.raises(saltus.ModelError, match=r"starts at -0\.6, beyond its lower limit -0\.5"):
        saltus.simulate(builder.build(), q=[-0.6], duration=H, h=H)
