"""The same trees in MuJoCo."""

from __future__ import annotations

import time
import xml.etree.ElementTree as ET

from tests.bench.clock import PASSES, Time, summary
from tests.bench.scenes import Scene

STEPS_BEFORE, STEPS_TIMED = 10, 200  # as bench_kernels.cpp does

try:
    import mujoco
except ImportError:
    mujoco = None


def mujoco_step(scene: Scene) -> Time | None:
    """Time mj_step: Euler, 1 ms, no contacts, limits or other constraints.

    All steps of a pass are one call (nstep), so Python's calls cost nothing.
    """
    if mujoco is None:
        return None
    model = mujoco_model(scene)
    model.opt.timestep = 1e-3
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_EULER
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    data = mujoco.MjData(model)
    seconds = []
    for _ in range(PASSES):
        mujoco.mj_resetData(model, data)
        data.qpos[7 if scene.floating else 0 :] = scene.angle
        mujoco.mj_step(model, data, nstep=STEPS_BEFORE)
        start = time.thread_time()
        mujoco.mj_step(model, data, nstep=STEPS_TIMED)
        seconds.append((time.thread_time() - start) / STEPS_TIMED)
    return summary(seconds)


def mujoco_model(scene: Scene):
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
        base = root_link(scene)
        joint = (
            '<link name="world"/><joint name="root" type="floating">'
            f'<parent link="world"/><child link="{base}"/></joint>'
        )
        text = text.replace("</robot>", f"{joint}</robot>")
    return mujoco.MjModel.from_xml_string(text)


def root_link(scene: Scene) -> str:
    robot = ET.fromstring(scene.urdf)
    children = {joint.find("child").get("link") for joint in robot.iterfind("joint")}
    (root,) = (e.get("name") for e in robot.iterfind("link") if e.get("name") not in children)
    return root


def notes() -> list[str]:
    """Return which peers of this file take part, or how to get them."""
    if mujoco is None:
        return ["MuJoCo: absent (pip install 'saltus[bench]')"]
    return [f"MuJoCo {mujoco.__version__}"]
