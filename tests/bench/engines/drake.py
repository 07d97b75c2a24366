"""Drake: the discrete step of a MultibodyPlant without a scene graph, hence without contacts."""

from __future__ import annotations

import importlib.metadata

import numpy as np
from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import MultibodyPlant
from pydrake.systems.analysis import Simulator

from tests.bench.engines.serve import STEP, serve
from tests.bench.scenes import Scene, root_link


class Steps:
    """All steps of a pass are one call of Simulator.AdvanceTo."""

    def __init__(self, scene: Scene) -> None:
        self.floating = scene.floating
        self.plant = MultibodyPlant(time_step=STEP)
        Parser(self.plant).AddModelsFromString(scene.urdf, "urdf")
        if not scene.floating:
            base = self.plant.GetFrameByName(root_link(scene.urdf))
            self.plant.WeldFrames(self.plant.world_frame(), base)
        # Sampled ports copy results for readers that are not there.
        self.plant.SetUseSampledOutputPorts(False)
        self.plant.Finalize()
        self.start = self.plant.GetDefaultPositions()
        self.start[7 if self.floating else 0 :] = scene.angle
        self.rates = np.full(self.plant.num_velocities(), scene.rate)
        self.rates[: 6 if self.floating else 0] = 0
        self.simulator = Simulator(self.plant)
        self.steps = 0

    def reset(self) -> None:
        context = self.simulator.get_mutable_context()
        context.SetTime(0.0)
        self.plant.SetPositions(context, self.start)
        self.plant.SetVelocities(context, self.rates)
        self.simulator.Initialize()
        self.steps = 0

    def advance(self, steps: int) -> None:
        self.steps += steps
        self.simulator.AdvanceTo((self.steps - 0.5) * STEP)  # between two updates, on neither

    def angles(self) -> np.ndarray:
        positions = self.plant.GetPositions(self.simulator.get_context())
        return positions[7 if self.floating else 0 :]


load = Steps

if __name__ == "__main__":
    version = importlib.metadata.version("drake")
    serve(f"Drake {version}, discrete step", {"drake_step": load})
