"""Builds the C++ programs against the installed saltus and runs them."""

from __future__ import annotations

import contextlib
import importlib.metadata
import json
import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import saltus
from tests.bench.scenes import Scene

HERE = Path(__file__).parent
BUILD = HERE.parents[1] / "build" / "bench"
LARGEST_PINOCCHIO = 700  # coordinates; its dense results grow as the square


def tool(name: str) -> str:
    """Return the environment's own program, or the one on PATH."""
    own = Path(sys.executable).parent / name
    return str(own) if own.exists() else shutil.which(name) or name


class Programs:
    """The programs, compiled when sources or the installed library are newer.

    Parameters
    ----------
    targets : str
        Which to compile; all, if none is named.
    """

    def __init__(self, *targets: str) -> None:
        prefix = ";".join([str(saltus.cmake_dir()), *self._wheels(), sys.prefix])
        ninja = ["-GNinja", f"-DCMAKE_MAKE_PROGRAM={tool('ninja')}"]
        self._call(tool("cmake"), "-S", HERE, "-B", BUILD, *ninja, f"-DCMAKE_PREFIX_PATH={prefix}")
        only = ["--target", *targets] if targets else []
        self._call(tool("cmake"), "--build", BUILD, *only)
        self.has_pinocchio = (BUILD / "bench_pinocchio").exists()
        self.has_coal = (BUILD / "bench_coal").exists()

    @staticmethod
    def path(program: str) -> Path:
        return BUILD / program

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
        (row,) = self._run("bench_kernels", scene, seconds)
        return row

    def pinocchio(self, scene: Scene, seconds: float) -> dict:
        links = scene.urdf.count("<joint ")
        if not self.has_pinocchio or links > LARGEST_PINOCCHIO:
            return {}
        (times,) = self._run("bench_pinocchio", scene, seconds)
        return {f"pinocchio_{name}": time for name, time in times.items() if name != "n"}

    def derivatives(self, scene: Scene, seconds: float) -> dict:
        """Return the times of a step and of its derivatives."""
        (row,) = self._run("bench_derivatives", scene, seconds)
        return row

    def impacts(self, scene: Scene) -> list[dict]:
        """Return rows of what steps with impacts cost, one a step length."""
        rows = self._run("bench_impacts", scene, 0)
        return [{"model": scene.name, **row} for row in rows]

    def collision(self, cradle: str, seconds: float) -> dict:
        """Return the times of gaps, broad phase and a long cradle, of its URDF text."""
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "cradle.urdf"
            file.write_text(cradle)
            return json.loads(self._call(BUILD / "bench_collision", seconds, file))

    def coal(self, seconds: float) -> dict:
        """Return the times of Coal's distances by pair, none where it is absent."""
        return json.loads(self._call(BUILD / "bench_coal", seconds)) if self.has_coal else {}

    def peaks(self, seconds: float) -> dict:
        return json.loads(self._call(BUILD / "bench_peaks", seconds))

    def _run(self, program: str, scene: Scene, seconds: float) -> list[dict]:
        """Return the objects that a program prints, without the engine's name of the model."""
        with written(scene) as job:
            lines = self._call(BUILD / program, seconds, job).splitlines()
        rows = [json.loads(line) for line in lines]
        for row in rows:
            del row["model"]
        return rows


@contextlib.contextmanager
def written(scene: Scene) -> Iterator[str]:
    """Give the scene as an argument of the programs."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "model.urdf"
        file.write_text(scene.urdf)
        yield f"{'floating:' if scene.floating else ''}{file}@{scene.angle},{scene.rate}"


def versions(has_pinocchio: bool) -> list[str]:
    """Return the versions of what is measured in C++."""
    saltus_version = f"saltus {saltus.__version__}, its C++ library, {compiler()}"
    if not has_pinocchio:
        how = "pip install pin; --quick does not compile it"
        return [saltus_version, f"Pinocchio: absent ({how})"]
    try:
        pinocchio = f"Pinocchio {importlib.metadata.version('pin')}"
    except importlib.metadata.PackageNotFoundError:
        pinocchio = "Pinocchio of the system"
    return [saltus_version, f"{pinocchio}, its C++ library"]


def compiler() -> str:
    """Return the compiler of the programs, as CMake names it: GNU 12.2.0."""
    for file in BUILD.glob("CMakeFiles/*/CMakeCXXCompiler.cmake"):
        text = file.read_text()
        found = [
            re.search(rf'set\(CMAKE_CXX_COMPILER_{key} "([^"]*)"', text)
            for key in ("ID", "VERSION")
        ]
        if all(found):
            return " ".join(match.group(1) for match in found)
    return "unknown compiler"


def machine() -> dict:
    """Return the processor, for readers and for who compares numbers."""
    info = {"cpu": "unknown", "logical": os.cpu_count(), "architecture": platform.machine()}
    info["system"] = f"{platform.system()}, Python {platform.python_version()}"
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return info
    for line in lines:
        key, _, value = line.partition(":")
        if key.strip() == "model name":
            info["cpu"] = value.strip()
        elif key.strip() == "flags":
            wanted = ("avx2", "fma", "avx512f")
            info["vectors"] = " ".join(name for name in wanted if name in value.split())
    return info
