"""The engines' processes, and which of them are here."""

from __future__ import annotations

import importlib.util
import json
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

from tests.bench.tosses.flight import Calibration
from tests.bench.tosses.parameters import Parameter

ROOT = Path(__file__).parents[3]
ENGINES = {  # module of tests.bench.tosses.engines: what it imports, how to get it
    "saltus": ("saltus", "pip install ."),
    "mujoco": ("mujoco", "pip install mujoco"),
    "drake": ("pydrake", "pip install drake"),
    "pybullet": ("pybullet", "pip install pybullet"),
}


class Engine:
    """A process of tests.bench.tosses.engines, with a folder of tosses."""

    def __init__(self, module: str, folder: Path) -> None:
        self.module, self.cpu = module, 0.0
        command = [sys.executable, "-m", "tests.bench.tosses.engines", module, str(folder)]
        pipe = subprocess.PIPE
        # Not a pipe: one that nobody reads would fill and block the engine.
        self.said = tempfile.TemporaryFile()  # noqa: SIM115
        self.process = subprocess.Popen(
            command, cwd=ROOT, stdin=pipe, stdout=pipe, stderr=self.said, text=True
        )
        about = self._answer()
        self.name, self.version = about["name"], about["version"]
        self.settings = tuple(about["settings"])
        self.parameters = tuple(Parameter(**each) for each in about["parameters"])

    def run(
        self,
        tosses: Sequence[int],
        values: dict[str, float],
        setting: str,
        calibration: Calibration,
        **more: object,
    ) -> dict:
        """Return {"errors": a pair or a text a toss, "cpu": [s], "poses": if poses=True}."""
        job = {"tosses": list(tosses), "values": values, "setting": setting}
        job |= {"calibration": asdict(calibration), **more}
        self.process.stdin.write(json.dumps(job) + "\n")
        self.process.stdin.flush()
        answer = self._answer()
        self.cpu += answer["cpu"]
        return answer

    def _answer(self) -> dict:
        line = self.process.stdout.readline()
        if not line:
            self.process.wait()
            self.said.seek(0)
            lines = self.said.read().decode(errors="replace").strip().splitlines()
            last = (lines or ["it wrote nothing"])[-1]
            raise RuntimeError(f"the process of {self.module} ended: {last}")
        return json.loads(line)

    def close(self) -> None:
        self.process.stdin.close()
        self.process.wait(timeout=60)
        self.process.stdout.close()
        self.said.close()


def present(folder: Path, wanted: Sequence[str] = tuple(ENGINES)) -> tuple[list[Engine], list[str]]:
    """Start the wanted engines that are installed; also say in words which are not."""
    unknown = [name for name in wanted if name not in ENGINES]
    if unknown:
        raise ValueError(f"no engine {unknown[0]!r}; engines are {', '.join(ENGINES)}")
    started, absent = [], []
    for name in wanted:
        package, how = ENGINES[name]
        if importlib.util.find_spec(package) is None:
            absent.append(f"{name}: not installed, left out ({how})")
        else:
            started.append(Engine(name, folder))
    return started, absent
