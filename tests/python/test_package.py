"""The installed package, and find_package(saltus) from a project of somebody else's."""

from __future__ import annotations

import importlib
import importlib.metadata
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

try:
    import resource
except ImportError:  # not on Windows
    resource = None

import pytest
from tests.conftest import ROOT, cmake, configure, package_prefix, tool

import saltus

CONSUMER = ROOT / "tests" / "consumer"


def build_and_run_consumer(build: Path, prefix: str) -> str:
    configure(CONSUMER, build, prefix, "-DCMAKE_BUILD_TYPE=Debug")
    cmake("--build", build)
    program = build / "consumer"
    return subprocess.run([program], check=True, capture_output=True, text=True).stdout


def test_version_is_that_of_the_cmake_project():
    code = (ROOT / "CMakeLists.txt").read_text()
    version = re.search(r"project\(saltus VERSION ([0-9.]+)", code).group(1)
    assert saltus.__version__ == version == importlib.metadata.version("saltus")


@pytest.mark.parametrize("name", ["cradle", "impacts", "pairs"])
def test_old_paths_of_plots_still_work(name):
    old, new = (importlib.import_module(f"saltus.plots{mark}{name}") for mark in "_.")
    for each in old.__all__:
        assert getattr(old, each) is getattr(new, each)


@pytest.mark.slow
def test_cpp_project_finds_the_pip_package(tmp_path):
    command = [sys.executable, "-m", "saltus", "cmake-dir"]
    prefix = subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()
    assert Path(prefix).resolve() == package_prefix()
    assert build_and_run_consumer(tmp_path, prefix) == "6 coordinates\n"


@pytest.mark.slow
def test_cpp_project_finds_an_installed_tree(tmp_path):
    build, prefix = tmp_path / "plain", tmp_path / "prefix"
    python = f"-DPython_EXECUTABLE={sys.executable}"
    configure(ROOT, build, sys.prefix, "-DCMAKE_BUILD_TYPE=Release", python)
    if not link_objects_of_package(build):
        cmake("--build", build)
    cmake("--install", build, "--prefix", prefix)
    cmeel = cmeel_prefix()
    search = f"{prefix};{cmeel}" if cmeel else str(prefix)
    assert build_and_run_consumer(tmp_path / "build", search) == "6 coordinates\n"


def link_objects_of_package(build: Path) -> bool:
    """Link the library of what the package was compiled to: its sources are the same.

    Return False where that is not there, not current, or not made by Ninja; to compile all again
    takes ten minutes.
    """
    ninja, library = tool("ninja"), "libsaltus.so"
    whole = next(ROOT.glob(f"build/cp*/{library}"), None)
    sources = [path for path in (ROOT / "cpp").rglob("*") if path.suffix in {".hpp", ".cpp"}]
    newest = max(path.stat().st_mtime for path in sources)
    if ninja is None or whole is None or newest > whole.stat().st_mtime:
        return False
    objects = Path("CMakeFiles", "saltus.dir")
    shutil.copytree(whole.parent / objects, build / objects, dirs_exist_ok=True)
    ask = [ninja, "-C", build, "-t", "commands", library]
    commands = subprocess.run(ask, check=True, capture_output=True, text=True).stdout
    link = [line for line in commands.splitlines() if " -c " not in line]  # and name it
    assert any("-shared" in line for line in link)
    for line in link:
        subprocess.run(line, shell=True, cwd=build, check=True)
    return True


def cmeel_prefix() -> Path | None:
    """Return where pip keeps the C++ packages, None if the system's are used."""
    prefix = package_prefix().parent / "cmeel.prefix"
    return prefix if prefix.exists() else None


def test_missing_eigen_is_said_with_its_cure(tmp_path):
    no_eigen = "-DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON"
    with pytest.raises(subprocess.CalledProcessError) as error:
        configure(CONSUMER, tmp_path, str(package_prefix()), no_eigen)
    assert "pip install 'saltus[cpp]'" in error.value.stdout


@pytest.mark.skipif(shutil.which("readelf") is None, reason="binutils are not installed")
def test_library_looks_only_beside_itself_for_others():
    library = package_prefix() / "lib" / "libsaltus.so"
    if not library.exists():
        pytest.skip("not an ELF platform")
    command = ["readelf", "-d", library]
    dynamic = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    assert re.findall(r"\((RPATH|RUNPATH)\).*\[(.*)\]", dynamic) == [
        ("RPATH", "$ORIGIN/../../cmeel.prefix/lib")
    ]


def test_import_leaves_what_is_rarely_needed():
    """Each of these takes from 40 ms to 1 s, which a first `import saltus` should not."""
    code = "import sys, saltus; print(*sys.modules)"
    command = [sys.executable, "-c", code]
    loaded = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()
    late = {"h5py", "matplotlib", "scipy", "tqdm", "http.server", "unittest", "asyncio"}
    late |= {"subprocess", "secrets", "shutil"}
    assert not late & set(loaded)


@pytest.mark.skipif(resource is None, reason="no times of processes here")
def test_import_takes_no_longer_than_that_of_numpy_again(tmp_path):
    """Of the processor's time, the least of five: what else a machine does counts for both alike.

    NumPy takes 0.1 s where `import saltus` is to take 0.25 s.
    """
    # Both compiled, wherever they are installed: the first run does it.
    compiled = {**os.environ, "PYTHONPYCACHEPREFIX": str(tmp_path)}
    compiled.pop("PYTHONDONTWRITEBYTECODE", None)

    def least(code: str) -> float:
        times = []
        for _ in range(6):
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            subprocess.run([sys.executable, "-c", code], check=True, env=compiled)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            times.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
        return min(times[1:])

    start, numpy, own = (least(f"import {name}") for name in ("sys", "numpy", "saltus"))
    assert own - numpy < numpy - start
