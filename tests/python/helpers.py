"""Models and commands that several test files use."""

from __future__ import annotations

import functools
import os
import subprocess
import sys

import numpy as np

import saltus


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


def bouncing_ball(height: float = 1.0, radius: float = 0.1) -> saltus.ModelBuilder:
    """Return a ball on a vertical slide above a floor; at z = 0 it hangs `height` above it."""
    return (
        saltus.ModelBuilder("ball")
        .add_link("ball", saltus.solid_sphere(1.0, radius))
        .add_joint(
            "z",
            saltus.JointType.prismatic,
            parent="world",
            child="ball",
            X_PJ=saltus.Pose((0, 0, height + radius)),
            axis=(0, 0, 1),
        )
        .add_shape("ball", saltus.Sphere(radius))
        .add_half_space("floor", (0, 0, 1))
    )


def puck(**contact: float) -> saltus.Model:
    """Return a ball of 1 kg that slides in x and z and does not turn, on the floor z = -0.1."""
    builder = saltus.ModelBuilder("puck").add_link("slide")
    builder.add_link("puck", saltus.solid_sphere(1.0, 0.1)).add_shape("puck", saltus.Sphere(0.1))
    prismatic = saltus.JointType.prismatic
    builder.add_joint("x", prismatic, parent="world", child="slide", axis=(1, 0, 0))
    builder.add_joint("z", prismatic, parent="slide", child="puck", axis=(0, 0, 1))
    builder.add_half_space("floor", (0, 0, 1), -0.1)
    return builder.set_default_contact(**contact).build()


def random_state(model: saltus.Model, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    return rng.uniform(-1, 1, model.n_q), rng.uniform(-1, 1, model.n_q)


def run_cli(*arguments: object, **options: object) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "saltus", *map(str, arguments)]
    environment = {**os.environ, "PYTHONIOENCODING": "utf-8"}
    return subprocess.run(
        command, capture_output=True, text=True, env=environment, timeout=120, **options
    )
