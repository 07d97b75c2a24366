"""Batches over threads: 1000 cradles of three balls on one thread and on two.

Beside it what a second thread is worth at all: a loop of multiply-adds in registers
(bench_scaling.cpp), measured in turn with the batches, because machines share their cores.
Alone: python -m tests.bench.batch build/bench/bench_scaling
"""

from __future__ import annotations

import json
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

import saltus

PASSES = 5
THREADS = (1, 2)


def batch_seconds(runs: int, duration: float, threads: int) -> tuple[float, float]:
    """Return wall and CPU time of a batch of cradles, first balls let go at 0 to 0.5 rad."""
    model = saltus.load_urdf(saltus.scenes.cradle(3))
    angles = {"swing_0": np.linspace(0.0, 0.5, runs)}
    start, cpu = time.perf_counter(), time.process_time()
    batch = saltus.simulate_batch(
        model, q=angles, duration=duration, h=0.01, threads=threads, progress=False
    )
    wall, cpu = time.perf_counter() - start, time.process_time() - cpu
    if not batch.complete.all():
        raise RuntimeError(f"{len(batch.failures)} of {runs} cradles failed")
    return wall, cpu


def multiply_adds(program: Path, seconds: float, threads: int) -> float:
    """Return multiply-adds a second of all threads together."""
    command = [str(program), str(seconds), str(threads)]
    printed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    return json.loads(printed)["multiply_adds"]


def measure(
    program: Path, *, runs: int = 1000, duration: float = 2.0, passes: int = PASSES
) -> dict:
    """Measure both, taking turns.

    Parameters
    ----------
    program : Path
        The compiled bench_scaling.
    runs : int
        Cradles in the batch.
    duration : float
        [s] of each.
    passes : int
        The best of so many counts.

    Returns
    -------
    dict
        `runs`, `duration` [s], `steps`; `wall` [s], `cpu` [s] (of all threads together, which says
        something on a busy machine too) and `multiply_adds` [1/s], each by number of threads;
        `scaling` and `scaling_multiply_adds`, 2 threads over 1; `efficiency`, the one over
        the other: what a batch has of what there is.
    """
    wall: dict[int, list[float]] = {n: [] for n in THREADS}
    cpu: dict[int, list[float]] = {n: [] for n in THREADS}
    rate: dict[int, list[float]] = {n: [] for n in THREADS}
    for _ in range(passes):
        for threads in THREADS:
            for times, spent in zip(
                (wall, cpu), batch_seconds(runs, duration, threads), strict=True
            ):
                times[threads].append(spent)
        for threads in THREADS:
            # long enough for the clock, however short the batch
            rate[threads].append(multiply_adds(program, max(min(wall[1]), 0.05), threads))
    best, most = ({n: f(x[n]) for n in THREADS} for f, x in ((min, wall), (max, rate)))
    scaling, possible = best[1] / best[2], most[2] / most[1]
    return {
        "runs": runs,
        "duration": duration,
        "steps": round(runs * duration / 0.01),
        "wall": best,
        "cpu": {n: min(cpu[n]) for n in THREADS},
        "multiply_adds": most,
        "scaling": scaling,
        "scaling_multiply_adds": possible,
        "efficiency": scaling / possible,
    }


if __name__ == "__main__":
    print(json.dumps(measure(Path(sys.argv[1])), indent=1))
