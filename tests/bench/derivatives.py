"""What derivatives of a step cost, beside the step, Pinocchio and MuJoCo.

    python -m tests.bench.derivatives                    # all of them
    python -m tests.bench.derivatives --scene chain      # those whose names start so

A smooth step has 1 ms; that with an impact is the first of a touching cradle, 10 ms. In C++, least
times. "vjp" is all that a product backwards needs once the step has been recorded: its arcs
evaluated again and factored, and the product. "dense" is A and B likewise, beside Pinocchio's
computeABADerivatives, those of the acceleration. MuJoCo's mjd_transitionFD makes A and B of its own
step by differences. "adjoint" is `run.gradient` of a run of 1000 steps over the run, from Python.
"""

from __future__ import annotations

import argparse
import importlib.util
import time
from dataclasses import replace

import numpy as np

import saltus
from tests.bench import scenes
from tests.bench.kernels import Programs
from tests.bench.scenes import Scene
from tests.bench.table import grid

STEPS = 1000  # of the run whose gradient is timed
SECONDS = 0.02  # CPU time that MuJoCo's differences are repeated for


def chosen(quick: bool) -> list[Scene]:
    """Return the models."""
    if quick:
        return [scenes.chain(2), scenes.touching_cradle(3)]
    chains = [scenes.chain(n) for n in (8, 32, 64, 128)]
    return [*chains, *scenes.robots()[0], scenes.touching_cradle(3), scenes.touching_cradle(10)]


def is_smooth(scene: Scene) -> bool:
    return scene.kind != "touching"


def of_mujoco(scene: Scene) -> dict[str, float]:
    """Return [us] of mjd_transitionFD, nothing where MuJoCo is not installed."""
    if not importlib.util.find_spec("mujoco") or not is_smooth(scene):
        return {}
    import mujoco

    from tests.bench.engines.mujoco import Steps

    steps = Steps(scene, mujoco.mjtIntegrator.mjINT_EULER)
    steps.reset()
    steps.advance(10)
    n, m = 2 * steps.model.nv, steps.model.nu
    A, B = np.zeros((n, n)), np.zeros((n, m)) if m else None

    def call() -> None:
        mujoco.mjd_transitionFD(steps.model, steps.data, 1e-6, True, A, B, None, None)

    return {"mujoco_transition": 1e6 * least(call)}


def least(call, seconds: float = SECONDS) -> float:
    """Return [s] of thread CPU time, the least of all calls in about so long."""
    spent, best = 0.0, float("inf")
    while spent < seconds or best == float("inf"):
        begin = time.thread_time()
        call()
        took = time.thread_time() - begin
        spent, best = spent + took, min(best, took)
    return best


def of_a_run(scene: Scene, steps: int) -> dict[str, float]:
    """Return [us] a step of a run, and of its gradient."""
    model = saltus.load_urdf(
        scene.urdf, effects="none", root_joint="floating" if scene.floating else "fixed"
    )
    if is_smooth(scene):
        v = np.full(model.n_v, scene.rate)
        v[: 6 if scene.floating else 0] = 0
        start = model.state(model.integrate(model.neutral(), np.full(model.n_v, scene.angle)), v)
        h = 1e-3
    else:
        start, h = model.state({"swing_0": scene.angle}), 1e-2

    def run() -> saltus.Trajectory:
        return saltus.simulate(model, state=start, duration=steps * h, h=h, progress=False)

    made = run()
    ones = np.ones(model.n_v)
    return {
        "run": 1e6 * least(run) / steps,
        "gradient": 1e6 * least(lambda: made.gradient(ones, ones)) / steps,
    }


def row_of(scene: Scene, programs: Programs, seconds: float, steps: int) -> dict:
    """Measure one model."""
    bare = scene if is_smooth(scene) else replace(scene, rate=0.0)
    row = {"model": scene.name, **programs.derivatives(bare, seconds)}
    if is_smooth(scene):
        row |= programs.pinocchio(scene, seconds)
    return row | of_mujoco(scene) | of_a_run(scene, steps)


def measure(programs: Programs, *, quick: bool, seconds: float) -> list[dict]:
    """Measure all models."""
    steps = 20 if quick else STEPS
    return [row_of(scene, programs, seconds, steps) for scene in chosen(quick)]


COLUMNS = [
    "model", "n", "step [µs]", "recorded", "vjp / step", "with model / step", "dense [µs]",
    "/ ABA derivatives", "mjd_transitionFD / dense", "adjoint / run",
]  # fmt: skip


def cells(row: dict) -> list[str]:
    def time_of(name: str) -> float | None:
        return row[name]["min"] if name in row else None

    def ratio(a: float | None, b: float | None) -> str:
        return "-" if a is None or b is None else f"{a / b:.2f}"

    step, line = row["step"]["min"], row["linearize"]["min"]
    dense = row["dense"]["min"]
    return [
        row["model"],
        str(row["n"]),
        f"{step:.1f}",
        ratio(time_of("recorded"), step),
        ratio(line + row["vjp"]["min"], step),
        ratio(line + row["vjp_model"]["min"], step),
        f"{dense:.1f}",
        ratio(dense, time_of("pinocchio_aba_derivatives")),
        ratio(row.get("mujoco_transition"), dense),
        ratio(row["gradient"], row["run"]),
    ]


HOW = """\
A derivative is of a step that has been recorded (`record=True`): "recorded" is what that costs. The
columns after it are without the step itself: a product backwards, the same with the gradient by the
model's inertias and joints, and the dense A and B, each with its arcs evaluated again. Rows of
cradles are of a step with an impact of all its balls. Pinocchio's computeABADerivatives gives the
derivatives of the acceleration, MuJoCo's mjd_transitionFD those of its own step, by differences.
"adjoint" is `run.gradient`, which makes the steps once more, over `simulate`, both in Python."""


def markdown(rows: list[dict] | None) -> str:
    return f"{HOW}\n\n{grid(COLUMNS, [cells(row) for row in rows])}" if rows else "(not measured)"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scene", nargs="+", help="starts of names; default all")
    parser.add_argument("--seconds", type=float, default=0.2, help="CPU time a number [s]")
    parser.add_argument("--quick", action="store_true", help="tiny models: does it run?")
    args = parser.parse_args()
    targets = ["bench_derivatives"]
    if importlib.util.find_spec("pinocchio") and not args.quick:
        targets.append("bench_pinocchio")
    programs = Programs(*targets)
    print(grid(COLUMNS, []))
    for scene in chosen(args.quick):
        if args.scene is None or any(scene.name.startswith(each) for each in args.scene):
            row = row_of(scene, programs, args.seconds, 20 if args.quick else STEPS)
            print(f"| {' | '.join(cells(row))} |", flush=True)


if __name__ == "__main__":
    main()
