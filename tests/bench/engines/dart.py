"""DART: World.step, without collision shapes."""

from __future__ import annotations

import time

import dartpy
import numpy as np

from tests.bench.engines.serve import STEP, serve
from tests.bench.scenes import Scene

Root = dartpy.utils.DartLoaderRootJointType


class Steps:
    """Each step is a call from Python, which the API has no loop for."""

    def __init__(self, scene: Scene) -> None:
        self.floating = scene.floating
        loader = dartpy.utils.DartLoader()
        loader.setOptions(
            dartpy.utils.DartLoaderOptions(
                defaultRootJointType=Root.FLOATING if scene.floating else Root.FIXED,
                # Links without <inertial> get this, and not 1 kg.
                defaultInertia=dartpy.dynamics.Inertia(1e-12, [0, 0, 0], 1e-12 * np.eye(3)),
            )
        )
        self.skeleton = loader.parseSkeletonString(scene.urdf, dartpy.common.Uri())
        self.world = dartpy.simulation.World()
        self.world.setNumSimulationThreads(1)
        asleep = self.world.getDeactivationOptions()
        asleep.mEnabled = False  # calm bodies would be left out of the steps
        self.world.setDeactivationOptions(asleep)
        self.world.setTimeStep(STEP)
        self.world.setGravity([0, 0, -9.81])
        self.world.addSkeleton(self.skeleton)
        base = [0.0] * 6 if scene.floating else []
        joints = self.skeleton.getNumDofs() - len(base)
        self.start = base + [scene.angle] * joints
        self.rates = base + [scene.rate] * joints

    def reset(self) -> None:
        self.world.reset()
        self.skeleton.setPositions(self.start)
        self.skeleton.setVelocities(self.rates)

    def advance(self, steps: int) -> None:
        step = self.world.step
        for _ in range(steps):
            step()

    def angles(self) -> np.ndarray:
        return self.skeleton.getPositions()[6 if self.floating else 0 :]


load = Steps


def call_overhead(calls: int = 100_000) -> float:
    """Return the time [us] of a call that does nothing."""
    nothing = dartpy.simulation.World().getTimeStep
    start = time.thread_time()
    for _ in range(calls):
        nothing()
    return 1e6 * (time.thread_time() - start) / calls


if __name__ == "__main__":
    overhead = f"{call_overhead():.2f} µs of Python's call in each"
    serve(f"DART {dartpy.__version__}, World.step ({overhead})", {"dart_step": load})
