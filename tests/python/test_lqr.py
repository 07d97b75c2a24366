"""Linear-quadratic feedback: against Riccati's equation and the cost that is spent."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.linalg import solve_discrete_are
from tests.python.driven_models import acrobot, cart

import saltus
from saltus import BodyInertia, ModelBuilder, ModelError, optimize


def test_lqr_of_a_cart_is_the_solution_of_riccatis_equation():
    model, h = cart(), 0.1
    rule = optimize.lqr(model, model.state(), q=3.0, v=0.5, control=0.2, h=h)
    m = 2.0  # q+ = q + h p/m + h^2 u / 2m, p+ = p + h u
    A, B = np.array([[1, h / m], [0, 1]]), np.array([[h * h / (2 * m)], [h]])
    P = solve_discrete_are(A, B, np.diag([3.0, 0.5 / m**2]), [[0.2]])
    assert np.allclose(rule.to_go, P, rtol=1e-11)
    K = -np.linalg.solve(0.2 + B.T @ P @ B, B.T @ P @ A)
    assert np.allclose(rule.gain, K, rtol=1e-11)
    assert np.allclose(rule.multipliers, np.linalg.eigvals(A + B @ K))


def test_lqr_keeps_an_acrobot_up():
    model = acrobot()
    up = model.state({"shoulder": math.pi})
    rule = optimize.lqr(model, up, q=1.0, v=1.0, control=1.0, h=0.01)
    run = saltus.simulate(
        model, {"shoulder": math.pi + 0.03}, duration=15.0, control=rule, progress=False
    )
    assert np.abs(model.difference(up.q, run.q[-1])).max() < 1e-6
    # the sum of costs is the cost to go, near the target: 1e-4 of it is of higher order
    near = model.state({"shoulder": math.pi + 1e-4})
    run = saltus.simulate(model, state=near, duration=15.0, control=rule, progress=False)
    dq = np.array([model.difference(up.q, q) for q in run.q[:-1]])
    spent = 0.5 * float((dq**2).sum() + (run.v[:-1] ** 2).sum() + (run.control[:-1] ** 2).sum())
    dx = np.concatenate([model.difference(up.q, near.q), near.p])
    assert spent == pytest.approx(0.5 * dx @ rule.to_go @ dx, rel=1e-3)


def test_lqr_says_what_is_wrong():
    model = acrobot()
    up = model.state({"shoulder": math.pi})
    with pytest.raises(ModelError, match="no equilibrium: a step moves p of shoulder"):
        optimize.lqr(model, model.state({"shoulder": 1.0}))
    with pytest.raises(ModelError, match="control is not positive definite"):
        optimize.lqr(model, up, control=0.0)
    with pytest.raises(ModelError, match=r"hold has shape \(2,\); it is \(1,\): motor"):
        optimize.lqr(model, up, hold=[1.0, 2.0])
    with pytest.raises(ModelError, match="q has shape"):
        optimize.lqr(model, up, q=[1.0, 2.0, 3.0])
    with pytest.raises(ModelError, match="its least eigenvalue is -1"):
        optimize.lqr(model, up, q=[1.0, -1.0])
    with pytest.raises(ModelError, match="no actuators"):
        optimize.lqr(bare := ModelBuilder().build(), bare.state())


def test_lqr_refuses_what_no_control_reaches():
    builder = acrobot().builder()
    builder.add_link("beside", BodyInertia(1.0, (0, 0, 1), np.eye(3) / 12))
    builder.add_joint("hinge", "revolute", parent="world", child="beside", axis=(0, 1, 0))
    model = builder.build()
    with pytest.raises(ModelError, match="not reached"):
        optimize.lqr(model, model.state({"shoulder": math.pi}))
