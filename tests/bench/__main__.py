"""python -m tests.bench: saltus beside other engines, as one table and as JSON."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from tests.bench import cradle, flops, page, peers, scenes, table, trep
from tests.bench.kernels import Programs, machine, versions

# Pinocchio's headers take half a minute to compile.
QUICK_PROGRAMS = ("bench_kernels", "bench_impacts", "bench_peaks")


def chosen_scenes(quick: bool) -> tuple[list[scenes.Scene], list[str]]:
    if quick:
        return [scenes.chain(2), scenes.cradle(3)], []
    chains = [scenes.chain(2**k) for k in range(9)]
    cradles = [scenes.cradle(m) for m in (3, 10, 30, 100, 300, 1000)]
    robots, absent = scenes.robots()
    return chains + cradles + robots, [absent] if absent else []


def measure(quick: bool, seconds: float) -> dict:
    """Measure everything; the engines take turns model by model."""
    programs = Programs(*(QUICK_PROGRAMS if quick else ()))
    started, absent = peers.present()
    chosen, no_scenes = chosen_scenes(quick)
    peaks = [programs.peaks(seconds)]
    rows = []
    for scene in chosen:
        row = {"model": scene.name, "kind": scene.kind, "pairs": scenes.ancestor_pairs(scene)}
        row |= programs.saltus(scene, seconds)
        for peer in started:
            row |= peer.steps(scene)
        row |= programs.pinocchio(scene, seconds) | trep.figures(scene.name)
        rows.append(row)
    for peer in started:
        peer.close()
    touching = [scenes.touching_cradle(m) for m in ((3,) if quick else (3, 10, 30))]
    impacts = [row for scene in touching for row in programs.impacts(scene)]
    peaks.append(programs.peaks(seconds))  # again: other programs may have been in the way
    duration = 1.0 if quick else 60.0
    emblem = [cradle.saltus_run(duration), cradle.mujoco_run(0.02 if quick else duration)]
    return {
        "machine": machine(),
        "versions": versions(programs.has_pinocchio) + [peer.version for peer in started],
        "absent": absent + no_scenes,
        "errors": [error for peer in started for error in peer.errors],
        "peaks": {name: max(peak[name] for peak in peaks) for name in peaks[0]},
        "rows": rows,
        "growth": flops.growth(rows),
        "impacts": impacts,
        "emblem": [run for run in emblem if run is not None],
    }


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m tests.bench", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="tiny models: does it run?")
    parser.add_argument("--seconds", type=float, default=0.2, help="CPU time a number [s]")
    parser.add_argument("--read", type=Path, help="numbers of an earlier run; measures nothing")
    parser.add_argument("--json", type=Path, help="where to write the numbers")
    parser.add_argument("--page", type=Path, help="where to write the manual's page")
    arguments = parser.parse_args()
    if arguments.read:
        results = json.loads(arguments.read.read_text())
    else:
        results = measure(arguments.quick, 0.002 if arguments.quick else arguments.seconds)
    print(table.markdown(results))
    text = json.dumps(results, indent=1)
    if arguments.json:
        arguments.json.write_text(text)
    elif not arguments.page:
        print(f"\n```json\n{text}\n```")
    if arguments.page:
        page.write(results, arguments.page)


if __name__ == "__main__":
    main()
