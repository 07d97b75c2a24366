"""Models that several test files play with: beads, boxes, cradles, chains, floors."""

from __future__ import annotations

import functools

import numpy as np

import saltus
from saltus import JointType, ModelBuilder, Pose

BALL = """
<robot name="ball">
  <link name="ball">
    <inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <collision><geometry><sphere radius="0.1"/></geometry></collision>
  </link>
</robot>
"""


@functools.cache
def cradle(balls: int = 3) -> saltus.Model:
    return saltus.load_urdf(saltus.scenes.cradle(balls))


@functools.cache
def chain(links: int) -> saltus.Model:
    return saltus.load_urdf(saltus.scenes.chain(links))


def chain_on_a_body(links: int = 2) -> str:
    """Return a chain whose root link has mass, so that it can float."""
    body = (
        '<link name="frame"><inertial><mass value="1"/><inertia ixx="0.1" ixy="0" ixz="0" '
        'iyy="0.1" iyz="0" izz="0.1"/></inertial></link>'
    )
    return saltus.scenes.chain(links).replace('<link name="frame"/>', body)


@functools.cache
def cradle_run() -> saltus.Trajectory:
    return saltus.simulate(cradle(), q={"swing_0": 0.3}, duration=2.0, progress=False)


def line(balls: int) -> np.ndarray:
    """Return the gradients of the gaps x_(i+1) - x_i - 2r of balls in a row."""
    return np.eye(balls)[1:] - np.eye(balls)[:-1]


def add_bead(builder: ModelBuilder, name: str, at=(0, 0, 0), axis=(1, 0, 0), radius=0.05) -> None:
    """Add a ball of 1 kg that slides along an axis; link and joint have the name."""
    prismatic = JointType.prismatic
    shape, X = saltus.Sphere(radius), Pose(at)
    builder.add_body(name, shape, mass=1.0, X=X, joint=prismatic, axis=axis)


def beads(count: int) -> ModelBuilder:
    """Return balls x_0, x_1, ... that touch in a row, without gravity."""
    builder = ModelBuilder("beads").set_gravity((0, 0, 0))
    for i in range(count):
        add_bead(builder, f"x_{i}", (0.1 * i, 0, 0))
    return builder


def bouncing_ball(height: float = 1.0, radius: float = 0.1) -> ModelBuilder:
    """Return a ball on a vertical slide above a floor; at z = 0 it hangs `height` above it."""
    builder = ModelBuilder("ball")
    shape, X = saltus.Sphere(radius), Pose((0, 0, height + radius))
    slide = {"joint": JointType.prismatic, "joint_name": "z", "axis": (0, 0, 1)}
    return builder.add_body("ball", shape, mass=1.0, X=X, **slide).add_half_space(
        "floor", (0, 0, 1)
    )


def add_in_the_plane(
    builder: ModelBuilder, name: str, shape: object, mass: float, turns: bool = True
) -> ModelBuilder:
    """Add a body that moves in x and z and, if it turns, about y."""
    last = "lift" if turns else name
    builder.add_link("slide")
    if turns:
        builder.add_link("lift")
    builder.add_link(name, saltus.solid_inertia(mass, shape)).add_shape(name, shape)
    prismatic = JointType.prismatic
    builder.add_joint("x", prismatic, parent="world", child="slide", axis=(1, 0, 0))
    builder.add_joint("z", prismatic, parent="slide", child=last, axis=(0, 0, 1))
    if turns:
        continuous = JointType.continuous
        builder.add_joint("turn", continuous, parent="lift", child=name, axis=(0, 1, 0))
    return builder


def puck(**contact: float) -> saltus.Model:
    """Return a ball of 1 kg that slides in x and z and does not turn, on the floor z = -0.1."""
    builder = add_in_the_plane(ModelBuilder("puck"), "puck", saltus.Sphere(0.1), 1.0, turns=False)
    return builder.add_half_space("floor", (0, 0, 1), -0.1).set_default_contact(**contact).build()


def two_bodies(**shapes: object) -> ModelBuilder:
    """Return free bodies of these shapes, each with the inertia of a ball of 1 kg and 0.1 m."""
    builder = ModelBuilder("two")
    for name, shape in shapes.items():
        builder.add_link(name, saltus.solid_sphere(1.0, 0.1)).add_shape(name, shape)
        builder.add_joint(name, JointType.floating, parent="world", child=name)
    return builder


def on_slope(shape: object, angle: float, mass: float = 2.0, **contact: float) -> saltus.Model:
    """Return a free body "block" that lies, 0.1 m high, on a slope which falls towards +x."""
    up = np.array([np.sin(angle), 0, np.cos(angle)])
    X = Pose(0.1 * up, saltus.rotation_from_rpy(0, angle, 0))
    builder = ModelBuilder("block").add_body("block", shape, mass=mass, X=X, joint_name="free")
    return builder.add_half_space("slope", up).set_default_contact(**contact).build()


def thrown(shape: object, *, restitution: float, friction: float) -> saltus.Model:
    """Return a free body "body" of 1 kg over a floor."""
    builder = ModelBuilder().add_floor()
    builder.set_default_contact(restitution=restitution, friction=friction)
    return builder.add_body("body", shape, mass=1).build()
