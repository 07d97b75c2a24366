"""Small driven models that tests of optimal control share."""

from __future__ import annotations

import math

import numpy as np

import saltus
from saltus import BodyInertia, ModelBuilder, Pose


def cart(**motor: float) -> saltus.Model:
    """Return 2 kg on a rail, driven."""
    builder = ModelBuilder().set_gravity((0, 0, 0))
    builder.add_body("cart", saltus.Box((0.1, 0.1, 0.1)), mass=2.0, joint="prismatic")
    return builder.add_motor("force", joint="cart", **motor).build()


def acrobot(effort: float = math.inf) -> saltus.Model:
    builder = ModelBuilder("acrobot")
    for name, joint, parent, z in (
        ("upper", "shoulder", "world", 0),
        ("lower", "elbow", "upper", -1),
    ):
        builder.add_link(name, BodyInertia(1.0, (0, 0, -0.5), np.eye(3) / 12))
        X = Pose((0, 0, z))
        builder.add_joint(joint, "revolute", parent=parent, child=name, X_PJ=X, axis=(0, 1, 0))
    return builder.add_motor("motor", joint="elbow", effort=effort).build()


def bouncer() -> saltus.Model:
    """Return a ball on a slide above a floor, pushed by a motor."""
    builder = ModelBuilder().add_half_space("floor", (0, 0, 1))
    X = Pose((0, 0, 0.3))
    builder.add_body("ball", saltus.Sphere(0.1), mass=1.0, X=X, joint="prismatic", axis=(0, 0, 1))
    builder.set_default_contact(restitution=0.8)
    return builder.add_motor("push", joint="ball").build()


def spinner() -> saltus.Model:
    """Return a body on a ball joint that carries a driven arm."""
    builder = ModelBuilder()
    builder.add_link("body", BodyInertia(1.0, (0, 0, -0.2), np.diag([0.03, 0.04, 0.05])))
    builder.add_joint("ball", "spherical", parent="world", child="body")
    builder.add_link("arm", BodyInertia(0.5, (0.3, 0, 0), 0.01 * np.eye(3)))
    builder.add_joint(
        "elbow", "revolute", parent="body", child="arm", X_PJ=Pose((0, 0, -0.3)), axis=(0, 1, 0)
    )
    return builder.add_motor("motor", joint="elbow").build()


def puck() -> saltus.Model:
    """Return a puck that slides on a floor with friction and may leave it, pushed along."""
    builder = ModelBuilder().add_half_space("floor", (0, 0, 1))
    builder.add_link("rail", BodyInertia(0.01, (0, 0, 0), 1e-5 * np.eye(3)))
    builder.add_joint("x", "prismatic", parent="world", child="rail", axis=(1, 0, 0))
    builder.add_link("puck", BodyInertia(1.0, (0, 0, 0), 0.004 * np.eye(3)))
    X = Pose((0, 0, 0.1))
    builder.add_joint("z", "prismatic", parent="rail", child="puck", axis=(0, 0, 1), X_PJ=X)
    builder.add_shape("puck", saltus.Sphere(0.1))
    builder.set_default_contact(friction=0.3, restitution=0.5)
    return builder.add_motor("push", joint="x").build()


def walled() -> saltus.Model:
    """Return 2 kg on a rail, driven, 1 m from an elastic wall."""
    builder = ModelBuilder().set_gravity((0, 0, 0)).add_half_space("wall", (-1, 0, 0), -1.1)
    builder.add_body("cart", saltus.Sphere(0.1), mass=2.0, joint="prismatic")
    return builder.add_motor("force", joint="cart").build()


def cue() -> saltus.Model:
    """Return a driven ball and one that it may strike, elastic, on a rail."""
    builder = ModelBuilder().set_gravity((0, 0, 0))
    for name, x in (("cue", 0.0), ("struck", 0.5)):
        builder.add_body(name, saltus.Sphere(0.1), mass=1.0, X=Pose((x, 0, 0)), joint="prismatic")
    return builder.add_motor("force", joint="cue").build()


def batter() -> saltus.Model:
    """Return an acrobot with knobs, and a free capsule that these may strike, e = 0.7."""
    builder = acrobot().builder()
    for link, z in (("lower", -1.0), ("upper", -0.5)):
        builder.add_shape(link, saltus.Sphere(0.1), Pose((0, 0, z)))
    builder.add_link("ball", saltus.solid_sphere(0.3, 0.1))
    X = Pose((0.7, 0.1, -1.5))
    builder.add_joint("free", "floating", parent="world", child="ball", X_PJ=X)
    builder.add_shape("ball", saltus.Capsule(0.1, 0.3))
    return builder.set_default_contact(restitution=0.7).build()
