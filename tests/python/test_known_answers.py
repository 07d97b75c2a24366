"""Impacts whose answer is known in closed form or by a count, from Python.

The C++ tests have the same (test_resolve_impact.cpp, test_symmetric.cpp, test_certificate.cpp,
test_restitution.cpp, test_cradle.cpp); here a script's way to each is pinned.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from scenes import beads, bouncing_ball, line

import saltus

URDF = Path(__file__).parents[2] / "urdf"
EXACT = 1e-14  # sums of a few numbers of size 1


def resolve(v, *, masses=None, **options):
    count = len(v)
    masses = np.ones(count) if masses is None else masses
    return saltus.resolve_impact(np.diag(masses), line(count), v, **options)


@pytest.mark.parametrize(
    ("v", "after", "impulses"),
    [
        ([1, 0, 0], [0, 0, 1], 2),
        ([1, 1, 0], [0, 1, 1], 2),
        ([1, 0, -1], [-1, 0, 1], 3),
        ([1, 0, 0, 0, 0], [0, 0, 0, 0, 1], 4),
        ([1, 1, 0, 0, 0], [0, 0, 0, 1, 1], 6),
        ([1, 1, 1, 0, 0], [0, 0, 1, 1, 1], 6),
    ],
)
def test_equal_balls_in_line(v, after, impulses):
    outcome = resolve(v)
    np.testing.assert_allclose(outcome.v, after, atol=EXACT)
    assert len(outcome.impulses) == impulses


@pytest.mark.parametrize("order", [saltus.ImpactOrder.fastest, saltus.ImpactOrder.index])
def test_any_velocities_come_out_sorted_by_as_many_impulses_as_there_are_inversions(order):
    v = np.random.default_rng(1).permutation(9) - 4.0
    outcome = resolve(v, order=order)
    np.testing.assert_allclose(outcome.v, np.sort(v), atol=EXACT * 9)
    inversions = sum(v[i] > v[j] for i in range(9) for j in range(i + 1, 9))
    assert len(outcome.impulses) == inversions


def test_laws_that_do_not_sort():
    v = np.array([1.0, 0, 0])
    plastic = resolve(v, restitution=0).v
    np.testing.assert_allclose(plastic, [1 / 3] * 3, atol=EXACT)
    # Moreau's: v+ = (1 + e) P(v) - e v, P the projection, here with e = 1
    np.testing.assert_allclose(2 * plastic - v, [-1 / 3, 2 / 3, 2 / 3], atol=EXACT)
    together = resolve([2, 1.5, -1], order=saltus.ImpactOrder.symmetric)
    np.testing.assert_allclose(together.v, [-1 / 3, 1 / 6, 8 / 3], atol=EXACT)


def test_moreaus_law_as_a_function():
    def moreau(problem):
        v = np.linalg.solve(problem.M, problem.p)
        plastic = saltus.resolve_impact(problem.M, problem.N, v, restitution=0).v
        return problem.M @ (2 * plastic - v)

    model = beads(3).build()
    state = saltus.Stepper(model, law=moreau).advance(model.state(v=[1, 0, 0]))
    np.testing.assert_allclose(state.p, [-1 / 3, 2 / 3, 2 / 3], atol=1e-12)


@pytest.mark.parametrize(
    ("m", "after", "impulses"),
    [
        (4, [-0.1715728753, 0.8284271247, 0.8284271247], 3),
        (5, [0, 0, 1], 4),
        (6, [-0.0717967697, 0.9282032303, 0.9282032303], 5),
    ],
)
def test_a_light_ball_in_the_middle(m, after, impulses):
    masses = np.array([1, 1 / math.cos(math.pi / m) - 1, 1])
    outcome = resolve([1, 0, 0], masses=masses)
    np.testing.assert_allclose(outcome.v, after, atol=1e-10)  # as many digits as are written
    assert len(outcome.impulses) == impulses
    certificate = saltus.classify_impact(np.diag(masses), line(3))
    assert certificate.kind is saltus.ImpactKind.unique
    assert certificate.impulses == m


@pytest.mark.parametrize(("k", "impulses"), list(enumerate([3, 31, 314, 3141, 31415])))
def test_galperins_billiard_counts_the_digits_of_pi(k, impulses):
    M, N = np.diag([100.0**k, 1]), [[-1, 1], [0, -1]]  # M comes in, then 1, then the wall
    outcome = saltus.resolve_impact(M, N, [1, 0])
    assert len(outcome.impulses) == impulses
    energy = outcome.v @ M @ outcome.v / 100.0**k
    assert energy == pytest.approx(1, abs=1e-12 + 2e-16 * impulses)  # each rounds


def gram(count, *bonds):
    """Return cosines of mirrors at pi/3 along a chain, where `bonds` (i, j, m) do not say pi/m."""
    G = np.eye(count)
    table = {(i, i + 1): 3 for i in range(count - 1)} | {(i, j): m for i, j, m in bonds}
    for (i, j), m in table.items():
        G[i, j] = G[j, i] = -math.cos(math.pi / m)
    return G


@pytest.mark.parametrize(
    ("name", "G", "impulses"),
    [
        ("A3", gram(3), 6),
        ("B3", gram(3, (1, 2, 4)), 9),
        ("A4", gram(4), 10),
        ("D4", gram(4, (2, 3, 2), (1, 3, 3)), 12),
        ("B4", gram(4, (2, 3, 4)), 16),
        ("F4", gram(4, (1, 2, 4)), 24),
    ],
)
def test_coxeter_groups_take_their_longest_element(name, G, impulses):
    N, M = np.linalg.cholesky(G), np.eye(len(G))
    certificate = saltus.classify_impact(M, N)
    assert (certificate.type, certificate.impulses) == (name, impulses)
    v = -np.linalg.solve(N, np.linspace(1, 2, len(G)))  # all gaps close
    for order in (saltus.ImpactOrder.fastest, saltus.ImpactOrder.index):
        assert len(saltus.resolve_impact(M, N, v, order=order).impulses) == impulses


def test_bernoullis_problem():
    a, b = math.sqrt(3) / 2, 0.5  # from the cue to two discs of the same size that touch
    N = [[-a, -b, a, b, 0, 0], [-a, b, 0, 0, a, -b]]
    v = [2, 0, 0, 0, 0, 0]
    outcomes = saltus.impact_outcomes(np.eye(6), N, v).outcomes
    cues = sorted((outcome.v[:2] for outcome in outcomes), key=lambda cue: cue[1])
    np.testing.assert_allclose(cues, [[-0.25, -0.433013], [-0.25, 0.433013]], atol=1e-6)
    together = saltus.resolve_impact(np.eye(6), N, v, order=saltus.ImpactOrder.symmetric)
    ball = [1.2, 0.692820]
    np.testing.assert_allclose(together.v, [-0.4, 0, *ball, ball[0], -ball[1]], atol=1e-6)


@pytest.mark.parametrize(
    ("e", "after"),
    [(0.5, [-0.359375, 0.046875, 0.3125]), (0.9, [-0.854875, 0.002375, 0.8525])],
)
def test_restitution(e, after):
    outcome = resolve([1, 0, -1], restitution=e, order=saltus.ImpactOrder.index)
    np.testing.assert_allclose(outcome.v, after, atol=EXACT)
    assert len(outcome.impulses) == 3


def test_infinitely_many_impulses_below_one_restitution():
    limit = 7 - 4 * math.sqrt(3)
    below = len(resolve([1, 0, -1], restitution=limit - 1e-3).impulses)  # until they are rounding
    above = len(resolve([1, 0, -1], restitution=limit + 1e-2).impulses)
    assert above <= 10 < below


def test_a_bouncing_ball_comes_to_rest():
    model = bouncing_ball(height=0.0).set_default_contact(restitution=0.5).build()
    run = saltus.simulate(model, q={"z": 1.0}, duration=1.5)
    assert run.settlings["t"][0] == pytest.approx(1.354571, abs=1e-6)


def test_a_billiard_in_a_circle_keeps_its_angular_momentum():
    q, v = np.array([0.3, 0.0]), np.array([0.4, 0.7])
    momentum = q[0] * v[1] - q[1] * v[0]
    for _ in range(1000):
        along, square = q @ v, v @ v
        q = q + v * (-along + math.sqrt(along**2 - square * (q @ q - 1))) / square
        v = saltus.resolve_impact(np.eye(2), [-q], v).v
        assert abs(q[0] * v[1] - q[1] * v[0]) == pytest.approx(momentum, abs=1e-12)


@pytest.mark.parametrize(("count", "up"), [(3, 1), (5, 2)])
def test_a_touching_cradle(count, up):
    model = saltus.load_urdf(URDF / f"newtons_cradle_{count}.urdf")
    lifted = {f"swing_{i}": 0.3 for i in range(up)}
    run = saltus.simulate(model, q=lifted, duration=20.0, h=0.01, progress=False)
    assert run.impacts["t"][0] == pytest.approx(0.504604, abs=1e-4)  # order 2 in h
    flies = (run.t > run.impacts["t"][0]) & (run.t < run.impacts["t"][1])
    names = model.coordinate_names
    still = [names.index(f"swing_{i}") for i in range(count - up)]
    assert np.abs(run.q[flies][:, still]).max() < 1e-12
    last = run.q[flies][:, names.index(f"swing_{count - 1}")]
    assert np.abs(last).max() == pytest.approx(0.3, abs=1e-3)
