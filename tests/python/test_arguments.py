"""Wrong arguments of compiled functions: one line that names the culprit and what is expected."""

from __future__ import annotations

import inspect

import numpy as np
import pytest
from scenes import bouncing_ball, cradle

import saltus
from saltus import _core

JOINT = {"name": "hinge", "parent": "world", "child": "arm"}


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (
            lambda: saltus.Stepper(cradle(), h="x"),
            "Stepper() is given h = 'x' (str), which is no number",
        ),
        (
            lambda: saltus.Stepper(cradle(), max_impacts=1.5),
            "Stepper() is given max_impacts = 1.5 (float), which is no whole number",
        ),
        (
            lambda: saltus.Stepper(cradle(), collisions="no"),
            "Stepper() is given collisions = 'no' (str), which is no bool",
        ),
        (
            lambda: saltus.ModelBuilder().add_joint(type=1, axis=(1, 0, 0), **JOINT, pitch="x"),
            "add_joint() is given type = 1 (int), which is no JointType or str",
        ),
        (
            lambda: saltus.ModelBuilder().add_joint(
                type=saltus.JointType.revolute, axis=(0, 1), **JOINT
            ),
            "add_joint() is given axis of shape (2,); it must have shape (3,)",
        ),
        (
            lambda: saltus.ModelBuilder().add_joint(
                type=saltus.JointType.revolute, mimic="knee", **JOINT
            ),
            "add_joint() is given mimic = 'knee' (str), which is no Mimic or None",
        ),
        (
            lambda: saltus.ModelBuilder().set_contact("a", "b", restitution="x"),
            "set_contact() is given restitution = 'x' (str), which is no number",
        ),
        (
            lambda: saltus.ModelBuilder().add_shape("arm", "sphere"),
            "add_shape() is given shape = 'sphere' (str), which is no Sphere or Capsule or Box or "
            "Cylinder or HalfSpace or Ellipsoid or Convex",
        ),
        (
            lambda: saltus.ModelBuilder(3),
            "ModelBuilder() is given name = 3 (int), which is no str",
        ),
        (
            lambda: saltus.Convex(np.zeros((5, 2))),
            "Convex() is given points of shape (5, 2); it must have shape (m, 3)",
        ),
        (
            lambda: saltus.Convex("cube.stl"),
            "Convex() is given points = 'cube.stl' (str), which is no array of numbers of shape "
            "(m, 3)",
        ),
        (
            lambda: saltus.classify_impact("x", [[1.0]]),
            "classify_impact() is given M = 'x' (str), which is no array of numbers of shape "
            "(m, n)",
        ),
        (
            lambda: saltus.simulate(cradle(), duration="x"),
            "simulate() is given duration = 'x' (str), which is no number",
        ),
        (
            lambda: saltus.simulate(cradle(), duration=1.0, h=None),
            "StepOptions() is given h = None (NoneType), which is no number",
        ),
        (
            lambda: saltus.simulate(cradle(), duration=1.0, state={"swing_0": 0.3}),
            "simulate() is given start = {'swing_0': 0.3} (dict), which is no State",
        ),
        (
            lambda: saltus.Stepper(cradle()).advance({"swing_0": 0.3}),
            "advance() is given state = {'swing_0': 0.3} (dict), which is no State",
        ),
        (
            lambda: saltus.Sphere("x" * 99),
            "Sphere() is given radius = '" + 55 * "x" + " ... (str), which is no number",
        ),
        (
            lambda: saltus.ModelBuilder("lift").set_prescribed("rise", 7),
            "set_prescribed() is given times = 7 (int), which is no sequence of numbers or None",
        ),
        (
            lambda: saltus.Impact(
                0, ["a", 1], [1, 2], contacts=1, law=saltus.ImpactLaw.nodal_energy, fallback=False
            ),
            "Impact() is given pairs = ['a', 1] (list), which is no sequence of str",
        ),
        (
            lambda: saltus.ModelBuilder().add_actuator("a", joints={"j": 1}, bias=(1, 2)),
            "add_actuator() is given bias = (1, 2) (tuple), which is no sequence of 3 numbers",
        ),
        (
            lambda: saltus.close_loops(cradle(), keep="swing_0"),
            "close_loops() is given keep = 'swing_0' (str), which is no sequence of str",
        ),
    ],
)
def test_a_value_of_a_wrong_type(call, message):
    with pytest.raises(TypeError) as error:
        call()
    assert str(error.value) == message
    assert error.value.__cause__ is None


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (
            lambda: saltus.Stepper(cradle(), hh=0.1),
            'Stepper() has no argument "hh"; arguments are model, h, law, collisions, order, '
            "certify, max_iterations, max_impacts, max_halvings, max_impulses, rest, simultaneous",
        ),
        (lambda: saltus.Capsule(0.1), "Capsule() lacks half_length; arguments are radius, half_l"),
        (
            lambda: saltus.ModelBuilder().add_exclusion("a"),
            "add_exclusion() lacks link_b; arguments are link_a, link_b",
        ),
        (lambda: saltus.Sphere(0.1, radius=0.2), "Sphere() is given radius twice"),
        (
            lambda: saltus.Stepper(cradle(), 0.01, saltus.ImpactLaw.nodal_energy, True),
            "Stepper() is given 4 arguments without a name; it takes model, h, law, the others by",
        ),
        (
            lambda: saltus.ModelBuilder().set_group("a", "b", "c"),
            "set_group() is given 3 arguments without a name; it takes link, group",
        ),
        (
            lambda: saltus.StepOptions(max_impacts=10**12),
            "StepOptions() cannot use max_impacts = 1000000000000; arguments are h, law, collis",
        ),
        (lambda: saltus.HalfSpace(1), "HalfSpace() is given 1 argument; it takes none"),
        (lambda: cradle().without_collisions(1), "without_collisions() is given 1 argument; it"),
    ],
)
def test_arguments_that_are_not_those_of_the_function(call, message):
    with pytest.raises(TypeError) as error:
        call()
    assert str(error.value).startswith(message)


