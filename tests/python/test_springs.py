"""Springs between points, dampers, curves, compensation of gravity, forces of the user."""

from __future__ import annotations

import math
import pickle

import numpy as np
import pytest

import saltus
from saltus import At, BodyInertia, JointType, ModelBuilder, ModelError, Pose

H = 0.01


def bob(gravity: float = 9.81) -> ModelBuilder:
    """Return a point mass of 2 kg that flies, 1 m below a point of the world."""
    builder = ModelBuilder("bob").set_gravity((0, 0, -gravity))
    return builder.add_body("bob", saltus.Sphere(0.1), mass=2.0)


def arm() -> ModelBuilder:
    """Return two rods in a vertical plane."""
    builder = ModelBuilder("arm")
    for name, mass in (("upper", 2.0), ("lower", 1.0)):
        builder.add_link(name, BodyInertia(mass, (0.4, 0, 0), np.diag([0.001, 0.05, 0.05])))
    axis = (0, 1, 0)
    revolute = JointType.revolute
    builder.add_joint("shoulder", revolute, parent="world", child="upper", axis=axis)
    X = Pose((0.8, 0, 0))
    return builder.add_joint("elbow", revolute, parent="upper", child="lower", axis=axis, X_PJ=X)


def test_a_mass_on_a_spring_swings_by_the_phase_of_the_midpoint_rule() -> None:
    """A spring of length 0 is linear: three oscillators of one frequency, through d = 0."""
    builder = bob(gravity=0).add_spring("s", a="bob", b=At("world", (0.1, 0, 0)), stiffness=50.0)
    model = builder.build()
    run = saltus.simulate(model, q={"bob_x": 0.4}, duration=2.0, h=H)
    phase = 2 * math.atan(H * 5.0 / 2) * np.arange(201)  # omega = 5 rad/s
    np.testing.assert_allclose(run.q[:, 0], 0.1 + 0.3 * np.cos(phase), atol=1e-13)
    assert run.potential[0] == pytest.approx(0.5 * 50 * 0.3**2, rel=1e-14)
    assert run.energy_error < 1e-13


def test_a_spring_of_a_length_pulls_along_its_line() -> None:
    model = bob(gravity=0).add_spring("s", a="bob", b="world", stiffness=50, length=0.5).build()
    q = model.state({"bob_x": 0.3, "bob_y": 0.4, "bob_z": 1.2}).q
    V_q = model.inverse_dynamics(q, np.zeros(6), np.zeros(6))
    np.testing.assert_allclose(V_q[:3], 50 * (1.3 - 0.5) * np.array([0.3, 0.4, 1.2]) / 1.3)
    assert model.potential_energy(q) == pytest.approx(25 * 0.8**2)
    np.testing.assert_allclose(model.gravity_forces(q), 0)
    a = model.accelerations(q, np.zeros(6), np.zeros(6))
    np.testing.assert_allclose(a[:3], -V_q[:3] / 2)


def test_a_damper_takes_the_energy_that_is_missing() -> None:
    builder = arm()
    builder.add_spring(
        "s",
        a=At("lower", (0.8, 0, 0)),
        b=At("world", (0, 0, 1)),
        stiffness=30,
        length=0.6,
        damping=2,
    )
    model = builder.build()
    errors = []
    for h in (0.01, 0.005):
        run = saltus.simulate(model, q=[0.3, 0.5], duration=3.0, h=h)
        assert run.work["damping"][-1] < -5
        assert (np.diff(run.work["damping"]) <= 0).all()
        errors.append(run.energy_error)
    assert errors[0] < 1e-3
    assert errors[0] / errors[1] == pytest.approx(4, abs=0.3)  # order 2


def test_a_spring_with_both_ends_in_one_point_is_named() -> None:
    model = bob().add_spring("bungee", a="bob", b="world", stiffness=50, length=0.5).build()
    state = model.state()
    with pytest.raises(saltus.StepError, match='spring "bungee" has both ends in one point'):
        saltus.Stepper(model, h=H).advance(state)
    model = bob().add_spring("bungee", a="bob", b="world", stiffness=50).build()
    saltus.Stepper(model, h=H).advance(model.state())


def test_a_curve_is_a_spline_and_its_integral() -> None:
    """A cubic with its own slopes at the ends is itself: V is known."""
    angles = np.linspace(-1, 1, 6)
    builder = arm().add_joint_spring("elbow", curve=(angles, 4 * angles**3), slopes=(12, 12))
    model, plain = builder.build(), arm().build()
    zero = np.zeros(2)
    for x in (-0.9, 0.1, 0.77):
        q = np.array([0.2, x])
        more = model.inverse_dynamics(q, zero, zero) - plain.inverse_dynamics(q, zero, zero)
        np.testing.assert_allclose(more, [0, 4 * x**3], atol=1e-13)
        V = model.potential_energy(q) - plain.potential_energy(q)
        assert pytest.approx(x**4 - 1, abs=1e-13) == V  # from the first point
    beyond = model.lagrangian([0.0, 3.0], zero).L_q - plain.lagrangian([0.0, 3.0], zero).L_q
    assert beyond[1] == pytest.approx(-(4 + 12 * 2))
    run = saltus.simulate(model, q=[0.0, 0.8], duration=2.0, h=H)
    assert run.energy_error < 1e-3


