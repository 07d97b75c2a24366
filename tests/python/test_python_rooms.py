"""The rooms of python/saltus: what each may import, one way, as test_floors.py holds C++."""

from __future__ import annotations

import ast
from graphlib import CycleError, TopologicalSorter
from pathlib import Path
from typing import NamedTuple

import pytest

PACKAGE = Path(__file__).parents[2] / "python" / "saltus"

# What each room may import besides itself: rooms above it in this table. A room is a folder, or a
# module that is in none; "saltus" is the package's own __init__.
ROOMS: dict[str, set[str]] = {"_core": set()}
ROOMS["arguments"] = ROOMS["paths"] = ROOMS["scenes"] = ROOMS["urdf"] = {"_core"}  # neighbours
ROOMS["records"] = {"_core", "urdf"}
ROOMS["plots"] = {"_core", "records"}
ROOMS["view"] = {"_core", "records"}
ROOMS["runs"] = {"_core", "records", "plots", "view"}
ROOMS["optimize"] = {"_core", "runs"}
ROOMS["autodiff"] = {"_core"}
ROOMS["saltus"] = {"_core", "paths", "scenes", "urdf", "records", "runs", "optimize", "autodiff"}
ROOMS["cli"] = {"saltus", "records", "plots", "view"}
ROOMS["__main__"] = {"cli"}
ROOMS["plots_cradle"] = ROOMS["plots_impacts"] = ROOMS["plots_pairs"] = {"plots"}  # old paths
ROOMS["trajectory"] = {"runs"}

# The modules of a folder. Each may import those before it, and the folder's __init__ all of them.
ORDER = {
    "records": [
        "tables",
        "models",
        "impacts",
        "sensors",
        "options",
        "recording",
        "pairs",
        "replace",
        "stored",
        "described",
        "older_files",
        "files",
    ],
    "plots": ["figure", "lines", "gaps", "cradle", "run", "impacts", "pairs"],
    "view": [
        "arrays",
        "instants",
        "shapes",
        "parts",
        "scene",
        "page",
        "browser",
        "server",
        "video",
        "show",
        "sliders",
        "pull",
        "events",
        "frames",
        "live",
    ],
    "runs": [
        "shown",
        "gradient",
        "trajectory",
        "batch_trajectory",
        "starts",
        "progress",
        "moment",
        "simulate",
        "batch",
    ],
    "optimize": [
        "system",
        "costs",
        "curvature",
        "riccati",
        "plan",
        "iterate",
        "regulate",
        "reach",
        "shooting",
        "orbits",
        "sparse",
        "planned",
        "pieces",
        "bend",
        "program",
        "solvers",
        "transcription",
        "transcribing",
    ],
    "autodiff": ["rollout", "with_jax", "with_torch"],
    "cli": ["commands", "looking", "main"],
}


class Import(NamedTuple):
    """An import of a module of ours."""

    module: str
    line: int
    in_function: bool


def module_of(path: Path) -> str:
    """Return the name of a module: "saltus.plots.run"; an __init__ has its folder's name."""
    name = ".".join(path.relative_to(PACKAGE.parent).with_suffix("").parts)
    return name.removesuffix(".__init__")


MODULES = {module_of(path): path for path in [*PACKAGE.rglob("*.py"), PACKAGE / "_core.pyi"]}


def split(module: str) -> tuple[str, str]:
    """Return room and name in it, "" for an __init__ and for a room of one module."""
    room, _, name = module.removeprefix("saltus").removeprefix(".").partition(".")
    return room or "saltus", name


def imports_of(text: str) -> list[Import]:
    """Return all imports of modules of ours: in functions too, and for type checkers alone."""
    tree = ast.parse(text)
    functions = (ast.FunctionDef, ast.AsyncFunctionDef)
    inside = {n for f in ast.walk(tree) if isinstance(f, functions) for n in ast.walk(f)}
    found = []
    for node in ast.walk(tree):
        names: list[str] = []
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"line {node.lineno}: imports of ours begin with saltus"
            whole = [f"{node.module}.{alias.name}" for alias in node.names]
            names = [name if name in MODULES else str(node.module) for name in whole]
        ours = dict.fromkeys(name for name in names if name in MODULES)
        found += [Import(name, node.lineno, node in inside) for name in ours]
    return found


IMPORTS = {module: imports_of(path.read_text()) for module, path in MODULES.items()}


def loaded_by(module: str) -> set[str]:
    """Return what a module imports, with the folders on the way that it is not in itself."""
    loaded = set()
    for name, *_ in IMPORTS[module]:
        parts = name.split(".")
        on_the_way = {".".join(parts[:n]) for n in range(1, len(parts))}
        loaded |= {name} | {way for way in on_the_way if not f"{module}.".startswith(f"{way}.")}
    return loaded


def misplaced(module: str, imported: str) -> str:
    """Return what is wrong with an import, "" if nothing is."""
    (room, name), (other, inner) = split(module), split(imported)
    if room != other:
        return "" if other in ROOMS[room] else f"room {room!r} must not import {imported}"
    if name and (not inner or ORDER[room].index(inner) >= ORDER[room].index(name)):
        return f"in {room!r}, {inner or '__init__'} does not stand before {name}"
    return ""


def test_rooms_name_only_those_above_them():
    names = list(ROOMS)
    for room, others in ROOMS.items():
        assert others <= set(names[: names.index(room)]), room


def test_every_module_has_its_place():
    rooms = {room for room, _ in map(split, MODULES)}
    assert rooms == set(ROOMS)
    for room in rooms:
        names = [name for name in map(split, MODULES) if name[0] == room and name[1]]
        assert sorted(name for _, name in names) == sorted(ORDER.get(room, []))


@pytest.mark.parametrize("module", sorted(MODULES))
def test_imports_go_one_way(module):
    wrong = [
        f"{module}:{line}: {problem}"
        for imported, line, _ in IMPORTS[module]
        if (problem := misplaced(module, imported))
    ]
    assert not wrong, "\n".join(wrong)


def test_no_import_goes_in_a_circle():
    try:
        TopologicalSorter({module: loaded_by(module) for module in MODULES}).prepare()
    except CycleError as error:
        pytest.fail(" <- ".join(error.args[1]))


def test_modules_of_ours_are_imported_at_the_top():
    late = [
        f"{module}:{line}: {imported} is imported in a function"
        for module, found in IMPORTS.items()
        for imported, line, in_function in found
        if in_function
    ]
    assert not late, "\n".join(late)


def test_imports_are_found():
    text = """
import os, saltus
from saltus import _core, __version__
from saltus._core import Model
from saltus.plots import plot_run, run
def f():
    import saltus.runs.batch
"""
    assert imports_of(text) == [
        ("saltus", 2, False),
        ("saltus._core", 3, False),
        ("saltus", 3, False),
        ("saltus._core", 4, False),
        ("saltus.plots", 5, False),
        ("saltus.plots.run", 5, False),
        ("saltus.runs.batch", 7, True),
    ]
    assert misplaced("saltus.records.files", "saltus.runs.trajectory").startswith("room 'records'")
    assert misplaced("saltus.plots.cradle", "saltus.plots.run").startswith("in 'plots', run")
    assert misplaced("saltus.plots.run", "saltus.plots").startswith("in 'plots', __init__")
    assert not misplaced("saltus.plots", "saltus.plots.run")
