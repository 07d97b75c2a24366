"""What optimisers are made of: a box QP, differences of turns, expansions of costs and steps."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import lsq_linear
from tests.python.driven_models import acrobot, bouncer, spinner

from saltus import optimize
from saltus.optimize.costs import expand, total
from saltus.optimize.curvature import Curvature
from saltus.optimize.riccati import box_qp
from saltus.optimize.system import System, difference_slopes


def test_box_qp_against_another_solver():
    rng = np.random.default_rng(0)
    for _ in range(50):
        n = int(rng.integers(1, 6))
        R, g = rng.normal(size=(n + 2, n)), rng.normal(size=n)
        low, high = -rng.uniform(0, 0.5, n), rng.uniform(0, 0.5, n)
        found = box_qp(R.T @ R, g, low, high)
        assert found is not None
        b = -np.linalg.lstsq(R.T, g, rcond=None)[0]
        other = lsq_linear(R, b, bounds=(low, high + 1e-300), tol=1e-14, method="bvls")
        assert np.allclose(found[0], other.x, atol=1e-9)
    assert box_qp(np.diag([1.0, -1.0]), np.ones(2), -np.ones(2), np.ones(2)) is None


def test_a_difference_of_turns_moves_as_its_slopes_say():
    model = spinner()
    system, rng = System(model, 0.01, {}), np.random.default_rng(1)
    for size in (1e-5, 0.3, 2.0):
        goal = model.integrate(model.neutral(), rng.normal(size=4))
        dq = rng.normal(size=4)
        dq *= size / np.linalg.norm(dq[:3])
        q = model.integrate(goal, dq)
        J = difference_slopes(system.balls, model.difference(goal, q))
        for i, eta in enumerate(1e-5 * np.eye(4)):
            ahead, behind = (model.integrate(q, s * eta) for s in (1, -1))
            by = (model.difference(goal, ahead) - model.difference(goal, behind)) / 2e-5
            assert np.allclose(J[:, i], by, atol=1e-9)  # 1e-10 by truncation


@pytest.mark.parametrize("make", [acrobot, bouncer, spinner])
def test_gradient_and_curvature_of_a_cost_against_differences(make):
    model, h = make(), 0.02
    system, rng = System(model, h, {}), np.random.default_rng(2)
    n, m = 2 * model.n_v, model.n_u
    goal = model.state(model.integrate(model.neutral(), 0.5 * rng.normal(size=model.n_v)))
    weights = {"q": 1.0, "v": 0.3, "control": 0.1, "final_q": 2.0, "final_v": 0.7}
    cost = optimize.Quadratic(model, goal, **weights)
    q = model.integrate(model.neutral(), 0.2 * np.abs(rng.normal(size=model.n_v)))
    start = model.state(q, rng.normal(size=model.n_v))
    path = system.roll(start, rng.normal(size=(1, m)))

    def value(z: np.ndarray) -> float:
        moved = system.roll(system.shift(start, z[:n]), path.control + z[n:])
        return total(system, cost, moved)

    terms, slopes = expand(system, cost, path), system.linearize(path)
    after = terms.x[1]
    gradient = np.concatenate(
        [terms.x[0] + slopes.A[0].T @ after, terms.u[0] + slopes.B[0].T @ after]
    )
    e = 1e-5 * np.eye(n + m)
    by = np.array([value(d) - value(-d) for d in e]) / 2e-5
    assert np.allclose(gradient, by, atol=1e-8 * max(1, np.abs(by).max()))
    # l + V_x . F plus F_x^T V_xx F_x is all of the second derivative
    bent = Curvature(system, cost, path)
    F = np.hstack([slopes.A[0], slopes.B[0]])
    H = bent(0, after) + F.T @ bent.of_the_end() @ F
    by = np.zeros_like(H)
    e = 1e-3 * np.eye(n + m)
    for i, a in enumerate(e):
        for j, b in enumerate(e):
            by[i, j] = value(a + b) - value(a - b) - value(b - a) + value(-a - b)
    by /= 4e-6
    assert np.allclose(H, by, atol=1e-4 * np.abs(by).max())  # 1e-6 by truncation, times the next
