"""Type stubs and docstrings cover everything public."""

from __future__ import annotations

import ast
import inspect
from pathlib import Path

import pytest

import saltus
from saltus import _core

FOLDER = Path(saltus.__file__).parent
STUB = ast.parse((FOLDER / "_core.pyi").read_text())


def names_in(body: list[ast.stmt]) -> set[str]:
    found = set()
    for node in body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            found.add(node.name)
        elif isinstance(node, ast.AnnAssign):
            found.add(node.target.id)
        elif isinstance(node, ast.Assign):
            found |= {target.id for target in node.targets if isinstance(target, ast.Name)}
    return found


def public(thing: object) -> list[str]:
    return [name for name in vars(thing) if not name.startswith("_")]


def test_package_is_typed():
    assert (FOLDER / "py.typed").exists()


def test_stub_names_everything():
    assert set(public(_core)) <= names_in(STUB.body)
    classes = {node.name: node for node in STUB.body if isinstance(node, ast.ClassDef)}
    for name, node in classes.items():
        thing = getattr(_core, name)
        missing = set(public(thing)) - names_in(node.body)
        assert not missing, (name, missing)


def test_signatures_hold_no_cpp_names():
    for name in public(_core):
        documents = [getattr(_core, name).__doc__]
        if inspect.isclass(getattr(_core, name)):
            documents += [member.__doc__ for member in vars(getattr(_core, name)).values()]
        for text in filter(None, documents):
            assert "saltus::" not in text, name
            assert "std::" not in text, name


def test_package_gives_everything_of_the_core():
    own = {"BatchTrajectory", "Trajectory", "simulate", "simulate_batch"}
    hidden = {*own, "adjoint", "states"}  # saltus has its own, around these
    for name in set(public(_core)) - hidden:
        assert getattr(saltus, name) is getattr(_core, name)
        assert name in saltus.__all__


@pytest.mark.parametrize("name", sorted(set(saltus.__all__) - {"__version__"}))
def test_everything_public_is_documented(name):
    thing = getattr(saltus, name)
    assert (thing.__doc__ or "").strip(), name
    if inspect.isclass(thing):
        own = [base for base in thing.__mro__ if base.__module__.startswith("saltus.")]
        for member in {member for base in own for member in public(base)}:
            method = inspect.getattr_static(thing, member)
            if callable(method) or isinstance(method, classmethod):
                assert (getattr(thing, member).__doc__ or "").strip(), f"{name}.{member}"
