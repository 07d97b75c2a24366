"""Shooting: against closed forms, through impacts, with other solvers, and what goes wrong."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.python.driven_models import acrobot, bouncer, cart, spinner
from tests.python.helpers import hide_scipy

import saltus
from saltus import ModelError, optimize
from saltus.optimize.reach import Shooting, to_unknowns
from saltus.optimize.system import System

H, STEPS = 0.02, 25


def test_the_speed_of_a_throw_has_a_closed_form():
    # down to the floor 0.2 m below, up with e of the speed: z = -0.2 + e w s - g s^2 / 2
    model, e, g, T = bouncer(), 0.8, 9.81, STEPS * H
    shot = optimize.shoot(
        model, model.state(v=[-2.0]), STEPS, optimize.Reach(model, {"ball": 0.2}), h=H, by_v=[1.0]
    )
    assert shot.converged
    v = -model.velocity(shot.start)[0]
    w = math.sqrt(v**2 + 2 * g * 0.2)
    s = T - (w - v) / g
    # the midpoint rule has parabolas exactly
    assert -0.2 + e * w * s - g * s**2 / 2 == pytest.approx(0.2, abs=1e-11)
    assert np.abs(shot.run().q[-1] - 0.2).max() < 1e-11


@pytest.mark.parametrize("make", [acrobot, bouncer, spinner])
def test_jacobian_by_all_unknowns_against_differences(make):
    model, rng, N = make(), np.random.default_rng(3), 10
    n, m = model.n_v, 3
    shapes = (n, m), (n, m), (N, model.n_u, m)
    unknowns = to_unknowns(model, N, *(rng.normal(size=shape) for shape in shapes))

    def miss(q, v):  # curved in both
        return [np.sum(v**2), v[-1]], np.stack([np.r_[np.zeros(n), 2 * v], np.eye(2 * n)[-1]])

    start = model.state(v=rng.normal(size=n))
    problem = Shooting(System(model, H, {}), start, rng.normal(size=(N, model.n_u)), unknowns, miss)
    J = problem.jacobian(problem.path(np.zeros(m)))[0]
    e = 1e-5 * np.eye(m)
    by = [problem.misses(problem.path(d))[0] - problem.misses(problem.path(-d))[0] for d in e]
    assert np.allclose(J, np.array(by).T / 2e-5, atol=1e-7 * np.abs(J).max())


def test_of_many_controls_it_takes_the_shortest_step():
    model = cart()
    goal = optimize.Reach(model, {"cart": 1.0}, {"cart": 0.0})
    shot = optimize.shoot(model, model.state(), 20, goal, h=0.1)
    assert len(shot.misses) == 2  # it is linear
    m, h, N = 2.0, 0.1, 20
    rows = np.array([[h * h / m * (N - k - 0.5) for k in range(N)], [h / m] * N])
    assert np.allclose(shot.control[:, 0], np.linalg.pinv(rows) @ [1.0, 0.0], atol=1e-12)


def test_scipy_finds_it_too_and_keeps_bounds():
    model, goal = bouncer(), optimize.Reach(bouncer(), {"ball": 0.2})
    start, way = model.state(v=[-2.0]), {"h": H, "by_v": [1.0]}
    newton = optimize.shoot(model, start, STEPS, goal, **way)
    scipy = optimize.shoot(model, start, STEPS, goal, method="least_squares", **way)
    assert scipy.message == "converged"
    assert scipy.x == pytest.approx(newton.x, abs=1e-10)
    bounds = (-0.1, 0.1)
    near = optimize.shoot(model, start, STEPS, goal, method="least_squares", bounds=bounds, **way)
    assert not near.converged
    assert abs(near.x[0]) == pytest.approx(0.1, abs=1e-6)
    with pytest.raises(ModelError, match="bounds are for"):
        optimize.shoot(model, start, STEPS, goal, bounds=bounds, **way)


def test_without_scipy_the_error_says_what_to_do(monkeypatch):
    hide_scipy(monkeypatch)
    model = cart()
    goal = optimize.Reach(model, {"cart": 1.0})
    with pytest.raises(ImportError, match="pip install scipy"):
        optimize.shoot(model, model.state(), 5, goal, method="least_squares")


def test_shoot_says_what_is_wrong():
    model = bouncer()
    goal, start = optimize.Reach(model, {"ball": 0.2}), model.state()
    with pytest.raises(ModelError, match="there is nothing to reach"):
        optimize.Reach(model)
    with pytest.raises(ModelError, match="bal"):
        optimize.Reach(model, {"bal": 1.0})
    with pytest.raises(ModelError, match="part of a quaternion"):
        optimize.Reach(spinner(), {"ball_qx": 1.0})
    with pytest.raises(ModelError, match=r"by_v has shape \(2,\); it is \(1, 'm'\)"):
        optimize.shoot(model, start, 5, goal, by_v=[1.0, 2.0])
    with pytest.raises(ModelError, match="it differs"):
        optimize.shoot(model, start, 5, goal, by_v=[1.0], by_q=[[1.0, 2.0]])
    with pytest.raises(ModelError, match=r'method is "?\'bfgs\''):
        optimize.shoot(model, start, 5, goal, method="bfgs")
    with pytest.raises(ModelError, match="controls is 0"):
        optimize.shoot(model, start, 0, goal)
    with pytest.raises(ModelError, match="miss returned 1 misses with derivatives of shape"):
        optimize.shoot(model, start, 5, lambda q, v: (q, [1.0]))


def test_a_motion_that_hits_nothing_has_no_derivative_by_what_it_would_hit():
    builder = saltus.ModelBuilder().set_gravity((0, 0, 0))
    for name, x in (("cue", 0.0), ("struck", 0.5)):
        X = saltus.Pose((x, 0, 0))
        builder.add_body(name, saltus.Sphere(0.1), mass=1.0, X=X, joint="prismatic")
    model = builder.build()
    goal, by = optimize.Reach(model, v={"struck": 1.0}), [[1.0], [0.0]]
    with pytest.raises(ModelError, match="start from one that does"):
        optimize.shoot(model, model.state(), 10, goal, h=0.1, by_v=by)
    shot = optimize.shoot(model, model.state(v={"cue": 0.5}), 10, goal, h=0.1, by_v=by)
    assert shot.x == pytest.approx([0.5], abs=1e-12)
