"""saltus: one step of 10 ms a look."""

from __future__ import annotations

import numpy as np

import saltus
from compare.scene import Scene

NAME, VERSION = "saltus", saltus.__version__
STEP = 0.01  # [s]
SETTING = "default law, step 10 ms; the break with order=symmetric"


class Balls:
    step = STEP

    def __init__(self, scene: Scene) -> None:
        self.model = saltus.load_urdf(scene.urdf, gravity=(0, 0, -scene.gravity))
        orders = saltus.ImpactOrder
        order = orders.symmetric if scene.kind == "break" else orders.fastest
        self.stepper = saltus.Stepper(self.model, h=STEP, order=order)
        self.state = self.model.state(scene.q, scene.v)

    def advance(self, steps: int) -> None:
        for _ in range(steps):
            self.state = self.stepper.advance(self.state)

    def coordinates(self) -> tuple[np.ndarray, np.ndarray]:
        return self.state.q, self.model.velocity(self.state)


load = Balls
