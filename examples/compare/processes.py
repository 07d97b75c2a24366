"""The engines' processes: one after the other, so that none slows or disturbs another."""

from __future__ import annotations

import importlib.util
import json
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from compare.scene import Scene

FOLDER = Path(__file__).parents[1]
ENGINES = {  # module of compare.engines: what it imports
    "saltus": "saltus",
    "mujoco": "mujoco",
    "dart": "dartpy",
    "pybullet": "pybullet",
    "pymunk": "pymunk",
}


def absent() -> list[str]:
    """Return a line for every engine that is not installed."""
    return [
        f"{package}: not installed, left out (pip install {package})"
        for package in ENGINES.values()
        if importlib.util.find_spec(package) is None
    ]


def run_engines(scenes: Sequence[Scene]) -> list[dict]:
    """Run the scenes in every engine that is installed; see `run_engine`."""
    there = [name for name, package in ENGINES.items() if importlib.util.find_spec(package)]
    return [run_engine(name, scenes) for name in there]


def run_engine(name: str, scenes: Sequence[Scene]) -> dict:
    """Return name, version and setting of an engine, and its measures by the scenes' names.

    Where the engine fails, the scenes from there on are missing and "error" is the last line that
    it wrote.
    """
    done = subprocess.run(
        [sys.executable, "-m", "compare.engines", name],
        cwd=FOLDER,
        input="".join(scene.json() + "\n" for scene in scenes),
        capture_output=True,
        text=True,
    )
    answers = [json.loads(line) for line in done.stdout.splitlines()]
    about = answers[0] if answers else {"name": name, "version": "?", "setting": "did not start"}
    if done.returncode != 0:
        about["error"] = (done.stderr.strip().splitlines() or [f"code {done.returncode}"])[-1]
    measured = zip(scenes, answers[1:], strict=False)
    return about | {"scenes": {scene.name: answer for scene, answer in measured}}
