"""MuJoCo: contacts are springs and dampers; how they close is solref, how hard they are solimp."""

from __future__ import annotations

import mujoco
import numpy as np

from tests.bench.tosses.data import EDGE, GRAVITY, MASS, ROW
from tests.bench.tosses.flight import Start
from tests.bench.tosses.parameters import CUBE, FRICTION, TABLE, Parameter, frame, table
from tests.bench.tosses.rotations import quaternion

NAME, VERSION = "MuJoCo", mujoco.__version__
CONES_AND_STEPS = {
    "elliptic cone, 7 steps a row": ("elliptic", 7),
    "pyramidal cone, 7 steps a row": ("pyramidal", 7),
    "elliptic cone, 3 steps a row": ("elliptic", 3),
    "pyramidal cone, 3 steps a row": ("pyramidal", 3),
}
SETTINGS = tuple(CONES_AND_STEPS)
PARAMETERS = (
    FRICTION,
    Parameter("timeconst", "s", 0.02, 0.004, 0.1, logarithmic=True),  # of solref
    Parameter("dampratio", "", 1.0, 0.05, 3.0, logarithmic=True),
    Parameter("dmin", "", 0.9, 0.1, 0.99),  # of solimp; dmax is 0.99
    Parameter("width", "m", 0.001, 0.0001, 0.02, logarithmic=True),
    Parameter("impratio", "", 1.0, 0.3, 100.0, logarithmic=True),
    *CUBE,
    *TABLE,
)


def text(values: dict[str, float], cone: str, step: float) -> str:
    plane = table(values)
    contact = (
        f'friction="{values["friction"]} 0 0" condim="3" '
        f'solref="{values["timeconst"]} {values["dampratio"]}" '
        f'solimp="{values["dmin"]} 0.99 {values["width"]} 0.5 2"'
    )
    place = " ".join(map(str, plane.normal * plane.offset))
    turn = " ".join(map(str, quaternion(frame(plane))))
    inertia = " ".join([str(values["inertia"])] * 3)
    size = " ".join([str(EDGE / 2)] * 3)
    return f"""<mujoco>
    <option timestep="{step}" cone="{cone}" impratio="{values["impratio"]}"
     gravity="0 0 {-GRAVITY}"/>
    <worldbody><geom type="plane" size="5 5 1" pos="{place}" quat="{turn}" {contact}/>
    <body><freejoint/><inertial pos="0 0 0" mass="{MASS}" diaginertia="{inertia}"/>
    <geom type="box" size="{size}" {contact}/></body></worldbody></mujoco>"""


def simulate(start: Start, values: dict[str, float], setting: str) -> np.ndarray:
    cone, steps = CONES_AND_STEPS[setting]
    step = ROW / steps
    model = mujoco.MjModel.from_xml_string(text(values, cone, step))
    data = mujoco.MjData(model)
    R = start.pose[:3, :3]
    data.qpos[:] = np.concatenate([start.pose[:3, 3], quaternion(R)])
    data.qvel[:3] = start.velocity + np.array([0, 0, GRAVITY * step / 2])  # steps are semi-implicit
    data.qvel[3:] = start.spin @ R  # body axes
    poses = np.tile(np.eye(4), (start.rows, 1, 1))
    for pose in poses:
        mujoco.mj_normalizeQuat(model, data.qpos)
        turn = np.empty(9)
        mujoco.mju_quat2Mat(turn, data.qpos[3:])
        pose[:3, :3], pose[:3, 3] = turn.reshape(3, 3), data.qpos[:3]
        mujoco.mj_step(model, data, nstep=steps)
    if not np.isfinite(poses).all() or data.warning[mujoco.mjtWarning.mjWARN_BADQACC].number:
        raise RuntimeError("MuJoCo: the accelerations are not finite or too large")
    return poses
