"""PyBullet: sequential impulses."""

from __future__ import annotations

import importlib.metadata

import numpy as np
import pybullet

from tests.bench.tosses.data import EDGE, GRAVITY, MASS, ROW
from tests.bench.tosses.flight import Start
from tests.bench.tosses.parameters import CUBE, FRICTION, RESTITUTION, TABLE, Parameter, table
from tests.bench.tosses.rotations import quaternion

NAME, VERSION = "PyBullet", importlib.metadata.version("pybullet")
STEPS = {"2 steps a row": 2, "4 steps a row": 4, "7 steps a row": 7}
SETTINGS = tuple(STEPS)
PARAMETERS = (
    FRICTION,
    RESTITUTION,
    Parameter("contact_erp", "", 0.2, 0.0, 0.9),
    Parameter("slowest_rebound", "m/s", 0.2, 0.001, 1.0, logarithmic=True),
    *CUBE,
    *TABLE,
)


def world(values: dict[str, float], step: float) -> int:
    """Make a world with a table and a cube; return the cube."""
    if pybullet.isConnected():  # one world at a time
        pybullet.resetSimulation()
    else:
        pybullet.connect(pybullet.DIRECT)
    pybullet.setTimeStep(step)
    pybullet.setGravity(0, 0, -GRAVITY)
    pybullet.setPhysicsEngineParameter(
        numSolverIterations=100,
        solverResidualThreshold=0.0,
        contactERP=values["contact_erp"],
        restitutionVelocityThreshold=values["slowest_rebound"],
        deterministicOverlappingPairs=1,
    )
    plane = table(values)
    floor = pybullet.createCollisionShape(pybullet.GEOM_PLANE, planeNormal=plane.normal.tolist())
    ground = pybullet.createMultiBody(0, floor, basePosition=plane.normal * plane.offset)
    # Its materials are multiplied with the cube's.
    pybullet.changeDynamics(ground, -1, lateralFriction=1.0, restitution=1.0)
    box = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=[EDGE / 2] * 3)
    cube = pybullet.createMultiBody(MASS, box)
    pybullet.changeDynamics(
        cube,
        -1,
        lateralFriction=values["friction"],
        restitution=values["restitution"],
        spinningFriction=0.0,
        rollingFriction=0.0,
        linearDamping=0.0,
        angularDamping=0.0,
        localInertiaDiagonal=[values["inertia"]] * 3,
        activationState=pybullet.ACTIVATION_STATE_DISABLE_SLEEPING,
    )
    return cube


def simulate(start: Start, values: dict[str, float], setting: str) -> np.ndarray:
    steps = STEPS[setting]
    step = ROW / steps
    cube = world(values, step)
    w, x, y, z = quaternion(start.pose[:3, :3])
    pybullet.resetBasePositionAndOrientation(cube, start.pose[:3, 3], (x, y, z, w))
    v = start.velocity + np.array([0, 0, GRAVITY * step / 2])  # steps are semi-implicit
    pybullet.resetBaseVelocity(cube, v, start.spin)
    poses = np.tile(np.eye(4), (start.rows, 1, 1))
    for pose in poses:
        place, turn = pybullet.getBasePositionAndOrientation(cube)
        pose[:3, 3] = place
        pose[:3, :3] = np.reshape(pybullet.getMatrixFromQuaternion(turn), (3, 3))
        for _ in range(steps):
            pybullet.stepSimulation()
    return poses
