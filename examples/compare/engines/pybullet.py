"""PyBullet: restitution 1, sequential impulses."""

from __future__ import annotations

import importlib.metadata
import tempfile
from pathlib import Path

import numpy as np
import pybullet

from compare.scene import Scene

NAME, VERSION = "PyBullet", importlib.metadata.version("pybullet")
STEP = 1 / 300  # [s]
ITERATIONS = 200
SETTING = "step 1/300 s, restitution 1 at all speeds, ERP 0, 200 iterations"
FREE = {
    "restitution": 1.0,
    "lateralFriction": 0.0,
    "spinningFriction": 0.0,
    "rollingFriction": 0.0,
    "linearDamping": 0.0,
    "angularDamping": 0.0,
    "jointDamping": 0.0,
}


class Balls:
    """Pendulums on one fixed base; balls of the other scenes fly freely, without gravity."""

    def __init__(self, scene: Scene, step: float = STEP, iterations: int = ITERATIONS) -> None:
        self.step, self.scene = step, scene
        if pybullet.isConnected():  # one world at a time
            pybullet.disconnect()
        pybullet.connect(pybullet.DIRECT)
        pybullet.setTimeStep(step)
        pybullet.setGravity(0, 0, -scene.gravity)
        pybullet.setPhysicsEngineParameter(
            numSolverIterations=iterations,
            restitutionVelocityThreshold=0.0,
            erp=0.0,  # else what pushes balls apart adds to their energy
            contactERP=0.0,
            solverResidualThreshold=0.0,
            deterministicOverlappingPairs=1,
        )
        self.bodies = [_cradle(scene)] if scene.kind == "cradle" else _free_balls(scene)

    def advance(self, steps: int) -> None:
        for _ in range(steps):
            pybullet.stepSimulation()

    def coordinates(self) -> tuple[np.ndarray, np.ndarray]:
        if self.scene.kind == "cradle":
            joints = pybullet.getJointStates(self.bodies[0], range(len(self.scene.masses)))
            return np.array([j[0] for j in joints]), np.array([j[1] for j in joints])
        axes = 1 if self.scene.kind == "line" else 2
        at = [pybullet.getBasePositionAndOrientation(body)[0][:axes] for body in self.bodies]
        moves = [pybullet.getBaseVelocity(body)[0][:axes] for body in self.bodies]
        return (at - np.array(self.scene.places)[:, :axes]).ravel(), np.ravel(moves)


def _cradle(scene: Scene) -> int:
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "scene.urdf")
        file.write_text(scene.urdf)
        flags = pybullet.URDF_USE_SELF_COLLISION | pybullet.URDF_USE_INERTIA_FROM_FILE
        body = pybullet.loadURDF(str(file), useFixedBase=True, flags=flags)
    for joint, (q, v) in enumerate(zip(scene.q, scene.v, strict=True)):
        pybullet.changeDynamics(body, joint, **FREE)
        pybullet.resetJointState(body, joint, q, v)
        pybullet.setJointMotorControl2(body, joint, pybullet.VELOCITY_CONTROL, force=0)
    return body


def _free_balls(scene: Scene) -> list[int]:
    ball = pybullet.createCollisionShape(pybullet.GEOM_SPHERE, radius=scene.radius)
    axes = 1 if scene.kind == "line" else 2
    starts = np.zeros((len(scene.masses), 3))
    starts[:, :axes] = np.reshape(scene.v, (-1, axes))
    bodies = []
    for (x, y), mass, v in zip(scene.places, scene.masses, starts, strict=True):
        body = pybullet.createMultiBody(mass, ball, basePosition=(x, y, 0))
        pybullet.changeDynamics(body, -1, **FREE)
        pybullet.resetBaseVelocity(body, v.tolist())
        bodies.append(body)
    return bodies


load = Balls
