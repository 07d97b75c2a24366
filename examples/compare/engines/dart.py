"""DART: restitution 1, contacts solved together as one linear complementarity problem."""

from __future__ import annotations

import dartpy
import numpy as np

from compare.scene import Scene

NAME, VERSION = "DART", dartpy.__version__
STEP = 2e-4  # [s]
SETTING = "step 0.2 ms, restitution 1, friction 0, DART's collision detector"


class Balls:
    def __init__(self, scene: Scene, step: float = STEP) -> None:
        self.step = step
        loader = dartpy.utils.DartLoader()
        loader.setOptions(
            dartpy.utils.DartLoaderOptions(
                defaultRootJointType=dartpy.utils.DartLoaderRootJointType.FIXED,
                # Links without <inertial> get this, and not 1 kg.
                defaultInertia=dartpy.dynamics.Inertia(1e-12, [0, 0, 0], 1e-12 * np.eye(3)),
            )
        )
        self.skeleton = loader.parseSkeletonString(scene.urdf, dartpy.common.Uri())
        self.skeleton.enableSelfCollisionCheck()
        for i in range(self.skeleton.getNumBodyNodes()):
            body = self.skeleton.getBodyNode(i)
            for k in range(body.getNumShapeNodes()):
                surface = body.getShapeNode(k).getDynamicsAspect()
                if surface is not None:
                    surface.setRestitutionCoeff(1.0)
                    surface.setFrictionCoeff(0.0)
        self.world = dartpy.simulation.World()
        self.world.setNumSimulationThreads(1)
        asleep = self.world.getDeactivationOptions()
        asleep.mEnabled = False
        self.world.setDeactivationOptions(asleep)
        detector = dartpy.collision.DARTCollisionDetector()
        self.world.getConstraintSolver().setCollisionDetector(detector)
        self.world.setTimeStep(step)
        self.world.setGravity([0, 0, -scene.gravity])
        self.world.addSkeleton(self.skeleton)
        self.skeleton.setPositions(scene.q)
        self.skeleton.setVelocities(scene.v)

    def advance(self, steps: int) -> None:
        for _ in range(steps):
            self.world.step()

    def coordinates(self) -> tuple[np.ndarray, np.ndarray]:
        return self.skeleton.getPositions(), self.skeleton.getVelocities()


load = Balls
