"""What the cube is made of, from the first contacts of its tosses, by exact gradients.

A toss is nearly chaotic, and so is the gradient of its last row. A window is the flight, the first
contact and a few rows more. There the motion depends smoothly on what the cube is made of, but for
the few windows where a small change adds or loses an impact; and the gradient is that of this
motion, no average. A window counts s / (s + 1), s its squared error in usual units, so that those
that go another way do not decide.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize

import saltus
from tests.bench.tosses import flight
from tests.bench.tosses.data import EDGE, ROW, Toss
from tests.bench.tosses.engines.saltus import LINK, MOST_IMPACTS, build
from tests.bench.tosses.fit import USUAL
from tests.bench.tosses.parameters import CUBE, FRICTION, RESTITUTION, TABLE
from tests.bench.tosses.rotations import quaternion

H = ROW / 2  # [s] of a step
SCALES = np.repeat([USUAL[0] * EDGE, np.radians(USUAL[1])], 3)  # [m], [rad] of usual errors
FREE = (FRICTION, RESTITUTION, *CUBE)
LEAST = 0.005  # of restitution: at 0 a cube is held where it has hit, which is another motion
FROM_BEST = ("smooth", "one_sided", "selection", "grazing", "order_dependent")


@dataclass(frozen=True)
class Window:
    """What a toss does until a few rows after its first contact."""

    q: np.ndarray  # (7,) at the start, in true metres
    v: np.ndarray  # (6,)
    rows: np.ndarray  # (rows, 7) recorded, without the start
    first: int  # index of the first row that counts: the last of the flight


def windows(tosses: Sequence[Toss], calibration: flight.Calibration, after: int) -> list[Window]:
    """Return the windows of tosses that fly long enough, with `after` rows after the flight."""
    out = []
    for toss in tosses:
        n = flight.flight_rows(toss)
        if n < flight.LEAST_ROWS or n + after > len(toss.poses):
            continue
        start = flight.start(toss, calibration)
        rows = np.array([coordinates(pose) for pose in toss.poses[1 : n + after]])
        rows[:, :3] /= calibration.scale
        v = np.concatenate([start.velocity, start.spin])
        out.append(Window(coordinates(start.pose), v, rows, n - 2))
    return out


def coordinates(pose: np.ndarray) -> np.ndarray:
    """Return q of the cube at a pose (4, 4): its place, and its quaternion x y z w."""
    w, x, y, z = quaternion(pose[:3, :3])
    return np.array([*pose[:3, 3], x, y, z, w])


def model_of(values: dict[str, float]) -> saltus.Model:
    """Return the cube of these values; others are what they are at first."""
    return build({p.name: p.first for p in (*FREE, *TABLE)} | values)


def flown(model: saltus.Model, window: Window) -> tuple[saltus.Trajectory, np.ndarray]:
    """Return the motion in a window, two rows for one recorded, and the errors of rows that count.

    The errors are (rows, 6), along velocities, from the recorded to the found.
    """
    run = saltus.simulate(
        model,
        q=window.q,
        v=window.v,
        duration=len(window.rows) * ROW,
        h=H,
        progress=False,
        max_impacts=MOST_IMPACTS,
    )
    pairs = list(zip(window.rows, run.q[2::2], strict=True))[window.first :]
    return run, np.array([model.difference(recorded, found) for recorded, found in pairs])


def squared(off: np.ndarray) -> float:
    """Return s of errors: 1 where place and angle are off by what is usual."""
    return float(((off / SCALES) ** 2).sum() / len(off) / 2)


def misfit(values: dict[str, float], all_windows: Sequence[Window]) -> float:
    """Return the mean of what windows count."""
    model = model_of(values)
    s = np.array([squared(flown(model, window)[1]) for window in all_windows])
    return float(np.mean(s / (1 + s)))


def misfit_and_slope(
    values: dict[str, float], all_windows: Sequence[Window]
) -> tuple[float, dict[str, float]]:
    """Return the misfit, and its exact derivatives by the values in FREE."""
    model = model_of(values)
    link = model.link(LINK).index
    counts, slopes = [], []
    for window in all_windows:
        run, off = flown(model, window)
        s = squared(off)
        by_q = np.zeros((len(run.t), model.n_v))
        by_q[2 * window.first + 2 :: 2] = off / SCALES**2 / len(off) / (1 + s) ** 2
        g = run.gradient(by_q, np.zeros_like(by_q))
        # one moment about all axes, of which the momenta at the start are made too
        by_inertia = g.inertia[link][[4, 7, 9]].sum() + g.p[3:] @ window.v[3:]
        slopes.append((sum(g.friction.values()), sum(g.restitution.values()), by_inertia))
        counts.append(s / (1 + s))
    slope = np.mean(slopes, axis=0)
    return float(np.mean(counts)), {p.name: float(x) for p, x in zip(FREE, slope, strict=True)}


@dataclass(frozen=True)
class Identified:
    """What was found."""

    values: dict[str, float]
    misfit: float
    evaluations: int  # of the misfit and its slope


def identify(
    all_windows: Sequence[Window], free: Sequence[str] = tuple(p.name for p in FREE)
) -> Identified:
    """Return the values of least misfit, by L-BFGS-B; those not in `free` are as at first."""
    parameters = [p for p in FREE if p.name in free]

    def values(x: np.ndarray) -> dict[str, float]:
        return {p.name: float(p.value(each)) for p, each in zip(parameters, x, strict=True)}

    def at(x: np.ndarray) -> tuple[float, np.ndarray]:
        value, slope = misfit_and_slope(values(x), all_windows)
        return value, np.array([slope[p.name] * (p.high - p.low) for p in parameters])

    first = np.array([p.place(p.first) for p in parameters])
    bounds = [(p.place(LEAST if p is RESTITUTION else p.low), 1) for p in parameters]
    found = minimize(at, first, jac=True, method="L-BFGS-B", bounds=bounds)
    return Identified(values(found.x), float(found.fun), int(found.nfev))


def grid(
    all_windows: Sequence[Window], values: dict[str, float], cell: dict[str, float], cells: int
) -> dict[str, float]:
    """Return the least of (2 cells + 1)^2 points of friction and restitution, `cell` apart.

    They are around the first values; the inertia is that of `values`.
    """
    steps = np.arange(-cells, cells + 1)
    points = [
        values
        | {FRICTION.name: FRICTION.first + i * cell[FRICTION.name]}
        | {RESTITUTION.name: max(RESTITUTION.first + j * cell[RESTITUTION.name], LEAST)}
        for i in steps
        for j in steps
    ]
    return min(points, key=lambda point: misfit(point, all_windows))


def verdicts(values: dict[str, float], all_windows: Sequence[Window]) -> Counter[str]:
    """Return how many windows have which as the worst verdict of their steps."""
    model = model_of(values)
    out: Counter[str] = Counter()
    for window in all_windows:
        stepper = saltus.Stepper(model, h=H, record=True, max_impacts=MOST_IMPACTS)
        state, worst = model.state(window.q, window.v), 0
        for _ in range(2 * len(window.rows)):
            state = stepper.advance(state)
            worst = max(worst, FROM_BEST.index(stepper.derivative().smoothness.name))
        out[FROM_BEST[worst]] += 1
    return out
