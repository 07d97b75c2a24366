"""Shapes, gaps and impacts at one instant."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scenes import line

import saltus
from saltus import Box, Capsule, Cylinder, HalfSpace, ImpactOrder, Pose, Sphere

SHAPES = [Sphere(0.1), Capsule(0.1, 0.2), Box((0.1, 0.2, 0.3)), Cylinder(0.1, 0.2), HalfSpace()]


def test_shapes_say_what_they_are():
    assert [repr(shape) for shape in SHAPES] == [
        "Sphere(0.1)",
        "Capsule(0.1, 0.2)",
        "Box((0.1, 0.2, 0.3))",
        "Cylinder(0.1, 0.2)",
        "HalfSpace()",
    ]
    assert [saltus.shape_name(shape) for shape in SHAPES] == [
        "sphere", "capsule", "box", "cylinder", "half_space"
    ]  # fmt: skip


def test_gap_of_two_spheres():
    gap = saltus.gap(Sphere(0.1), Pose((1, 0, 0)), Sphere(0.2), Pose((0, 0, 0)))
    assert gap.phi == pytest.approx(0.7)
    np.testing.assert_allclose(gap.n_W, [1, 0, 0])
    np.testing.assert_allclose(gap.p_WA, [0.9, 0, 0])
    np.testing.assert_allclose(gap.p_WB, [0.2, 0, 0])
    assert gap.F_W.shape == (3, 3)


def test_table_of_pairs_is_true():
    table = {frozenset(row) for row in saltus.gap_table()}
    apart = Pose((5, 0, 5))
    for a in SHAPES:
        for b in SHAPES:
            known = frozenset([saltus.shape_name(a), saltus.shape_name(b)]) in table
            assert saltus.has_gap(a, b) is known
            if known:
                assert math.isfinite(saltus.gap(a, apart, b, Pose()).phi)
            else:
                with pytest.raises(saltus.ModelError, match="no gap function between a"):
                    saltus.gap(a, apart, b, Pose())


def test_newtons_cradle_at_one_instant():
    outcome = saltus.resolve_impact(np.eye(3), line(3), [1, 0, 0])
    np.testing.assert_allclose(outcome.v, [0, 0, 1], atol=1e-15)
    assert list(outcome.impulses["pair"]) == [0, 1]
    np.testing.assert_allclose(outcome.impulses["lambda"], [1, 1])
    assert "2 impulses" in repr(outcome)


ONE_AFTER_THE_OTHER = [ImpactOrder.fastest, ImpactOrder.index]


@given(st.lists(st.floats(-10, 10), min_size=2, max_size=7), st.sampled_from(ONE_AFTER_THE_OTHER))
def test_equal_balls_sort_their_velocities(v, order):
    outcome = saltus.resolve_impact(np.eye(len(v)), line(len(v)), v, order=order)
    # neighbours that close by less than 1e-13 |v| sqrt(2) rest on each other, up to 6 in a row
    # (norm() squares: of 1e-311 it is 0; denormal numbers have few digits)
    atol = 6 * 1.5e-13 * math.hypot(*v) + np.finfo(float).tiny
    np.testing.assert_allclose(outcome.v, sorted(v), rtol=0, atol=atol)


def test_restitution():
    outcome = saltus.resolve_impact(np.eye(3), line(3), [1, 0, -1], restitution=0.5)
    # three impulses whatever the order of the first two
    assert len(outcome.impulses) == 3
    assert np.all(np.diff(outcome.v) >= 0)
    assert sum(outcome.v) == pytest.approx(0, abs=1e-15)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((np.eye(2), line(3), [1, 0, 0]), "M is (2, 2)"),
        ((np.eye(3), line(2), [1, 0, 0]), "N is (1, 2)"),
        ((np.eye(3), line(3), [np.nan, 0, 0]), "not finite"),
        ((-np.eye(3), line(3), [1, 0, 0]), "positive definite"),
    ],
)
def test_problems_that_are_none(arguments, message):
    with pytest.raises(saltus.ModelError) as error:
        saltus.resolve_impact(*arguments)
    assert message in str(error.value)


def test_restitution_out_of_range():
    with pytest.raises(saltus.ModelError, match=r"1\.5"):
        saltus.resolve_impact(np.eye(3), line(3), [1, 0, 0], restitution=1.5)
    with pytest.raises(TypeError):
        saltus.resolve_impact(np.eye(3), line(3), [1, 0, 0], 0.5)  # keyword-only


def test_a_jammed_ball_is_told():
    walls = np.array([[1.0], [-1.0]])
    with pytest.raises(saltus.JammedError) as error:
        saltus.resolve_impact(np.eye(1), walls, [1.0], max_impulses=50)
    assert isinstance(error.value, saltus.StepError)
    assert error.value.iterations == 50


def test_a_pose_that_is_not_finite_is_named():
    ball, nowhere = saltus.Sphere(1.0), saltus.Pose((0.0, np.nan, 0.0))
    with pytest.raises(saltus.ModelError, match="X_WA is not finite"):
        saltus.gap(ball, nowhere, ball, saltus.Pose())
    with pytest.raises(saltus.ModelError, match="X_WB is not finite"):
        saltus.gap(ball, saltus.Pose(), ball, nowhere)
