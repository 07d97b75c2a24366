"""python -m tests.bench: one table against MuJoCo and Pinocchio, and its numbers as JSON."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from tests.bench import cradle, peers, scenes, table
from tests.bench.kernels import Programs


def chosen_scenes(quick: bool) -> tuple[list[scenes.Scene], list[str]]:
    if quick:
        return [scenes.chain(2), scenes.cradle(3)], []
    chains = [scenes.chain(2**k) for k in range(9)]
    cradles = [scenes.cradle(m) for m in (3, 10, 30, 100, 300, 1000)]
    robots, absent = scenes.robots()
    return chains + cradles + robots, [absent] if absent else []


def measure(quick: bool, seconds: float) -> dict:
    """Measure everything; the engines take turns model by model, on this thread."""
    programs = Programs(quick)
    chosen, notes = chosen_scenes(quick)
    rows = []
    for scene in chosen:
        row = {"model": scene.name, "kind": scene.kind, **programs.saltus(scene, seconds)}
        row["mujoco_step"] = peers.mujoco_step(scene)
        row.update(programs.pinocchio(scene, seconds))
        rows.append(row)
    duration = 1.0 if quick else 60.0
    emblem = [cradle.saltus_run(duration), cradle.mujoco_run(0.02 if quick else duration)]
    return {
        "rows": rows,
        "emblem": [run for run in emblem if run is not None],
        "notes": [*programs.notes, *peers.notes(), *notes],
    }


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m tests.bench", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="tiny models: does it run?")
    parser.add_argument("--seconds", type=float, default=0.2, help="CPU time a number [s]")
    parser.add_argument("--json", type=Path, help="where to write the numbers")
    arguments = parser.parse_args()
    seconds = 0.002 if arguments.quick else arguments.seconds
    results = measure(arguments.quick, seconds)
    print(table.markdown(results))
    text = json.dumps(results, indent=1)
    if arguments.json:
        arguments.json.write_text(text)
    else:
        print(f"\n```json\n{text}\n```")


if __name__ == "__main__":
    main()
