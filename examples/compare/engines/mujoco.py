"""MuJoCo: contacts are springs without damping that harden as they are pressed.

Small impedances keep the springs of several contacts apart (a spring's force then hangs on its own
depth alone, so that energy is kept); impedance that rises with depth makes them harden, so that one
contact lets go before the next is pressed.
"""

from __future__ import annotations

import mujoco
import numpy as np

from compare.scene import LENGTH, Scene

NAME, VERSION = "MuJoCo", mujoco.__version__
STEP = 2e-5  # [s]
SOLREF, SOLIMP = "-3e8 0", "0.0001 0.05 0.001 0.5 4"
SETTING = f"Euler, step 20 µs, solref {SOLREF}, solimp {SOLIMP}"


class Balls:
    def __init__(self, scene: Scene, step: float = STEP) -> None:
        self.step = step
        self.model = mujoco.MjModel.from_xml_string(_text(scene))
        self.model.opt.timestep = step
        self.data = mujoco.MjData(self.model)
        self.data.qpos[:] = scene.q
        self.data.qvel[:] = scene.v

    def advance(self, steps: int) -> None:
        mujoco.mj_step(self.model, self.data, nstep=steps)

    def coordinates(self) -> tuple[np.ndarray, np.ndarray]:
        return self.data.qpos.copy(), self.data.qvel.copy()


def _text(scene: Scene) -> str:
    hang = scene.kind == "cradle"
    joints = {
        "cradle": '<joint axis="0 1 0"/>',
        "line": '<joint type="slide" axis="1 0 0"/>',
        "break": '<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/>',
    }[scene.kind]
    centre = f"0 0 {-LENGTH if hang else 0}"
    bodies = "".join(
        f"""<body pos="{x!r} {y!r} {LENGTH if hang else 0}">{joints}
        <inertial pos="{centre}" mass="{mass!r}" diaginertia="{moment!r} {moment!r} {moment!r}"/>
        <geom type="sphere" size="{scene.radius!r}" pos="{centre}" condim="1"
         solref="{SOLREF}" solimp="{SOLIMP}"/></body>"""
        for (x, y), mass, moment in zip(scene.places, scene.masses, scene.inertias, strict=True)
    )
    return f"""<mujoco><option gravity="0 0 {-scene.gravity}"/>
    <worldbody>{bodies}</worldbody></mujoco>"""


load = Balls
