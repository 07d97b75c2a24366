"""Members of enumerations may be given by their names, wherever they are arguments."""

from __future__ import annotations

import ast
from enum import Enum
from pathlib import Path

import numpy as np
import pytest
from scenes import BALL, cradle

import saltus

JOINT = {"parent": "world", "child": "arm"}
CHAIN = saltus.scenes.chain(1)


def chain() -> saltus.ModelBuilder:
    """Return two links with a shape each."""
    builder = saltus.read_urdf(saltus.scenes.chain(2))
    for link in ("link_0", "link_1"):
        builder.add_shape(link, saltus.Sphere(0.02))
    return builder


def impact(law) -> saltus.Impact:
    return saltus.Impact(0.0, ["a ~ b"], [1.0], contacts=1, law=law, fallback=False)


def joint(kind) -> saltus.Model:
    builder = saltus.ModelBuilder().add_link("arm", saltus.solid_sphere(1.0, 0.1))
    pitch = 0.1 if kind in ("helical", saltus.JointType.helical) else 0.0
    return builder.add_joint("j", kind, pitch=pitch, **JOINT).build()


def body(kind) -> saltus.Model:
    builder = saltus.ModelBuilder()
    mass = None if kind in ("fixed", saltus.JointType.fixed) else 1.0
    return builder.add_body("ball", saltus.Sphere(0.1), mass=mass, joint=kind).build()


def resolved(order) -> np.ndarray:
    return saltus.resolve_impact(np.eye(3), [[-1, 1, 0], [0, -1, 1]], [1, 0, -1], order=order).v


def batch(on_failure) -> saltus.BatchTrajectory:
    starts = {"swing_0": [0.1]}
    return saltus.simulate_batch(cradle(), starts, duration=0.01, on_failure=on_failure)


# name of the argument, enumeration, what takes it, and what of the result shows it
TAKERS = [
    ("law", saltus.ImpactLaw, lambda x: saltus.StepOptions(law=x).law),
    ("law", saltus.ImpactLaw, lambda x: saltus.Stepper(cradle(), law=x).options.law),
    ("law", saltus.ImpactLaw, lambda x: impact(x).law),
    (
        "law",
        saltus.ImpactLaw,
        lambda x: saltus.simulate(cradle(), duration=0.01, law=x).options.law,
    ),
    ("order", saltus.ImpactOrder, lambda x: saltus.StepOptions(order=x).order),
    ("order", saltus.ImpactOrder, lambda x: saltus.Stepper(cradle(), order=x).options.order),
    ("order", saltus.ImpactOrder, lambda x: resolved(x).tolist()),
    ("type", saltus.JointType, lambda x: joint(x).joints[0].type),
    ("joint", saltus.JointType, lambda x: [each.type for each in body(x).joints]),
    ("root_joint", saltus.JointType, lambda x: saltus.load_urdf(BALL, root_joint=x).n_q),
    ("solver", saltus.TreeSolver, lambda x: str(saltus.load_urdf(CHAIN, solver=x).solvers)),
    ("solver", saltus.TreeSolver, lambda x: str(chain().set_solver(x).build().solvers)),
    ("meshes", saltus.MeshUse, lambda x: saltus.load_urdf(CHAIN, meshes=x).n_pairs),
    ("inertia", saltus.InertiaUse, lambda x: saltus.load_urdf(CHAIN, inertia=x).n_q),
    ("check", saltus.InertiaCheck, lambda x: saltus.ModelBuilder().add_link("a", check=x) is None),
    ("adjacent", saltus.AdjacentLinks, lambda x: chain().set_adjacent_links(x).build().n_pairs),
    ("on_failure", saltus.OnFailure, lambda x: len(batch(x))),
]
IDS = [f"{name}-{i}" for i, (name, *_) in enumerate(TAKERS)]


@pytest.mark.parametrize(("name", "kind", "take"), TAKERS, ids=IDS)
def test_a_name_is_its_member(name, kind, take):
    for member in kind:
        if member is not saltus.ImpactLaw.custom:
            assert take(member.name) == take(member)


@pytest.mark.parametrize(("name", "kind", "take"), TAKERS, ids=IDS)
def test_another_name_is_an_error_that_lists_them(name, kind, take):
    names = ", ".join(kind.__members__)
    with pytest.raises(saltus.ModelError) as error:
        take("qqq")
    assert str(error.value) == f"{name} = 'qqq' is no {kind.__name__}; there are {names}"
    assert (error.value.element, error.value.name) == (name, "qqq")
    near = next(iter(kind)).name
    with pytest.raises(saltus.ModelError) as error:
        take(near[:-1] + "_")
    assert str(error.value).endswith(f"; there are {names}; did you mean '{near}'?")


@pytest.mark.parametrize(("name", "kind", "take"), TAKERS, ids=IDS)
def test_what_is_neither_is_a_type_error(name, kind, take):
    members = ", ".join(f"saltus.{kind.__name__}.{each}" for each in kind.__members__)
    with pytest.raises(TypeError) as error:
        take(3)
    assert str(error.value) == f"{name} = 3 is no {kind.__name__}; there are {members}"


def test_a_law_that_is_custom_needs_its_function():
    for law in ("custom", saltus.ImpactLaw.custom):
        with pytest.raises(saltus.ModelError, match="custom"):
            saltus.Stepper(cradle(), law=law)


def test_no_argument_takes_members_alone():
    stub = Path(saltus.__file__).with_name("_core.pyi").read_text()
    kinds = {n for n, x in vars(saltus).items() if isinstance(x, type) and issubclass(x, Enum)}
    for node in ast.walk(ast.parse(stub)):
        if isinstance(node, ast.FunctionDef):
            for arg in [*node.args.args, *node.args.kwonlyargs]:
                words = ast.unparse(arg.annotation).split(" | ") if arg.annotation else []
                assert not kinds & set(words) or "str" in words, (node.name, arg.arg)
