"""What collisions cost: gaps beside Coal's, the broad phase's growth, a long cradle's steps."""

from __future__ import annotations

import math
from typing import Any

import saltus
from tests.bench import table
from tests.bench.kernels import Programs

HOW = """\
- gap: signed distance, normal, witnesses and features of two shapes at 64 poses, 0.5 to 2 m apart;
  Coal: `coal::distance` with normal and nearest points at the same poses, default tolerances
- broad phase: `find_candidates` for n balls that move, 1.5 m for each 1 m ball, in a row, a square
  and a cube, up to 0.02 m a call; right after the poses are written, as in a step; the mean of 128
  calls, those included that gather near pairs anew; medians of these
- cradle: a step of 1 ms of touching balls of which the first swings, beside the same pendulums
  without pairs"""


def measure(programs: Programs, seconds: float, balls: int, rounds: int = 1) -> dict:
    """Return the numbers of bench_collision and bench_coal, the least of each over the rounds."""
    result: dict = {}
    for _ in range(rounds):
        turn = programs.collision(saltus.scenes.cradle(balls), seconds)
        turn["coal"] = programs.coal(seconds)
        result = _least(result, turn) if result else turn
    result["cradle"]["balls"] = balls
    result["growth"] = growth(result["broad"])
    return result


def _least(one: Any, other: Any) -> Any:
    """Return the same structure with the lesser of each two times."""
    if isinstance(one, list):
        return [_least(x, y) for x, y in zip(one, other, strict=True)]
    if not isinstance(one, dict):
        return one
    if "median" in one:
        return {name: min(one[name], other[name]) for name in one}
    return {name: _least(one[name], other[name]) for name in one}


def growth(rows: list[dict]) -> dict[str, float]:
    """Return exponents e of time ~ n^e between the least and the largest n of each scene."""
    exponents = {}
    for scene in dict.fromkeys(row["scene"] for row in rows):
        ends = [row for row in rows if row["scene"] == scene]
        small, large = ends[0], ends[-1]
        time = large["time"]["median"] / small["time"]["median"]
        exponents[scene] = math.log(time) / math.log(large["n"] / small["n"])
    return exponents


def markdown(result: dict | None) -> str:
    """Return what `measure` found; numbers of an older run have none of it."""
    if result is None:
        return "(not measured)"
    return "\n\n".join([HOW, _gaps(result), _broad_phase(result), _cradle(result["cradle"])])


def _gaps(result: dict) -> str:
    rows = []
    for kind, time in result["gaps"].items():
        ours, theirs = time["min"], result["coal"].get(kind, {}).get("min")
        ratio = None if theirs is None else ours / theirs
        rows.append([kind, *map(table.number, (ours, theirs, ratio))])
    both = result["gradient"]["min"]
    coal = result["coal"].get("sphere-sphere", {}).get("min")
    ratio = None if coal is None else both / coal
    rows.append(["sphere-sphere of two links, with phi_q", *map(table.number, (both, coal, ratio))])
    return table.grid(["pair", "gap [µs]", "Coal [µs]", "ratio"], rows)


def _broad_phase(result: dict) -> str:
    numbers = sorted({row["n"] for row in result["broad"]})
    rows = []
    for scene, exponent in result["growth"].items():
        times = [row["time"]["median"] for row in result["broad"] if row["scene"] == scene]
        rows.append([scene, *map(table.number, (*times, exponent))])
    return table.grid(["balls in a", *(f"{n} [µs]" for n in numbers), "exponent"], rows)


def _cradle(row: dict) -> str:
    step, without = row["step"]["min"], row["without"]["min"]
    head = ["balls", "pairs", "step [µs]", "without pairs [µs]", "ratio"]
    cells = [
        str(row["balls"]),
        str(row["pairs"]),
        *map(table.number, (step, without, step / without)),
    ]
    return table.grid(head, [cells])