def bound(owner: object) -> list:
    members = [getattr(owner, name) for name in vars(owner) if not name.startswith("_")]
    return [each for each in members if callable(each) and not inspect.isclass(each)]


def test_no_function_prints_its_signatures():
    """Every function and class, called with what none of them knows."""
    classes = [each for each in vars(_core).values() if inspect.isclass(each)]
    calls = [each for owner in (_core, *classes) for each in bound(owner)] + classes
    asked = 0
    for call in calls:
        with pytest.raises(TypeError) as error:
            call(nonsense=1)
        asked += 'has no argument "nonsense"' in str(error.value)
        assert "argument types are supported" not in str(error.value), call
    assert asked > 50


def test_numbers_of_all_kinds_are_taken():
    for radius in (1, 0.5, np.float32(0.5), np.int64(2), np.array(0.5)):
        assert saltus.Sphere(radius).radius == float(radius)
    assert saltus.StepOptions(max_impacts=np.int32(7)).max_impacts == 7
    assert saltus.Pose() * (1, 0, 0) == pytest.approx([1, 0, 0])
    with pytest.raises(TypeError, match="unsupported operand"):
        saltus.Pose() * None


@pytest.mark.parametrize("value", [True, np.True_])
@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda x: saltus.Sphere(x), "Sphere() is given radius"),
        (lambda x: saltus.solid_sphere(x, 0.1), "solid_sphere() is given mass"),
        (
            lambda x: saltus.ModelBuilder().add_body("ball", saltus.Sphere(0.1), mass=x),
            "add_body() is given mass",
        ),
        (lambda x: saltus.Stepper(cradle(), h=x), "Stepper() is given h"),
        (lambda x: saltus.simulate(cradle(), duration=x), "simulate() is given duration"),
        (lambda x: saltus.simulate(cradle(), duration=1.0, h=x), "StepOptions() is given h"),
        (lambda x: cradle().state(t=x), "state() is given t"),
    ],
)
def test_truth_values_are_no_numbers(call, message, value):
    with pytest.raises(TypeError) as error:
        call(value)
    wrong = f"{message} = {value!r} ({type(value).__name__}), which is no number"
    assert str(error.value) in (wrong, f"{wrong} or None")


def test_truth_values_are_no_whole_numbers_and_no_lists_of_numbers():
    with pytest.raises(TypeError, match=r"max_impacts = True \(bool\), which is no whole number"):
        saltus.StepOptions(max_impacts=True)
    for wrong in (True, [True], np.array([True])):
        with pytest.raises(saltus.ModelError, match="restitution is one number or one for each"):
            saltus.resolve_impact([[1.0]], [[1.0]], [-1.0], restitution=wrong)


def test_truth_values_are_taken_where_they_are_meant():
    for collisions in (False, np.False_):
        assert not saltus.Stepper(cradle(), collisions=collisions).options.collisions
    builder = saltus.ModelBuilder().add(cradle(), "a_", own_materials=True)
    assert builder.build().n_q == cradle().n_q


def test_errors_of_functions_that_are_called_from_inside_stay():
    def law(_: saltus.ImpactProblem):
        raise TypeError("f(): incompatible function arguments. The following are mine")

    with pytest.raises(TypeError, match="The following are mine"):
        saltus.simulate(bouncing_ball().build(), duration=1.0, law=law)
