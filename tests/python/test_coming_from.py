"""The page for users of other engines: names that it promises exist."""

from __future__ import annotations

import inspect
import re

import pytest
from tests.conftest import ROOT

import saltus

PAGE = ROOT / "python" / "docs" / "coming_from.md"


def names(section: str) -> list[str]:
    """Return what stands in the last column of the tables of a section."""
    text = PAGE.read_text(encoding="utf-8").split(f"# {section}\n")[1].split("\n#")[0]
    lines = [line for line in text.splitlines() if line.startswith("|")]
    cells = [line.rstrip("|").rpartition("|")[2] for line in lines]
    found = [name for cell in cells for name in re.findall("`([^`]+)`", cell)]
    return list(dict.fromkeys(name for name in found if not name.startswith("saltus ")))


def find(name: str) -> object:
    """Return what a name means: of the package, or of its builder; None where it is neither."""
    thing: object = saltus
    for part in name.split("."):
        thing = getattr(thing, part, None)
    return thing or getattr(saltus.ModelBuilder, name, None)


def takes(thing: object, argument: str) -> bool:
    try:
        return argument in inspect.signature(thing).parameters  # type: ignore[arg-type]
    except ValueError:  # compiled: the first line of its documentation is the signature
        return f"{argument}:" in str(thing.__doc__).splitlines()[0]


@pytest.mark.parametrize("name", names("Names"))
def test_what_the_page_promises_exists(name):
    path, _, arguments = name.partition("(")
    thing = find(path)
    assert thing is not None, name
    for argument in re.findall(r"(\w+)=", arguments):
        assert takes(thing, argument), name


def test_tables_have_their_rows():
    assert len(names("Names")) > 50
