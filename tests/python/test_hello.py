"""The two smallest programs, in Python and in C++."""

from __future__ import annotations

import subprocess
import sys

import pytest
from tests.conftest import ROOT, cmake, configure, package_prefix

EXAMPLES = ROOT / "examples"
CMAKE = f"""
cmake_minimum_required(VERSION 3.25)
project(hello LANGUAGES CXX)
find_package(saltus REQUIRED)
add_executable(hello_cradle {EXAMPLES}/hello_cradle.cpp)
target_link_libraries(hello_cradle PRIVATE saltus::saltus)
"""


def check_output(command: list[object]) -> list[str]:
    done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=ROOT)
    first, second = done.stdout.splitlines()
    assert first == "first impact at 0.50460 s"
    assert second.startswith("10 impacts, energy error ")
    return [first, second]


@pytest.mark.slow
def test_both_say_the_same(tmp_path):
    python = check_output([sys.executable, EXAMPLES / "hello_cradle.py"])
    (tmp_path / "CMakeLists.txt").write_text(CMAKE)
    configure(tmp_path, tmp_path / "build", str(package_prefix()), "-DCMAKE_BUILD_TYPE=Debug")
    cmake("--build", tmp_path / "build")
    assert check_output([tmp_path / "build" / "hello_cradle"]) == python


def test_they_are_short():
    for name in ("hello_cradle.py", "hello_cradle.cpp"):
        assert len((EXAMPLES / name).read_text().splitlines()) <= 15