def test_a_curve_of_a_joint_that_mimics_is_of_its_own_displacement() -> None:
    builder = arm()
    builder.add_link("finger", BodyInertia(0.1, (0.1, 0, 0), np.diag([1e-4, 1e-3, 1e-3])))
    builder.add_joint(
        "finger",
        JointType.revolute,
        parent="lower",
        child="finger",
        axis=(0, 1, 0),
        mimic=saltus.Mimic("elbow", -2, 0.1),
    )
    plain = builder.build()
    curved = builder.add_joint_spring("finger", curve=([-2, 0, 2], [-3, 0, 3])).build()
    q, zero = np.array([0.0, 0.4]), np.zeros(2)
    more = curved.inverse_dynamics(q, zero, zero) - plain.inverse_dynamics(q, zero, zero)
    displacement = -2 * 0.4 + 0.1
    np.testing.assert_allclose(more, [0, -2 * 1.5 * displacement])


def test_a_compensated_arm_stands_still() -> None:
    builder = arm()
    for link in ("upper", "lower"):
        builder.set_gravity_compensation(link)
    model = builder.build()
    np.testing.assert_allclose(model.gravity_forces([0.3, 0.4]), 0, atol=1e-14)
    run = saltus.simulate(model, q=[0.3, 0.4], duration=1.0, h=H)
    np.testing.assert_allclose(run.q, np.broadcast_to([0.3, 0.4], run.q.shape), atol=1e-12)
    half = arm().set_gravity_compensation("lower", 0.5).build()
    whole = arm().build().gravity_forces([0.3, 0.4])
    assert half.gravity_forces([0.3, 0.4])[1] == pytest.approx(whole[1] / 2)


SPRING_URDF = """<robot name="bob">
  <link name="world"/>
  <link name="bob"><inertial><mass value="2"/>
    <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="slide" type="prismatic"><parent link="world"/><child link="bob"/>
    <axis xyz="0 0 1"/><limit lower="-9" upper="9" effort="0" velocity="0"/></joint>
  <saltus>
    <spring name="s" link1="bob" xyz1="0 0 .1" link2="world" xyz2="0 0 3" stiffness="100"
            length=".2" damping="1"/>
    <gravity_compensation link="bob" part=".5"/>
  </saltus>
</robot>"""


@pytest.mark.filterwarnings("ignore::saltus.ModelWarning")
def test_a_file_says_it_in_its_block() -> None:
    model = saltus.load_urdf(SPRING_URDF)
    builder = saltus.read_urdf(
        SPRING_URDF.replace("<spring", "<!-- ").replace('damping="1"/>', "-->")
    )
    ends = {"a": At("bob", (0, 0, 0.1)), "b": At("world", (0, 0, 3))}
    same = builder.add_spring("s", **ends, stiffness=100, length=0.2, damping=1).build()
    states = [saltus.Stepper(m, h=H).advance(m.state(v=[1.0])) for m in (model, same)]
    assert states[0] == states[1]
    assert model.gravity_forces([0.0])[0] == pytest.approx(-9.81)
    wrong = SPRING_URDF.replace('link1="bob"', 'link1="bop"')
    with pytest.raises(ModelError, match='no link "bop"; spring "s"'):
        saltus.load_urdf(wrong)


def test_models_keep_springs_in_copies_and_say_that_they_differ() -> None:
    builder = arm().add_spring("s", a="lower", b="world", stiffness=30, length=0.1, damping=2)
    builder.set_gravity_compensation("upper", 0.5)
    builder.add_joint_spring("elbow", curve=([0, 1], [0, 2]), slopes=(1, 2))
    model = builder.build()
    again = pickle.loads(pickle.dumps(model))
    a, b = (saltus.simulate(m, q=[0.1, 0.2], duration=0.3, h=H).q for m in (model, again))
    np.testing.assert_array_equal(a, b)


def test_a_run_of_a_changed_model_loads_with_its_spring(tmp_path) -> None:
    path = saltus.urdf_dir() / "arm.urdf"
    builder = saltus.read_urdf(path)
    links = [link.name for link in builder.build().links]
    builder.add_spring("s", a=links[-1], b=At(links[0], (0, 0, 2)), stiffness=5)
    run = saltus.simulate(builder.build(), duration=0.05, h=H)
    run.save(tmp_path / "run.h5")
    again = saltus.load(tmp_path / "run.h5").model
    assert again.potential_energy(again.neutral()) == run.potential[0]


