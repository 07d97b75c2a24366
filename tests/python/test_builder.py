"""ModelBuilder and load_urdf from Python."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from scenes import bouncing_ball, chain_on_a_body

import saltus
from saltus import JointType, ModelBuilder, Pose, Sphere


def two_links() -> ModelBuilder:
    rod = saltus.BodyInertia(1.0, (0, 0, -0.5), np.diag([0.1, 0.1, 0.01]))
    return (
        ModelBuilder("two", root="base")
        .add_link("upper", rod)
        .add_link("lower", rod)
        .add_joint(
            "hip",
            JointType.revolute,
            parent="base",
            child="upper",
            axis=(0, 2, 0),
            lower=-1,
            upper=1,
            velocity=3,
            effort=4,
            damping=0.5,
            friction=0.25,
        )
        .add_joint(
            "knee",
            JointType.revolute,
            parent="upper",
            child="lower",
            X_PJ=Pose((0, 0, -1)),
            axis=(0, 1, 0),
        )
    )


def test_everything_said_is_in_the_model():
    model = two_links().set_gravity((0, 0, -1.62)).build()
    assert model.name == "two"
    assert model.link_names == ["base", "upper", "lower"]
    hip = model.coordinates[0]
    assert (hip.name, hip.joint, hip.lower, hip.upper) == ("hip", "hip", -1, 1)
    assert (hip.velocity, hip.effort, hip.damping, hip.friction) == (3, 4, 0.5, 0.25)
    assert [link.mass for link in model.links] == [0, 1, 1]
    assert model.gravity[2] == -1.62
    assert model.source == ""
    knee = model.pose({"hip": np.pi / 2}, "lower").p
    np.testing.assert_allclose(knee, [-1, 0, 0], atol=1e-15)


def test_mimic_joints_share_a_coordinate():
    rod = saltus.BodyInertia(1.0, (0, 0, -0.5), np.diag([0.1, 0.1, 0.01]))
    model = (
        two_links()
        .add_link("mirror", rod)
        .add_joint(
            "follower",
            JointType.revolute,
            parent="base",
            child="mirror",
            axis=(0, 1, 0),
            mimic=saltus.Mimic("hip", multiplier=-1, offset=0.1),
        )
        .build()
    )
    assert model.coordinate_names == ["hip", "knee"]
    turned = model.pose({"hip": 0.4}, "mirror").R
    np.testing.assert_allclose(turned, saltus.rotation_from_rpy(0, -0.3, 0), atol=1e-15)


def test_joints_with_several_coordinates():
    model = (
        ModelBuilder()
        .add_link("body", saltus.solid_sphere(1, 0.1))
        .add_joint("free", JointType.floating, parent="world", child="body")
        .build()
    )
    assert (model.n_q, model.n_v) == (7, 6)
    assert model.joints[0].coordinates == list(range(7))
    assert model.joints[0].velocities == list(range(6))
    assert [c.unit for c in model.coordinates] == ["m"] * 3 + ["1"] * 4


def test_shapes_pairs_and_exclusions():
    def builder() -> ModelBuilder:
        return (
            two_links()
            .add_shape("upper", Sphere(0.1))
            .add_shape("lower", Sphere(0.1), Pose((0, 0, -1)))
            .add_shape("lower", saltus.Capsule(0.05, 0.2), Pose((0, 0, -0.5)))
            .add_half_space("floor", (0, 0, 1), offset=-3)
        )

    model = builder().build()
    assert "lower#2" in [shape.name for shape in model.shapes]
    assert any("floor" in name for name in model.pair_names)
    fewer = builder().add_exclusion("lower", "base").build()
    assert len(fewer.pairs) < len(model.pairs)


def rename(builder: ModelBuilder) -> ModelBuilder:
    return builder.add_link("upper")


@pytest.mark.parametrize(
    ("change", "message", "culprit"),
    [
        (lambda b: b.add_link("upper"), 'two links are named "upper"', ("link", "upper")),
        (lambda b: b.add_link("x", saltus.BodyInertia(-1)), "mass -1", ("link", "x")),
        (lambda b: b.add_link("x", saltus.BodyInertia(1, I_J=np.diag([1, 0, 0])))
         .add_joint("j", JointType.revolute, parent="base", child="x").build(),
         "principal moments", ("link", "x")),
        (lambda b: b.add_joint("x", JointType.revolute, parent="upper", child="lower",
                               axis=(0, 0, 0)), "zero axis", ("joint", "x")),
        (lambda b: b.add_joint("x", JointType.revolute, parent="upper", child="lower",
                               lower=1, upper=-1), "lower limit 1", ("joint", "x")),
        (lambda b: b.add_shape("upper", Sphere(-0.1)), "sphere of size", ("link", "upper")),
        (lambda b: b.add_shape("upper", saltus.HalfSpace()), "half-space", ("link", "upper")),
        (lambda b: b.add_half_space("floor", (0, 0, 0)), "normal", ("half_space", "floor")),
        (lambda b: b.add_link("loose", saltus.solid_sphere(1, 1)).build(), "loose",
         ("link", "loose")),
        (lambda b: b.add_shape("nowhere", Sphere(1)).build(), "nowhere", ("link", "nowhere")),
        (lambda b: b.set_gravity((0, 0, np.nan)), "gravity", ("", "")),
    ],
)  # fmt: skip
def test_mistakes_are_named(change, message, culprit):
    with pytest.raises(saltus.ModelError) as error:
        change(two_links())
    assert message in str(error.value)
    assert (error.value.element, error.value.name) == culprit


def test_check_finds_what_build_finds():
    builder = two_links().add_link("loose", saltus.solid_sphere(1, 1))
    with pytest.raises(saltus.ModelError, match="loose"):
        builder.check()


def test_inertia_arithmetic():
    ball = saltus.solid_sphere(2.0, 0.1)
    np.testing.assert_allclose(ball.I_J, 0.4 * 2 * 0.01 * np.eye(3))
    dumbbell = ball.seen_from(Pose((0, 0, 1))) + ball.seen_from(Pose((0, 0, -1)))
    assert dumbbell.mass == 4
    np.testing.assert_allclose(dumbbell.c_J, 0, atol=1e-15)
    np.testing.assert_allclose(np.diag(dumbbell.I_J), [4.016, 4.016, 0.016])
    assert "mass=2.0" in repr(ball)


def test_poses_compose():
    turn = Pose((1, 2, 3), saltus.rotation_from_rpy(0.1, 0.2, 0.3))
    product = turn * turn.inverse()
    np.testing.assert_allclose(product.matrix(), np.eye(4), atol=1e-15)
    np.testing.assert_allclose((turn * turn).matrix(), turn.matrix() @ turn.matrix(), atol=1e-15)
    np.testing.assert_allclose(turn * (0, 0, 0), [1, 2, 3])


WITH_MESH = """
<robot name="m">
  <link name="base"/>
  <link name="arm">
    <inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <collision><geometry><mesh filename="package://nowhere/arm.stl"/></geometry></collision>
  </link>
  <joint name="hinge" type="continuous"><parent link="base"/><child link="arm"/></joint>
