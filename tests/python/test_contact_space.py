"""Impacts of any mass matrix and normals: orders, certificates, all outcomes, from Python."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scenes import line
from scipy.optimize import linprog

import saltus
from saltus import ImpactKind, ImpactOrder

C = math.sqrt(3) / 2
BERNOULLI = np.array([[-C, 0.5, C, -0.5, 0, 0], [-C, -0.5, 0, 0, C, 0.5]])
CUE = [2, 0, 0, 0, 0, 0]


def wedge(theta: float) -> np.ndarray:
    return np.array([[1, 0], [-math.cos(theta), math.sin(theta)]])


def rack(rows: int = 5) -> tuple[np.ndarray, list[int]]:
    """Return the normals of a cue and a triangle of discs, and which ball mirrors which."""
    centres, mirror = [(-1.0, 0.0)], [0]
    for row in range(rows):
        first = len(centres)
        centres += [(row * C, i - row / 2) for i in range(row + 1)]
        mirror += [first + row - i for i in range(row + 1)]
    normals = []
    for (i, a), (j, b) in itertools.combinations(enumerate(np.array(centres)), 2):
        if np.linalg.norm(b - a) < 1 + 1e-9:
            normal = np.zeros((len(centres), 2))
            normal[i], normal[j] = a - b, b - a
            normals.append(normal.ravel())
    return np.array(normals), mirror


def test_generalized_reflections():
    out = saltus.resolve_impact(np.eye(3), line(3), [2, 1.5, -1], order=ImpactOrder.symmetric)
    np.testing.assert_allclose(out.v, [-1 / 3, 1 / 6, 8 / 3], atol=1e-15)
    assert list(out.impulses["pair"]) == [0, 1]
    out = saltus.resolve_impact(np.eye(6), BERNOULLI, CUE, order=ImpactOrder.symmetric)
    y = 1.2 / math.sqrt(3)
    np.testing.assert_allclose(out.v, [-0.4, 0, 1.2, -y, 1.2, y], atol=1e-15)


@pytest.mark.parametrize("e", [1.0, 0.8, 0.0])
def test_a_billiard_break_keeps_its_mirror(e):
    N, mirror = rack()
    assert len(N) == 31
    v = np.zeros(32)
    v[0] = 1.0
    out = saltus.resolve_impact(np.eye(32), N, v, restitution=e, order=ImpactOrder.symmetric)
    balls = out.v.reshape(-1, 2)
    np.testing.assert_allclose(balls, balls[mirror] * [1, -1], atol=1e-12)
    assert np.min(N @ out.v) > -1e-12


def test_restitution_of_each_contact():
    out = saltus.resolve_impact(np.eye(3), line(3), [1, 0, -1], restitution=[0, 1])
    np.testing.assert_allclose(out.v, [-0.25, -0.25, 0.5], atol=1e-15)
    with pytest.raises(saltus.ModelError, match="3 entries; N has 2 rows"):
        saltus.resolve_impact(np.eye(3), line(3), [1, 0, -1], restitution=[0, 1, 1])
    with pytest.raises(saltus.ModelError, match="one number or one for each contact, not 'much'"):
        saltus.resolve_impact(np.eye(3), line(3), [1, 0, -1], restitution="much")


@pytest.mark.parametrize("order", ImpactOrder)
def test_plastic_impacts_are_a_projection(order):
    out = saltus.resolve_impact(np.eye(3), line(3), [1, 0, 0], restitution=0, order=order)
    np.testing.assert_allclose(out.v, [1 / 3, 1 / 3, 1 / 3], atol=1e-15)


def test_certificates():
    cradle = saltus.classify_impact(np.eye(5), line(5))
    assert repr(cradle) == "<ImpactCertificate: unique, A4, at most 10 impulses>"
    assert cradle.kind is ImpactKind.unique
    np.testing.assert_allclose(cradle.angles[0, :3], [np.pi, np.pi / 3, np.pi / 2])
    galperin = saltus.classify_impact(np.diag([1.0, 100.0]), [[1, 0], [-1, 1]])
    assert repr(galperin) == "<ImpactCertificate: order_dependent, at most 32 impulses>"
    walls = saltus.classify_impact([[1.0]], [[1.0], [-1.0]])
    assert repr(walls) == "<ImpactCertificate: jammed>"
    assert walls.interior == 0
    assert walls.impulses is None
    assert repr(saltus.classify_impact([[1.0]], [[1.0]])).endswith("A1, at most 1 impulse>")
    assert saltus.classify_impact(np.eye(3), line(3), restitution=0).type == "plastic"
    assert saltus.classify_impact(np.eye(2), [[1, 0], [3, 0], [0, 1]]).same == [0, 0, 2]
    with pytest.raises(saltus.ModelError, match="tolerance 2"):
        saltus.classify_impact(np.eye(2), line(2), tolerance=2)


@given(st.integers(2, 40))
def test_wedges_that_are_part_of_a_half_turn(m):
    assert saltus.classify_impact(np.eye(2), wedge(math.pi / m)).impulses == m
    found = saltus.classify_impact(np.eye(2), wedge(math.pi / (m + 0.5)))
    assert (found.kind, found.impulses) == (ImpactKind.order_dependent, m + 1)


def test_outcomes_of_bernoullis_problem():
    every = saltus.impact_outcomes(np.eye(6), BERNOULLI, CUE)
    first, second = (out.v.reshape(3, 2) for out in every.outcomes)
    np.testing.assert_allclose(first[0], [-0.25, math.sqrt(3) / 4], atol=1e-15)
    np.testing.assert_allclose(second, first[[0, 2, 1]] * [1, -1], atol=1e-15)
    assert every.spread == pytest.approx(np.linalg.norm(first - second))
    assert every.relative_spread == pytest.approx(every.spread / 2)
    assert repr(every).startswith("<ImpactOutcomes: 2 outcomes, spread ")


def test_outcomes_of_equal_balls():
    every = saltus.impact_outcomes(np.eye(6), line(6), np.linspace(1, 0, 6))
    assert repr(every) == "<ImpactOutcomes: 1 outcome, 720 velocities met>"
    assert len(every.outcomes[0].impulses) == 15
    with pytest.raises(saltus.ModelError, match="max_states = 100 velocities: raise max_states"):
        saltus.impact_outcomes(np.eye(6), line(6), np.linspace(1, 0, 6), max_states=100)
    with pytest.raises(saltus.JammedError, match="leads back, by 2 impulses"):
        saltus.impact_outcomes([[1.0]], [[1.0], [-1.0]], [1.0])


@settings(deadline=None)
@given(st.integers(0, 10**6), st.integers(2, 6), st.integers(2, 8))
def test_the_cone_is_open_where_a_linear_programme_says_so(seed, n, m):
    random = np.random.default_rng(seed)
    M = np.diag(10.0 ** random.uniform(-1, 1, n))
    N = random.normal(size=(m, n))
    interior = saltus.classify_impact(M, N).interior
    rows = N / np.sqrt(np.diag(N @ np.linalg.inv(M) @ N.T))[:, None]
    # max d: rows w >= d, |w| <= 1
    constraints = np.hstack([-rows, np.ones((m, 1))])
    bounds = [(-1, 1)] * n + [(None, None)]
    best = -linprog([0] * n + [-1], constraints, np.zeros(m), bounds=bounds).fun
    assert (interior > 0) == (best > 1e-9)


@settings(deadline=None)
@given(st.integers(0, 10**6))
def test_an_impact_is_unique_for_all_velocities_or_not_certified(seed):
    random = np.random.default_rng(seed)
    M = np.diag(random.choice([0.5, 1.0, 2.0], size=3))
    certificate = saltus.classify_impact(M, line(3))
    counts = set()
    for _ in range(30):
        v = np.cumsum(-random.uniform(size=3))  # all approach
        every = saltus.impact_outcomes(M, line(3), v)
        counts.add(len(every.outcomes))
        assert all(len(out.impulses) <= certificate.impulses for out in every.outcomes)
    assert (counts == {1}) == (certificate.kind is ImpactKind.unique)


@pytest.mark.parametrize(("mass", "normal"), [(1, 1e160), (1e-308, 1), (1, 1e308)])
def test_numbers_beyond_double_precision_are_an_error(mass, normal):
    """G = N M^-1 N^T overflows where N and M themselves are finite."""
    M, N = mass * np.eye(2), normal * np.eye(2)
    for ask in (
        lambda: saltus.resolve_impact(M, N, [-1.0, -1.0]),
        lambda: saltus.classify_impact(M, N),
    ):
        with pytest.raises(saltus.ModelError, match="inverse mass"):
            ask()
