"""The peers' processes, and which of them are here."""

from __future__ import annotations

import dataclasses
import importlib.util
import json
import subprocess
import sys
from pathlib import Path

from tests.bench.clock import Time
from tests.bench.scenes import Scene

ROOT = Path(__file__).parents[2]
PEERS = {  # module of tests.bench.engines: what it needs, how to get it
    "mujoco": ("mujoco", "MuJoCo: absent (pip install mujoco)"),
    "drake": ("pydrake", "Drake: absent (pip install drake)"),
    "dart": ("dartpy", "DART: absent (pip install dartpy)"),
}


class Peer:
    """A process of tests.bench.engines, asked scene by scene so that the engines take turns."""

    def __init__(self, name: str) -> None:
        self.name = name
        command = [sys.executable, "-m", f"tests.bench.engines.{name}"]
        pipe = subprocess.PIPE
        self.process = subprocess.Popen(
            command, cwd=ROOT, stdin=pipe, stdout=pipe, stderr=subprocess.DEVNULL, text=True
        )
        self.errors: list[str] = []
        self.version = self._answer().get("version", f"{name}: did not start")

    def steps(self, scene: Scene) -> dict[str, Time]:
        """Return the times of the peer's columns; of none that failed, which `errors` tells."""
        if self.process.poll() is not None:
            return {}
        try:
            self.process.stdin.write(json.dumps(dataclasses.asdict(scene)) + "\n")
            self.process.stdin.flush()
        except BrokenPipeError:
            return {}
        answer = self._answer()
        self.errors += answer.get("errors", [f"{self.name}, {scene.name}: process ended"])
        return answer.get("times", {})

    def _answer(self) -> dict:
        line = self.process.stdout.readline()
        return json.loads(line) if line else {}

    def close(self) -> None:
        self.process.stdin.close()
        self.process.wait(timeout=60)


def present() -> tuple[list[Peer], list[str]]:
    """Start the peers that are installed; also return how to get the others."""
    absent = [how for module, how in PEERS.values() if not importlib.util.find_spec(module)]
    started = [
        Peer(name) for name, (module, _) in PEERS.items() if importlib.util.find_spec(module)
    ]
    return started, absent
