"""MuJoCo: mj_step without contacts, limits or other constraints."""

from __future__ import annotations

import mujoco
import numpy as np

from tests.bench.engines.serve import STEP, serve
from tests.bench.scenes import Scene, root_link

EULER, IMPLICIT = mujoco.mjtIntegrator.mjINT_EULER, mujoco.mjtIntegrator.mjINT_IMPLICIT


class Steps:
    """All steps of a pass are one call (nstep), so Python's calls cost nothing."""

    def __init__(self, scene: Scene, integrator: int) -> None:
        self.scene = scene
        self.model = load_model(scene)
        self.model.opt.timestep = STEP
        self.model.opt.integrator = integrator
        self.model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
        self.data = mujoco.MjData(self.model)

    def reset(self) -> None:
        mujoco.mj_resetData(self.model, self.data)
        self.data.qpos[7 if self.scene.floating else 0 :] = self.scene.angle
        self.data.qvel[6 if self.scene.floating else 0 :] = self.scene.rate

    def advance(self, steps: int) -> None:
        mujoco.mj_step(self.model, self.data, nstep=steps)

    def angles(self) -> np.ndarray:
        return self.data.qpos[7 if self.scene.floating else 0 :].copy()


def load(scene: Scene) -> Steps:
    return Steps(scene, EULER)


def load_model(scene: Scene):
    """Load the scene's URDF; a cradle as MJCF, whose balls may have two hinges in one body."""
    if scene.balls:
        balls = "\n".join(
            f"""<body pos="{0.1 * i} 0 1"><joint axis="0 1 0"/><joint axis="1 0 0"/>
            <inertial pos="0 0 -1" mass="1" diaginertia="0.001 0.001 0.001"/></body>"""
            for i in range(scene.balls)
        )
        return mujoco.MjModel.from_xml_string(f"<mujoco><worldbody>{balls}</worldbody></mujoco>")
    # balanceinertia: some links of robots, alone, have moments that no body can have.
    compiler = '<mujoco><compiler balanceinertia="true" fusestatic="true"/></mujoco>'
    text = scene.urdf.replace("</robot>", f"{compiler}</robot>")
    if scene.floating:
        base = root_link(scene.urdf)
        joint = (
            '<link name="world"/><joint name="root" type="floating">'
            f'<parent link="world"/><child link="{base}"/></joint>'
        )
        text = text.replace("</robot>", f"{joint}</robot>")
    return mujoco.MjModel.from_xml_string(text)


if __name__ == "__main__":
    columns = {
        "mujoco_step": load,
        "mujoco_implicit_step": lambda scene: Steps(scene, IMPLICIT),
    }
    serve(f"MuJoCo {mujoco.__version__}", columns)
