"""All engines before the same tosses: fits on one half, errors on the other, limits."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, replace

import numpy as np
from tqdm import tqdm

from tests.bench.tosses import fit, flight, limits
from tests.bench.tosses.data import INERTIA, Toss, halves
from tests.bench.tosses.processes import Engine


def run(tosses: list[Toss], engines: Sequence[Engine], budget: int, every: int, seed: int) -> dict:
    """Return all numbers, ready for JSON; the engines' processes are closed.

    Each engine is fitted twice: from starts as recorded, with the inertia that is given; and from
    calibrated starts, with the inertia as one more parameter. Fitted for these, it runs from starts
    by the whole flight too.
    """
    first_half, to_report = halves(tosses)
    to_fit = first_half[::every]
    calibrated = flight.calibrate([tosses[i] for i in first_half])
    from_flight = replace(calibrated, whole_flight=True)
    noise = flight.noise_of([tosses[i] for i in first_half], calibrated)
    plans = {
        "recorded": (flight.Calibration(), {"inertia": INERTIA}),
        "calibrated": (calibrated, {}),
    }
    rows, found = [], []
    for engine in engines:
        fits = {}
        for name, (calibration, fixed) in plans.items():
            with tqdm(total=budget, desc=f"{engine.name}, {name}") as bar:
                show = shown_by(bar)
                fits[name] = fit.fit(engine, to_fit, calibration, budget, seed, fixed, show)
        starts = {
            "recorded": (fits["recorded"], flight.Calibration()),
            "calibrated": (fits["calibrated"], calibrated),
            "flight": (fits["calibrated"], from_flight),
        }
        row = {"name": engine.name, "version": engine.version, "starts": {}}
        for name, (fitted, calibration) in starts.items():
            row["starts"][name] = measured(engine, to_fit, to_report, fitted, calibration)
        row["noise"] = limits.noise(engine, to_report, fits["calibrated"], from_flight, noise)
        rows.append(row | {"cpu": engine.cpu})
        found.append(fits["calibrated"])
    result = {
        "tosses": {"fitted": len(to_fit), "reported": len(to_report)},
        "budget": budget,
        "seed": seed,
        "calibration": asdict(calibrated),
        "noise": asdict(noise),
        "resting_height": float(np.median([tosses[i].poses[-1, 2, 3] for i in first_half])),  # [m]
        "engines": rows,
        "pairs": limits.pairs(engines, to_report, found, from_flight),
    }
    for engine in engines:
        engine.close()
    return result


def shown_by(bar: tqdm):
    def show(least: float) -> None:
        bar.set_postfix(score=f"{least:.4f}")
        bar.update()

    return show


def measured(
    engine: Engine,
    to_fit: Sequence[int],
    to_report: Sequence[int],
    fitted: fit.Fit,
    calibration: flight.Calibration,
) -> dict:
    """Return a fit, and the errors that it has on both halves."""
    on_fit = engine.run(to_fit, fitted.values, fitted.setting, calibration)["errors"]
    answer = engine.run(to_report, fitted.values, fitted.setting, calibration)
    return {
        "fit": asdict(fitted),
        "on_fit": fit.summary(on_fit).json(),
        "on_report": fit.summary(answer["errors"]).json(),
        "errors": answer["errors"],
        "cpu": answer["cpu"],  # [s] of all its tosses
    }