</robot>
"""


def test_what_is_not_used_is_warned_of_and_kept():
    with pytest.warns(saltus.ModelWarning) as record:
        model = saltus.load_urdf(WITH_MESH)
    assert [str(w.message) for w in record] == model.warnings
    assert any("mesh" in text for text in model.warnings)
    assert record[0].filename == __file__


def test_a_plain_file_gives_no_warning(tmp_path):
    path = tmp_path / "cradle.urdf"
    path.write_text(saltus.scenes.cradle(2))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        model = saltus.load_urdf(path)
        assert saltus.load_urdf(str(path)).source == model.source == path.read_text()


def test_urdf_options():
    model = saltus.load_urdf(chain_on_a_body(), gravity=(0, 0, -1), root_joint=JointType.floating)
    assert (model.n_q, model.n_v) == (9, 8)
    assert model.gravity[2] == -1


@pytest.mark.parametrize("gravity", [9.81, (0, -9.81), "down"])
def test_gravity_has_three_components(gravity):
    with pytest.raises(saltus.ModelError, match="three components"):
        saltus.load_urdf(saltus.scenes.chain(1), gravity=gravity)


def test_a_urdf_file_can_be_added_to():
    builder = saltus.read_urdf(saltus.scenes.cradle(2)).add_half_space("floor", (0, 0, 1), -1)
    assert "ball_0 ~ floor" in builder.build().pair_names


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("/nowhere/model.urdf", "/nowhere/model.urdf"),
        ("<robot name='m'>", "URDF text:"),
        ("<robot name='m'><link name='a'/><link name='b'/></robot>", "root"),
    ],
)
def test_bad_urdf_is_a_model_error(text, message):
    with pytest.raises(saltus.ModelError, match=message):
        saltus.load_urdf(text)


def test_wrong_types_are_type_errors():
    for wrong in (3, None, b"<robot/>"):
        with pytest.raises((TypeError, saltus.ModelError)):
            saltus.load_urdf(wrong)
    with pytest.raises(TypeError):
        saltus.load_urdf(saltus.scenes.chain(1), (0, 0, -9.81))  # keyword-only


def test_bouncing_ball_helper_hangs_where_it_says():
    gaps = bouncing_ball(height=2.0).build().gaps([0.0])
    assert gaps.phi == pytest.approx([2.0])
