"""A shape is in few files: what python/docs/how_to_add.md promises to who adds one."""

from __future__ import annotations

import re

from tests.python.test_floors import ROOT, files, relative

SOURCES = [
    *files("cpp/**/*.cpp", "cpp/**/*.hpp", "cpp/**/*.cmake"),
    *files("python/bindings/*.cpp", "python/bindings/*.hpp", "python/saltus/**/*.py"),
    ROOT / "python" / "saltus" / "_core.pyi",
]
MANUAL = ROOT / "python" / "docs" / "how_to_add.md"


def files_that_name(shape: str) -> list[str]:
    return [relative(path) for path in SOURCES if shape in path.read_text().lower()]


def test_one_shape_is_in_few_files():
    named = files_that_name("ellipsoid")
    assert len(named) <= 10, "\n".join(named)


def test_the_manual_lists_the_files_of_a_shape():
    section = MANUAL.read_text().split("## A shape")[1].split("\n## ")[0]
    listed = re.findall(r"^\d+\. `([^`]+)`", section, re.MULTILINE)
    own = sorted(path.replace("cone", "ellipsoid") for path in listed)
    assert own == sorted(files_that_name("ellipsoid"))
