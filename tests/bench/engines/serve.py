"""The loop of an engine's process: a scene comes in as a line of JSON, its times go out as one."""

from __future__ import annotations

import json
import os
import sys
import time
from collections.abc import Callable
from typing import Protocol

import numpy as np

from tests.bench.clock import PASSES, Time, summary
from tests.bench.scenes import Scene

STEPS_BEFORE, STEPS_TIMED = 10, 200  # as bench_kernels.cpp does
STEP = 1e-3  # [s]
SLOWEST = 0.05  # [s] CPU time a step; a slower engine is left out, 7 passes would take minutes


class Simulation(Protocol):
    """One scene in one engine."""

    def reset(self) -> None:
        """Go back to the scene's start."""

    def advance(self, steps: int) -> None:
        """Make steps of STEP, with as few calls as the engine has for it."""

    def angles(self) -> np.ndarray:
        """Return the joints' coordinates [rad | m], those of a free base left out."""


Load = Callable[[Scene], Simulation]


def serve(version: str, columns: dict[str, Load]) -> None:
    """Answer scenes until the input ends. `columns` are the names of what is timed."""
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # what engines print is no answer

    def answer(data: dict) -> None:
        answers.write(json.dumps(data) + "\n")
        answers.flush()

    answer({"version": version})
    for line in sys.stdin:
        scene = Scene(**json.loads(line))
        times: dict[str, Time] = {}
        errors = []
        for name, load in columns.items():
            try:
                timed = time_of_steps(load(scene))
            except Exception as error:
                errors.append(f"{name}, {scene.name}: {error}")
                continue
            if timed is not None:
                times[name] = timed
        answer({"times": times, "errors": errors})


def time_of_steps(simulation: Simulation) -> Time | None:
    """Time steps from the same start in every pass; None if they are too slow to wait for."""
    simulation.reset()
    simulation.advance(1)
    start = time.thread_time()
    simulation.advance(1)
    if time.thread_time() - start > SLOWEST:
        return None
    seconds = []
    for _ in range(PASSES):
        simulation.reset()
        simulation.advance(STEPS_BEFORE)
        start = time.thread_time()
        simulation.advance(STEPS_TIMED)
        seconds.append((time.thread_time() - start) / STEPS_TIMED)
    return summary(seconds)
