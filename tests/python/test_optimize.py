"""Optimal control on exact derivatives: against closed forms, differences and other ways."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import minimize
from tests.python.driven_models import acrobot, bouncer, cart, puck, spinner
from tests.python.helpers import interrupting

import saltus
from saltus import ModelError, optimize
from saltus.optimize.costs import total
from saltus.optimize.system import System


def test_a_linear_problem_takes_one_iteration():
    model, h, N = cart(), 0.1, 20
    start, goal = model.state(q=[1.0]), model.state()
    cost = optimize.Quadratic(model, goal, q=1.0, control=0.1, final_q=5.0, final_v=5.0)
    plan = optimize.ilqr(model, start, cost, np.zeros((N, 1)), h=h)
    assert plan.converged
    assert len(plan.costs) == 2
    system = System(model, h, {})
    other = minimize(
        lambda u: total(system, cost, system.roll(start, u[:, None])), np.zeros(N), tol=1e-12
    )
    assert plan.cost == pytest.approx(other.fun, rel=1e-9)


def test_bounds_hold_and_the_rest_is_at_its_best():
    model, h, N = cart(effort=2.0), 0.1, 20
    start, goal = model.state(q=[1.0]), model.state()
    cost = optimize.Quadratic(model, goal, control=0.1, final_q=50.0, final_v=50.0)
    plan = optimize.ilqr(model, start, cost, np.zeros((N, 1)), h=h)
    assert plan.converged
    u = plan.control[:, 0]
    assert np.all(np.abs(u) <= 2.0)
    assert 2 <= np.sum(np.abs(u) == 2.0) < N
    assert np.all(plan.gain[np.abs(u) == 2.0] == 0)
    system = System(model, h, {})
    other = minimize(
        lambda u: total(system, cost, system.roll(start, u[:, None])),
        np.zeros(N),
        bounds=[(-2.0, 2.0)] * N,
        method="L-BFGS-B",
        options={"ftol": 1e-15, "gtol": 1e-9},
    )
    assert plan.cost == pytest.approx(other.fun, rel=1e-7)
    narrow = optimize.ilqr(model, start, cost, np.zeros((N, 1)), h=h, bounds=(-0.5, 0.25))
    assert narrow.control.min() == -0.5
    assert narrow.control.max() == 0.25


def test_newton_converges_quadratically_where_gauss_and_newton_do_linearly():
    model = acrobot()
    start, goal = model.state(), model.state({"shoulder": 1.0})
    cost = optimize.Quadratic(model, goal, control=0.1, final_q=10.0, final_v=10.0)
    found = {}
    for second_order in (False, True):
        found[second_order] = optimize.ilqr(
            model,
            start,
            cost,
            np.zeros((40, 1)),
            h=0.03,
            tolerance=1e-13,
            second_order=second_order,
        )
    gauss, newton = found[False], found[True]
    assert newton.converged
    assert newton.cost == pytest.approx(gauss.cost, rel=1e-9)
    a, b, c = newton.decrements[-3:]
    # a decrement d is as the square of the distance: quadratic is d+ ~ d^2, ratio b/a squares
    assert c / b < (b / a) ** 1.5
    assert len(newton.costs) < len(gauss.costs)


def test_ilqr_moves_an_impact():
    # Thrown down at the floor, the ball is to be at 0.25 m, at rest, after one bounce.
    model, h, N = bouncer(), 0.02, 25
    start = model.state(v=[-2.0])
    goal = model.state(q=[0.25])
    cost = optimize.Quadratic(model, goal, control=1e-3, final_q=1e3, final_v=1e3)
    plan = optimize.ilqr(model, start, cost, np.full((N, 1), 5.0), h=h)
    assert plan.converged
    assert sum(plan.impacts.values()) == 1
    assert abs(plan.q[-1, 0] - 0.25) < 1e-3
    system = System(model, h, {})
    best = total(system, cost, system.roll(start, plan.control))
    for k in range(N):  # no control can be better by itself
        for e in (1e-3, -1e-3):
            u = plan.control.copy()
            u[k] += e
            assert total(system, cost, system.roll(start, u)) > best - 1e-12
    # the run that simulate makes of it
    run = plan.run()
    assert np.abs(run.q - plan.q).max() < 1e-10
    # feedback mends another start, also while its impact is earlier or later than the plan's
    near = model.state(q=[0.02], v=[-2.0])
    bare = saltus.simulate(
        model, state=near, duration=N * h, h=h, control=plan.control, progress=False
    )
    held = plan.run(near)
    assert abs(held.q[-1, 0] - 0.25) < 0.2 * abs(bare.q[-1, 0] - 0.25)
    kept = optimize.lqr_along(run, q=10.0, v=1.0, control=1e-3, final_q=1e3, final_v=1e3)
    held = saltus.simulate(model, state=near, duration=N * h, h=h, control=kept, progress=False)
    assert abs(held.q[-1, 0] - 0.25) < 0.2 * abs(bare.q[-1, 0] - 0.25)


def test_feedback_is_left_out_where_impacts_differ():
    model, h, N = bouncer(), 0.02, 25
    start = model.state(v=[-2.0])
    cost = optimize.Quadratic(model, model.state(q=[0.25]), control=1e-3, final_q=1e3)
    policy = optimize.ilqr(model, start, cost, np.full((N, 1), 5.0), h=h).policy
    k = next(k for k in range(N) if policy.path.impacts[k])
    other = System(model, h, {}).shift(policy.path.states[k], np.array([0.01, 0.0]))
    assert policy.at(k, other, {}) == policy.path.control[k]
    moved = policy.at(k, other, policy.path.impacts[k]) - policy.path.control[k]
    assert moved == pytest.approx(policy.gain[k, :, 0] * 0.01)


def test_ilqr_turns_a_ball_joint():
    model = spinner()
    goal = model.state(model.integrate(model.neutral(), [0.0, 0.4, 0.0, -0.5]))
    cost = optimize.Quadratic(model, goal, control=0.01, final_q=100.0, final_v=1.0)
    plan = optimize.ilqr(model, model.state(), cost, np.zeros((50, 1)), h=0.02)
    assert plan.converged
    assert np.abs(model.difference(goal.q, plan.q[-1])).max() < 0.05


def test_residuals_are_a_cost_too():
    model, N = acrobot(), 30
    goal = model.state({"shoulder": 0.5})
    weighted = optimize.Quadratic(model, goal, control=0.1, final_q=10.0, final_v=10.0)

    def effort(k, q, v, u):
        return math.sqrt(0.1) * u, math.sqrt(0.1) * np.eye(1, 5, 4)

    def miss(q, v):
        return math.sqrt(10) * np.concatenate([q - goal.q, v]), math.sqrt(10) * np.eye(4)

    plans = [
        optimize.ilqr(model, model.state(), cost, np.zeros((N, 1)), h=0.03)
        for cost in (weighted, optimize.Residuals(effort, miss))
    ]
    assert plans[0].cost == pytest.approx(plans[1].cost, rel=1e-9)
    bad = optimize.Residuals(effort, lambda q, v: (v, np.eye(4)))
    with pytest.raises(ModelError, match=r"residuals of the last state are 2 with derivatives of"):
        optimize.ilqr(model, model.state(), bad, np.zeros((N, 1)), h=0.03)


def test_ctrl_c_keeps_the_best_so_far(capsys):
    model = acrobot()
    cost = optimize.Quadratic(model, model.state({"shoulder": 1.0}), control=0.1, final_q=10.0)
    parts = []
    stop = interrupting(parts, at=2)

    plan = optimize.ilqr(
        model, model.state(), cost, np.zeros((40, 1)), h=0.03, iterations=50, progress=stop
    )
    assert parts == [1 / 50, 2 / 50]
    assert not plan.converged
    assert plan.message == "stopped after 2 iterations"
    assert plan.cost == min(plan.costs) < plan.costs[0]
    assert "best so far" in capsys.readouterr().err


def test_ilqr_says_what_is_wrong():
    model = acrobot()
    cost = optimize.Quadratic(model, model.state(), control=1.0)
    start, zeros = model.state(), np.zeros((5, 1))
    with pytest.raises(ModelError, match=r"controls have shape \(5, 2\); they are \(steps, n_u\)"):
        optimize.ilqr(model, start, cost, np.zeros((5, 2)))
    with pytest.raises(ModelError, match="controls of step 3 are not finite"):
        optimize.ilqr(model, start, cost, [0, 0, 0, math.nan, 0])
    with pytest.raises(ModelError, match="bounds of motor: the least, 1, is above the greatest, 0"):
        optimize.ilqr(model, start, cost, zeros, bounds=(1, 0))
    with pytest.raises(ModelError, match="iterations is 0"):
        optimize.ilqr(model, start, cost, zeros, iterations=0)
    with pytest.raises(TypeError, match="start is a list"):
        optimize.ilqr(model, [0, 0], cost, zeros)
    with pytest.raises(TypeError, match="model is a str"):
        optimize.ilqr("acrobot", start, cost, zeros)
    short = optimize.ilqr(
        model,
        model.state({"shoulder": 1.0}),
        optimize.Quadratic(model, model.state(), q=1.0, control=0.1),
        np.zeros((20, 1)),
        iterations=1,
    )
    assert short.message == "1 iterations were not enough"


def test_costs_that_are_none():
    model, zeros = acrobot(), np.zeros((5, 1))
    start = model.state()
    with pytest.raises(TypeError, match="cost is a NoneType; it is a Quadratic, Residuals"):
        optimize.ilqr(model, start, None, zeros)
    with pytest.raises(ModelError, match="2 targets for 5 steps"):
        optimize.ilqr(model, start, optimize.Quadratic(model, [start, start]), zeros)
    cost = optimize.Quadratic(model, start, control_target=np.zeros((3, 1)))
    with pytest.raises(ModelError, match=r"control_target has shape \(3, 1\)"):
        optimize.ilqr(model, start, cost, zeros)
    nothing = optimize.ilqr(model, start, optimize.Quadratic(model, start), zeros)
    assert nothing.converged


@pytest.mark.parametrize("size", [0.0, 1e-13, 1e-7, 0.1])
def test_a_cost_of_no_effort(size):
    """A pendulum is to swing up, by whatever torque: one number to reach by twenty controls.

    The last control reaches it alone, and what is left for the others to gain is rounding. An
    acrobot, which has less control than coordinates, would take some 10 000 N m in its last steps,
    and where its search goes from there follows the last bit of the guess.
    """
    builder = saltus.ModelBuilder()
    builder.add_link("rod", saltus.BodyInertia(1.0, (0, 0, -0.5), 0.02 * np.eye(3)))
    builder.add_joint("pivot", "revolute", parent="world", child="rod", axis=(0, 1, 0))
    model = builder.add_motor("drive", joint="pivot").build()
    free = optimize.Quadratic(model, model.state({"pivot": 1.0}), final_q=1.0)
    guess = size * np.random.default_rng(0).normal(size=(20, 1))
    plan = optimize.ilqr(model, model.state(), free, guess, h=0.05)
    assert plan.converged
    assert plan.cost < 1e-20


def test_what_no_control_moves_is_told():
    builder = saltus.ModelBuilder().set_gravity((0, 0, 0))
    for name, x in (("cart", 0.0), ("other", 0.5)):
        X = saltus.Pose((x, 0, 0))
        builder.add_body(name, saltus.Sphere(0.1), mass=1.0, X=X, joint="prismatic")
    model = builder.add_motor("force", joint="cart").build()
    goal = model.state(q=[0.2, 0.5])
    cost = optimize.Quadratic(model, goal, control=1e-3, final_q=[0.0, 100.0])
    plan = optimize.ilqr(model, model.state(), cost, np.zeros((20, 1)), h=0.05)
    assert "hits nothing" in plan.message
    hits = optimize.ilqr(model, model.state(), cost, np.full((20, 1), 2.0), h=0.05)
    assert hits.converged
    assert hits.impacts == {"cart ~ other": 1}
    assert hits.q[-1, 1] == pytest.approx(0.5, abs=1e-3)


@pytest.mark.parametrize("height", [0.0, 0.1])  # it slides; it bounces, and slides
def test_ilqr_pushes_against_friction(height):
    model, h, N = puck(), 0.02, 40
    start, goal = model.state({"z": height}), model.state({"x": 0.5})
    cost = optimize.Quadratic(model, goal, control=1e-3, final_q=[100, 0], final_v=[10, 0])
    plan = optimize.ilqr(model, start, cost, np.full((N, 1), 5.0), h=h)
    assert plan.converged
    assert abs(plan.q[-1, 0] - 0.5) < 0.01
    system = System(model, h, {})
    for k in range(0, N, 5):  # no control can be better by itself
        for e in (1e-2, -1e-2):
            u = plan.control.copy()
            u[k] += e
            assert total(system, cost, system.roll(start, u)) > plan.cost
    # friction brakes: without it, the same controls go farther
    smooth = model.builder().set_default_contact(friction=0.0, restitution=0.5).build()
    run = saltus.simulate(
        smooth, state=start, duration=N * h, h=h, control=plan.control, progress=False
    )
    assert run.q[-1, 0] > 0.8


def test_a_cost_of_controls_on_a_model_without_motors_is_an_error_in_words():
    model = saltus.load_urdf(saltus.scenes.chain(2))
    cost = optimize.Quadratic(model, model.state(), control=1.0, final_q=1.0)
    for find in (optimize.ilqr, optimize.transcribe):
        with pytest.raises(ModelError, match="the model has no actuators"):
            find(model, model.state(), cost, np.zeros((3, 1)), h=0.01)