def test_parts_of_models_bring_their_springs() -> None:
    other = arm().add_spring("s", a="lower", b="world", stiffness=30)
    both = ModelBuilder("two").add(other, "left_").add(other, "right_").build()
    assert both.potential_energy(np.zeros(4)) == pytest.approx(2 * 15 * 0.8**2)
    with pytest.raises(ModelError, match="have a link"):
        ModelBuilder("two").add(other, "left_").add(other, "left_")
    windy = arm().add_force("wind", lambda now: [0, 0])
    with pytest.raises(ModelError, match='force "wind" of "arm" is a function of that model'):
        ModelBuilder("two").add(windy, "left_")


@pytest.mark.parametrize(
    ("spring", "message"),
    [
        ({"a": "lowr", "b": "world"}, 'no link "lowr"; spring "s" asks for it; links are world'),
        ({"a": "lower", "b": "world", "stiffness": -1}, "has stiffness -1; it is finite and at"),
        ({"a": "lower", "b": "world", "damping": math.nan}, "has damping nan"),
        ({"a": "lower", "b": "world", "length": math.inf}, "has length inf"),
        ({"a": At("lower", (math.inf, 0, 0)), "b": "world"}, "that is not finite"),
    ],
)
def test_wrong_springs_are_named(spring: dict, message: str) -> None:
    builder = arm()
    with pytest.raises(ModelError, match=message):
        builder.add_spring("s", **spring)
    builder.add_spring("s", a="lower", b="world")  # nothing was added
    with pytest.raises(ModelError, match='two springs are named "s"'):
        builder.add_spring("s", a="lower", b="world")


def test_other_wrong_springs_are_named() -> None:
    with pytest.raises(ModelError, match="which are one body: it would do nothing"):
        arm().add_spring("s", a="lower", b=At("lower", (1, 0, 0)), stiffness=1).build()
    for curve, message in [
        (([0, 1], [0, 1, 2]), "of 2 displacements and 3 forces"),
        (([0, 0], [0, 1]), "whose displacement 0 follows 0; they ascend"),
        (([0, math.nan], [0, 1]), r"with \(nan, 1\) at 1"),
        (([], []), "of no points"),
    ]:
        with pytest.raises(ModelError, match=message):
            arm().add_joint_spring("elbow", curve=curve)
    with pytest.raises(ModelError, match="slopes are of a curve"):
        arm().add_joint_spring("elbow", stiffness=1, slopes=(0, 0))
    with pytest.raises(ModelError, match="has gravity compensation nan"):
        arm().set_gravity_compensation("lower", math.nan)


HUGE = [
    lambda b: b.add_spring("s", a="lower", b="world", stiffness=1e300),
    lambda b: b.add_spring("s", a="lower", b="world", stiffness=1, length=1e200),
    lambda b: b.add_joint_spring("elbow", stiffness=1e300),
    lambda b: b.add_joint_spring("elbow", stiffness=1, rest=-1e300),
    lambda b: b.add_joint_spring("elbow", curve=([0, 1], [0, 1e300])),
    lambda b: b.add_joint_spring("elbow", curve=([0, 1], [0, 1]), slopes=(0, -1e300)),
    lambda b: b.set_damping("elbow", 1e300),
    lambda b: b.set_friction("elbow", 1e300),
    lambda b: b.set_armature("elbow", 1e300),
    lambda b: b.set_gravity_compensation("lower", 1e300),
    lambda b: b.add_motor("m", joint="elbow", gear=1e300),
    lambda b: b.add_position_servo("m", joint="elbow", kp=1e300),
    lambda b: b.add_velocity_servo("m", joint="elbow", kv=1e300),
]


@pytest.mark.parametrize("verb", HUGE)
def test_numbers_that_leave_arithmetic_no_room_are_named(verb) -> None:
    with pytest.raises(ModelError, match=r"(s|m|elbow|lower)\" .*e\+.*and at most 1e\+100"):
        verb(arm())


def test_springs_hold_where_a_body_rests_and_hits() -> None:
    """A ball on a bungee over a floor: impacts and rest, with forces that depend on q."""
    builder = ModelBuilder("bungee").add_floor(restitution=0.5, friction=0.4)
    builder.add_body("ball", saltus.Sphere(0.1), mass=1.0, X=Pose((0, 0, 1)))
    builder.add_spring("s", a="ball", b=At("world", (0.5, 0, 2)), stiffness=8, length=1, damping=1)
    run = saltus.simulate(builder.build(), duration=6.0, h=H)
    assert run.complete
    assert len(run.impacts) > 1
    assert not len(run.fallbacks)
    # 8 N/m lift a little of 9.81 N: in the end it rolls to and fro on the floor, below the spring
    assert run.q[-1, 2] == pytest.approx(-0.9, abs=1e-9)
    assert abs(run.v[-1, 0]) > 0.01
    np.testing.assert_allclose(run.v[-100:, 0], 0.1 * run.v[-100:, 4], atol=1e-9)
