"""python -m tests.bench: saltus beside other engines, as one table and as JSON."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from tests.bench import (
    batch,
    collisions,
    contact,
    cradle,
    derivatives,
    flops,
    page,
    peers,
    scenes,
    table,
    trep,
)
from tests.bench.kernels import Programs, machine, versions

# Pinocchio's headers take half a minute to compile.
QUICK_PROGRAMS = (
    "bench_collision",
    "bench_derivatives",
    "bench_kernels",
    "bench_impacts",
    "bench_peaks",
    "bench_scaling",
)


def chosen_scenes(quick: bool) -> tuple[list[scenes.Scene], list[str]]:
    if quick:
        return [scenes.chain(2), scenes.cradle(3)], []
    chains = [scenes.chain(2**k) for k in range(9)]
    cradles = [scenes.cradle(m) for m in (3, 10, 30, 100, 300, 1000)]
    robots, absent = scenes.robots()
    return chains + cradles + robots, [absent] if absent else []


def measure_row(
    scene: scenes.Scene, programs: Programs, started: list[peers.Peer], seconds: float
) -> dict:
    """Measure every engine on one model."""
    row = {"model": scene.name, "kind": scene.kind, "pairs": scenes.ancestor_pairs(scene)}
    row |= programs.saltus(scene, seconds)
    for peer in started:
        row |= peer.steps(scene)
    return row | programs.pinocchio(scene, seconds) | trep.figures(scene.name)


def least_of(rounds: list[dict]) -> dict:
    """Return the first round's row with the least of each time that any round has."""
    row = dict(rounds[0])
    for other in rounds[1:]:
        for name, value in other.items():
            is_time = isinstance(value, dict)
            if name not in row or (is_time and value["min"] < row[name]["min"]):
                row[name] = value
    return row


def measure(quick: bool, seconds: float, rounds: int) -> dict:
    """Measure everything; the engines take turns model by model.

    Each model gets its turn once a round, minutes apart: what else the machine does for a while
    slows all passes of a turn, but seldom those of each round.
    """
    programs = Programs(*(QUICK_PROGRAMS if quick else ()))
    started, absent = peers.present()
    chosen, no_scenes = chosen_scenes(quick)
    peaks, turns = [], []
    for _ in range(rounds):
        peaks.append(programs.peaks(seconds))
        turns.append([measure_row(scene, programs, started, seconds) for scene in chosen])
    rows = [least_of(list(turn)) for turn in zip(*turns, strict=True)]
    for peer in started:
        peer.close()
    touching = [scenes.touching_cradle(m) for m in ((3,) if quick else (3, 10, 30))]
    impacts = [row for scene in touching for row in programs.impacts(scene)]
    peaks.append(programs.peaks(seconds))
    duration = 1.0 if quick else 60.0
    emblem = [cradle.saltus_run(duration), cradle.mujoco_run(0.02 if quick else duration)]
    return {
        "machine": machine(),
        "versions": versions(programs.has_pinocchio) + [peer.version for peer in started],
        "absent": absent + no_scenes,
        "errors": list(dict.fromkeys(error for peer in started for error in peer.errors)),
        "peaks": {name: max(peak[name] for peak in peaks) for name in peaks[0]},
        "rows": rows,
        "growth": flops.growth(rows),
        "impacts": impacts,
        "derivatives": derivatives.measure(programs, quick=quick, seconds=seconds / 4),
        "contact": contact.measure(quick=quick),
        "collisions": collisions.measure(
            programs,
            seconds=0.002 if quick else seconds / 4,
            balls=10 if quick else 1000,
            rounds=rounds,
        ),
        "batch": batch.measure(
            programs.path("bench_scaling"),
            runs=20 if quick else 1000,
            duration=0.1 if quick else 2.0,
            passes=1 if quick else batch.PASSES,
        ),
        "emblem": [run for run in emblem if run is not None],
    }


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m tests.bench", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="tiny models: does it run?")
    parser.add_argument("--seconds", type=float, default=0.2, help="CPU time a number [s]")
    parser.add_argument("--rounds", type=int, default=2, help="turns of each model")
    parser.add_argument("--read", type=Path, help="numbers of an earlier run; measures nothing")
    parser.add_argument("--json", type=Path, help="where to write the numbers")
    parser.add_argument("--page", type=Path, help="where to write the manual's page")
    arguments = parser.parse_args()
    if arguments.read:
        results = json.loads(arguments.read.read_text())
    elif arguments.quick:
        results = measure(quick=True, seconds=0.002, rounds=1)
    else:
        results = measure(quick=False, seconds=arguments.seconds, rounds=arguments.rounds)
    print(table.markdown(results) + "\n\n" + collisions.markdown(results.get("collisions")))
    text = json.dumps(results, indent=1)
    if arguments.json:
        arguments.json.write_text(text)
    elif not arguments.page:
        print(f"\n```json\n{text}\n```")
    if arguments.page:
        page.write(results, arguments.page)


if __name__ == "__main__":
    main()
