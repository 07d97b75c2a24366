"""Builds the C++ programs against the installed saltus and runs them."""

from __future__ import annotations

import importlib.metadata
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from tests.bench.scenes import Scene

import saltus

HERE = Path(__file__).parent
BUILD = HERE.parents[1] / "build" / "bench"
LARGEST_PINOCCHIO = 700  # coordinates; its dense results grow as the square


def tool(name: str) -> str:
    """Return the environment's own program, or the one on PATH."""
    own = Path(sys.executable).parent / name
    return str(own) if own.exists() else shutil.which(name) or name


class Programs:
    """The programs, compiled when sources or the installed library are newer."""

    def __init__(self, quick: bool) -> None:
        prefix = ";".join([str(saltus.cmake_dir()), *self._wheels(), sys.prefix])
        ninja = ["-GNinja", f"-DCMAKE_MAKE_PROGRAM={tool('ninja')}"]
        self._call(tool("cmake"), "-S", HERE, "-B", BUILD, *ninja, f"-DCMAKE_PREFIX_PATH={prefix}")
        # Pinocchio's headers take half a minute to compile
        only = ["--target", "bench_kernels"] if quick else []
        self._call(tool("cmake"), "--build", BUILD, *only)
        self.notes = [
            f"CPU: {_cpu()}, {os.cpu_count()} logical; µs of thread CPU time, least of 7 passes"
        ]
        self.has_pinocchio = (BUILD / "bench_pinocchio").exists()
        self.notes.append(_pinocchio_version(self.has_pinocchio))

    @staticmethod
    def _wheels() -> list[str]:
        """Return where wheels like pin put C++ libraries."""
        site = Path(saltus.__file__).parents[1]
        return [str(site / "cmeel.prefix")]

    @staticmethod
    def _call(*command: object) -> str:
        done = subprocess.run([*map(str, command)], capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"{command[0]} failed:\n{done.stdout[-4000:]}{done.stderr[-4000:]}")
        return done.stdout

    def saltus(self, scene: Scene, seconds: float) -> dict:
        return self._run("bench_kernels", scene, seconds)

    def pinocchio(self, scene: Scene, seconds: float) -> dict:
        links = scene.urdf.count("<joint ")
        if not self.has_pinocchio or links > LARGEST_PINOCCHIO:
            return {}
        times = self._run("bench_pinocchio", scene, seconds)
        return {f"pinocchio_{name}": times[name] for name in ("rnea", "derivatives")}

    def _run(self, program: str, scene: Scene, seconds: float) -> dict:
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "model.urdf"
            file.write_text(scene.urdf)
            prefix = "floating:" if scene.floating else ""
            job = f"{prefix}{file}@{scene.angle}"
            result = json.loads(self._call(BUILD / program, seconds, job))
        del result["model"]
        return result


def _pinocchio_version(built: bool) -> str:
    if not built:
        return "Pinocchio: absent (pip install 'saltus[bench]'; --quick does not compile it)"
    try:
        return f"Pinocchio {importlib.metadata.version('pin')}, its C++ library"
    except importlib.metadata.PackageNotFoundError:
        return "Pinocchio, the system's C++ library"


def _cpu() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return "unknown"
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else "unknown"
