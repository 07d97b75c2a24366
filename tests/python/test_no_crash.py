"""What must not end the interpreter: pickles that are ruined or old, objects without a value.

Each case runs in a process of its own; a signal that ends it is a failure.
"""

from __future__ import annotations

import contextlib
import inspect
import multiprocessing
import pickle
import random
from collections.abc import Callable

import numpy as np
import pytest
from scenes import cradle

import saltus
from saltus import _core


def survives(work: Callable[[], None]) -> None:
    process = multiprocessing.get_context("fork").Process(target=work)
    process.start()
    process.join(60)
    if process.is_alive():
        process.kill()
        raise AssertionError("it does not end")
    assert process.exitcode == 0, f"it ended with {process.exitcode}; below 0 is a signal"


CLASSES = {
    name: kind
    for name, kind in vars(_core).items()
    if inspect.isclass(kind) and type(kind) is type(saltus.Pose)
}
MAKERS = {"__init__", "__new__", "__class__", "__setstate__", "__init_subclass__"}


@pytest.mark.parametrize("name", list(CLASSES))
def test_objects_that_were_never_made(name):
    kind = CLASSES[name]

    def work() -> None:
        for member in set(dir(kind)) - MAKERS:
            with contextlib.suppress(TypeError, AttributeError):
                found = getattr(kind.__new__(kind), member)
                if callable(found):
                    found()

    survives(work)


def test_one_that_was_never_made_says_so():
    empty = saltus.Model.__new__(saltus.Model)
    for use in (repr, lambda model: model.n_q, lambda model: model.neutral()):
        with pytest.raises(TypeError, match="Model was never made"):
            use(empty)
    with pytest.raises(TypeError, match="Model was never made"):
        saltus.simulate(empty, duration=1.0)


def some_hull() -> saltus.Convex:
    return saltus.Convex(np.random.default_rng(1).normal(size=(20, 3)))


def some_model() -> saltus.Model:
    builder = saltus.ModelBuilder().add_body("a", some_hull(), mass=1)
    builder.add_body("b", saltus.Box((1, 1, 1)), mass=1, joint="revolute", X=saltus.Pose((5, 0, 0)))
    mesh = saltus.TriangleMesh(np.eye(3), [(0, 1, 2)])
    return builder.add_visual("a", mesh).set_default_contact(restitution=0, friction=0.1).build()


def things() -> list[object]:
    model = some_model()
    options = saltus.StepOptions(h=0.01)
    mesh = model.visuals[0].shape
    return [some_hull(), model, saltus.Pose(), model.state(), options, mesh, saltus.Mimic("a")]


@pytest.mark.parametrize("protocol", [0, 1, 2, 5])
def test_all_protocols_of_pickle(protocol):
    def work() -> None:
        for thing in things():
            assert repr(pickle.loads(pickle.dumps(thing, protocol))) == repr(thing)

    survives(work)


def ruined(x: object, random: random.Random, part: float) -> object:
    """Return x with some of its numbers others, at any depth."""
    if isinstance(x, list | tuple):
        return type(x)(ruined(each, random, part) for each in x)
    if isinstance(x, dict):
        return {key: ruined(each, random, part) for key, each in x.items()}
    if isinstance(x, np.ndarray):
        out = x.copy()
        for index in np.ndindex(out.shape):
            if random.random() < part:
                out[index] = ruined(out[index].item(), random, 1.0)
        return out
    if random.random() > part:
        return x
    if isinstance(x, bool):
        return not x
    if isinstance(x, int):
        return random.choice([-1, x + 1, x + 10**6, 2**31 - 1, -(2**31), 0])
    if isinstance(x, float):
        return random.choice([float("nan"), float("inf"), -x, 0.0, 1e300])
    if isinstance(x, str):
        return x + "?"
    return x


def use(thing: object) -> None:
    repr(thing)
    if isinstance(thing, saltus.Convex):
        saltus.gap(thing, saltus.Pose((9, 0, 0)), some_hull(), saltus.Pose())
    elif isinstance(thing, saltus.Model):
        thing.gaps(None)
        saltus.simulate(thing, duration=0.02, progress=False)
    elif isinstance(thing, saltus.StepOptions):
        saltus.Stepper(cradle(), h=thing.h, max_impacts=thing.max_impacts)
    elif isinstance(thing, saltus.State):
        some_model().velocity(thing)


WRONG = (ValueError, TypeError, RuntimeError, LookupError, OverflowError)


@pytest.mark.parametrize("kind", range(7))
def test_ruined_pickles(kind):
    """Either an error, or something that can be used."""

    def work() -> None:
        thing = things()[kind]
        for seed in range(150):
            source = random.Random(seed)
            state = ruined(thing.__getstate__(), source, 10 ** source.uniform(-3, 0))
            again = type(thing).__new__(type(thing))
            with contextlib.suppress(*WRONG):
                again.__setstate__(state)
                use(again)

    survives(work)


def test_indices_of_a_hull_are_looked_at():
    state = list(some_hull().__getstate__())
    state[4] = [i + 10**6 for i in state[4]]
    with pytest.raises(saltus.ModelError, match="pickle of a Convex is ruined"):
        saltus.Convex.__new__(saltus.Convex).__setstate__(tuple(state))


I = np.eye(2)  # noqa: E741


@pytest.mark.parametrize(("M", "N"), [(1, 1e160), (1e-308, 1), (1, 1e308), (1, 1e-160), (1e300, 1)])
def test_masses_and_normals_beyond_reason(M, N):
    """Their products are infinite or nothing; with either, laws went on forever, or crashed."""
    for call in (
        lambda: saltus.resolve_impact(I * M, I * N, [-1.0, -1.0]),
        lambda: saltus.resolve_impact(I * M, I * N, [-1.0, -1.0], order="symmetric"),
        lambda: saltus.classify_impact(I * M, I * N),
        lambda: saltus.impact_outcomes(I * M, I * N, [-1.0, -1.0]),
    ):

        def work(call=call) -> None:
            with pytest.raises(saltus.ModelError, match=r"contact 0 .* scale M and N"):
                call()

        survives(work)
        with pytest.raises(saltus.ModelError, match=r"contact 0 .* scale M and N"):
            call()


def test_speeds_beyond_reason():
    with pytest.raises(saltus.ModelError, match="is not finite: scale M, N and v"):
        saltus.resolve_impact(I, I, [-1e200, -1.0])


def test_arguments_beyond_reason():
    model = cradle()
    for wrong in (10**400, np.array([1.0, 2.0])):
        with pytest.raises(TypeError, match="duration"):
            saltus.simulate(model, duration=wrong)
    with pytest.raises(saltus.ModelError, match="no coordinate"):
        model.gaps({"\ud800": 1.0})
    for call in (model.pose, lambda q, link: model.poses([q], link)):
        for index in (2**63, -(2**70), "\ud800"):
            with pytest.raises(saltus.ModelError, match="no link"):
                call(model.neutral(), index)
