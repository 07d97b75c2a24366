"""What the recorded cube is made of, by the exact gradient of the first contacts of its tosses.

Beside it: the least of a grid of the same misfit, and the errors of whole tosses that were not
used, in the measures of tests.bench.real_tosses. The tosses are no part of saltus: their folder is
an argument. A minute on one core.
"""

from __future__ import annotations

import argparse
import sys
import time
from dataclasses import replace
from pathlib import Path

from tests.bench.tosses import data, fit, flight, identify, measures
from tests.bench.tosses.engines import saltus as engine
from tests.bench.tosses.parameters import TABLE

CELL = {"friction": 0.01, "restitution": 0.02}
CELLS = 5  # about the first values


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m tests.bench.identify", description=__doc__)
    parser.add_argument("folder", type=Path, help=f"holds {data.FILE}")
    parser.add_argument("--after", type=int, default=8, help="rows after the flight")
    parser.add_argument("--every", type=int, default=2, help="use every n-th toss of the half")
    arguments = parser.parse_args()
    try:
        tosses = data.load(arguments.folder)
    except (FileNotFoundError, ValueError) as error:
        sys.exit(f"identify: {error}")
    first_half, others = ([tosses[i] for i in half] for half in data.halves(tosses))
    calibration = replace(flight.calibrate(first_half), whole_flight=True)
    used = first_half[:: arguments.every]
    found = identify.windows(used, calibration, arguments.after)
    print(f"{len(found)} windows, {arguments.after} rows after the flight of each")
    begun = time.process_time()
    answer = identify.identify(found)
    spent = time.process_time() - begun
    print(f"gradient: {told(answer.values)}")
    print(f"  misfit {answer.misfit:.4f}, {answer.evaluations} evaluations, {spent:.1f} s")
    print(f"  worst verdicts: {dict(identify.verdicts(answer.values, found))}")
    begun = time.process_time()
    least = identify.grid(found, answer.values, CELL, CELLS)
    spent = time.process_time() - begun
    points = (2 * CELLS + 1) ** 2
    print(f"grid of friction and restitution: {told(least)}")
    print(f"  misfit {identify.misfit(least, found):.4f}, {points} evaluations, {spent:.1f} s")
    print(f"whole tosses, not used: {errors(others, answer.values, calibration)}")


def told(values: dict[str, float]) -> str:
    return ", ".join(f"{name} {value:.4g}" for name, value in values.items())


def errors(
    tosses: list[data.Toss], values: dict[str, float], calibration: flight.Calibration
) -> str:
    """Return in words how far whole tosses are off."""
    all_values = {p.name: p.first for p in TABLE} | values
    found = []
    for toss in tosses:
        poses = engine.simulate(flight.start(toss, calibration), all_values, engine.SETTINGS[0])
        poses[:, :3, 3] *= calibration.scale
        found.append(measures.toss_errors(poses, toss.poses))
    s = measures.summary(found)
    return (
        f"position mean {s.position_mean:.3f} median {s.position_median:.3f} widths, "
        f"angle {s.angle_mean:.1f} and {s.angle_median:.1f} deg, score {fit.score(found):.4f}"
    )


if __name__ == "__main__":
    main()
