"""python -m tests.bench.instructions: the machine instructions of fixed work, against a budget.

Unlike times, their numbers are the same in every run, however busy the machine is. They depend on
the compiler and on the processor's sets of instructions, which the budget file therefore names.
Needs valgrind, which knows AVX2 but not AVX-512: what chooses at run time, chooses AVX2.
"""

from __future__ import annotations

import argparse
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from tests.bench import contact, contact_scenes, humanoid, scenes
from tests.bench.kernels import BUILD, Programs, compiler, machine, written
from tests.bench.scenes import Scene

BUDGET = Path(__file__).with_suffix(".json")
TOLERANCE = 0.10  # above the budget; changes of a compiler's minor version stay below
VALGRIND = "valgrind is absent (Debian: apt-get install valgrind)"

BODY = """<robot name="body"><link name="body"><inertial><mass value="1"/>
<inertia ixx="0.04" iyy="0.03" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>"""

Workload = tuple[str, Scene]


def workloads() -> dict[str, Workload]:
    """Return what is counted, as words of bench_instructions.cpp and scenes."""
    robot = Scene("humanoid", "robot", humanoid.humanoid(), 0.1, floating=True)
    cradle = scenes.touching_cradle(3)
    return {
        "step, chain 8": ("step", scenes.chain(8)),
        "step, chain 32": ("step", scenes.chain(32)),
        "step, humanoid": ("step", robot),
        "step, chain 32 with servos": ("driven", scenes.chain(32)),
        "step, humanoid with servos": ("driven", robot),
        "step, free body": ("step", Scene("body", "robot", BODY, 0.3, floating=True)),
        "step, touching cradle of 3": ("step", Scene("cradle 3", "touching", cradle.urdf, 0.1)),
        "step with an impact, cradle of 3": ("impact", cradle),
        "step, tower of 10 at rest": ("rest", pile("tower 10 at rest")),
        "step, 64 boxes at rest": ("rest", pile("boxes 64")),
        "step, quadruped standing": ("rest", scenes.standing_quadruped()),
        "step, heap of 8 falling": ("fall", pile("heap 8")),
        "partials, chain 32": ("lagrangian", scenes.chain(32)),
        "partials, humanoid": ("lagrangian", robot),
    }


def pile(name: str) -> Scene:
    """Return a scene of the bench of contacts, its bodies without velocity."""
    piles = {scene.name: scene for scene in contact_scenes.scenes()}
    return Scene(name, "pile", contact.urdf_of(piles[name]), 0.0)


def count(workload: Workload) -> int:
    """Return the instructions of one step or call."""
    work, scene = workload
    with written(scene) as job, tempfile.TemporaryDirectory() as folder:
        command = [
            "valgrind",
            "--tool=callgrind",
            "--toggle-collect=saltus_bench_counted",
            f"--callgrind-out-file={folder}/out",
            str(BUILD / "bench_instructions"),
            work,
            job,
        ]
        done = subprocess.run(command, capture_output=True, text=True)
    collected = re.search(r"Collected : (\d+)", done.stderr)
    if done.returncode != 0 or collected is None:
        raise RuntimeError(f"{' '.join(command)} failed:\n{done.stderr[-4000:]}")
    return round(int(collected.group(1)) / int(done.stdout))


def measure() -> dict:
    """Count all workloads on this machine."""
    Programs("bench_instructions")
    counts = {name: count(workload) for name, workload in workloads().items()}
    return {"platform": platform(), "instructions": counts}


def platform() -> str:
    """Return what the numbers of instructions depend on."""
    here = machine()
    vectors = here.get("vectors", "").replace("avx512f", "").strip()
    name, _, version = compiler().partition(" ")
    return f"{here['architecture']} {vectors}, {name} {version.split('.')[0]}"


def excesses(counted: dict, budget: dict) -> list[str]:
    """Return what needs more instructions than its budget allows, in words."""
    lines = []
    for name, instructions in counted["instructions"].items():
        allowed = budget["instructions"].get(name)
        if allowed is None:
            lines.append(f"{name}: {instructions} instructions, no budget")
        elif instructions > (1 + TOLERANCE) * allowed:
            more = 100 * (instructions / allowed - 1)
            lines.append(f"{name}: {instructions} instructions, {more:.0f} % above {allowed}")
    if lines:
        lines.append("if that is meant: python -m tests.bench.instructions --update")
    return lines


def report(counted: dict, budget: dict) -> str:
    """Return a table of counts and budgets."""
    lines = [f"instructions of a step or call; {counted['platform']}"]
    for name, instructions in counted["instructions"].items():
        allowed = budget["instructions"].get(name)
        change = f"{100 * (instructions / allowed - 1):+.1f} %" if allowed else "no budget"
        lines.append(f"{name:34} {instructions:10} {change:>10}")
    return "\n".join(lines)


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.bench.instructions", description=__doc__)
    parser.add_argument("--update", action="store_true", help="the numbers of now are the budget")
    arguments = parser.parse_args()
    if shutil.which("valgrind") is None:
        print(VALGRIND, file=sys.stderr)
        return 2
    counted = measure()
    budget = json.loads(BUDGET.read_text()) if BUDGET.exists() else {"instructions": {}}
    print(report(counted, budget))
    if arguments.update:
        BUDGET.write_text(json.dumps(counted, indent=1) + "\n")
        return 0
    if counted["platform"] != budget.get("platform"):
        print(f"not judged: the budget is of {budget.get('platform')}")
        return 0
    over = excesses(counted, budget)
    print("\n".join(over), file=sys.stderr)
    return 1 if over else 0


if __name__ == "__main__":
    sys.exit(main())
