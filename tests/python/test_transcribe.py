"""DMOC: against iLQR, closed forms and a solver of one's own; through planned impacts."""

from __future__ import annotations

import numpy as np
import pytest
from tests.python.driven_models import acrobot, bouncer, cart, cue, puck, spinner, walled
from tests.python.helpers import hide_scipy, interrupting

import saltus
from saltus import ModelError, optimize


def dense(entries: optimize.Triplets, rows: int, columns: int) -> np.ndarray:
    out = np.zeros((rows, columns))
    np.add.at(out, (entries.rows, entries.columns), entries.values)
    return out


@pytest.mark.parametrize("solver", ["slsqp", "trust-constr"])
@pytest.mark.parametrize("bounds", [None, (-0.35, 0.4)])
def test_it_agrees_with_ilqr_on_a_smooth_problem(solver, bounds):
    model, h, zeros = acrobot(), 0.12, np.zeros((12, 1))
    start, goal = model.state(), model.state({"shoulder": 1.0})
    cost = optimize.Quadratic(model, goal, control=0.1, final_q=10.0, final_v=10.0)
    ref = optimize.ilqr(
        model, start, cost, zeros, h=h, bounds=bounds, second_order=True, tolerance=1e-13
    )
    found = optimize.transcribe(model, start, cost, zeros, h=h, bounds=bounds, solver=solver)
    assert found.converged
    assert found.defect < 1e-8
    assert found.drift < 1e-8
    # a gradient of the Lagrangian of 1e-8, and barriers of 1e-8 for each bound
    assert found.cost == pytest.approx(ref.cost, rel=1e-6)
    assert np.abs(found.control - ref.control).max() < 2e-3
    if bounds is not None:
        assert bounds[0] - 1e-9 <= found.control.min() < found.control.max() <= bounds[1] + 1e-9
        assert ref.control.min() == bounds[0] or ref.control.max() == bounds[1]


@pytest.mark.parametrize("solver", ["slsqp", "trust-constr"])
def test_it_agrees_with_ilqr_through_an_impact(solver):
    model, h, N = bouncer(), 0.04, 12
    start, guess = model.state(v=[-2.0]), np.full((N, 1), 5.0)
    cost = optimize.Quadratic(model, model.state(q=[0.25]), control=1e-3, final_q=1e2, final_v=1e2)
    ref = optimize.ilqr(model, start, cost, guess, h=h, second_order=True, tolerance=1e-13)
    found = optimize.transcribe(model, start, cost, guess, h=h, solver=solver)
    assert found.converged
    assert found.cost == pytest.approx(ref.cost, rel=1e-7)
    assert np.abs(found.control - ref.control).max() < 1e-2
    run = found.run()
    assert [pair for pair, _ in found.impacts] == ["ball ~ floor"]
    assert found.impacts[0][1] == pytest.approx(run.impacts["t"][0], abs=1e-8)
    assert np.abs(run.q - found.q).max() < 1e-8


def least_effort_off_the_wall(N: int, h: float, m: float) -> np.ndarray:
    """Return controls that take the cart to the wall and back, at rest, in N steps, N odd.

    Behind the wall its mirror image goes on: from 0 to 2, with forces that change sign at the wall.
    By symmetry that is in the middle of the middle step.
    """
    k, middle = np.arange(N), N // 2
    sign = np.where(k < middle, 1.0, -1.0)
    rows = np.array([sign * (N - k - 0.5) * h * h / m, sign * h / m])
    rows[:, middle] = (h / 2) ** 2 / m, 0.0
    return np.linalg.pinv(rows) @ [2.0, 0.0]


@pytest.mark.parametrize("planned", [0.3, 0.65])
def test_least_effort_off_a_wall_has_a_closed_form(planned):
    model, N = walled(), 9
    h, start = 1 / N, model.state()
    cost = optimize.Quadratic(model, start, control=1.0)
    back = optimize.Reach(model, {"cart": 0.0}, {"cart": 0.0})
    found = optimize.transcribe(
        model, start, cost, np.zeros((N, 1)), h=h, impacts=[("cart ~ wall", planned)], reach=back
    )
    assert found.converged
    u = least_effort_off_the_wall(N, h, 2.0)
    assert found.cost == pytest.approx(u @ u / 2, rel=1e-10)
    assert np.abs(found.control[:, 0] - u).max() < 1e-6 * np.abs(u).max()
    ((pair, t),) = found.impacts
    assert pair == "cart ~ wall"
    assert t == pytest.approx(0.5, abs=1e-7)
    run = found.run()
    assert run.impacts["t"] == pytest.approx([t], abs=1e-10)
    assert np.abs(run.q[-1]).max() < 1e-9
    assert np.abs(run.v[-1]).max() < 1e-8


def test_a_guess_that_hits_nothing_finds_the_impact_that_is_planned():
    model, h, N = cue(), 0.1, 10
    cost = optimize.Quadratic(model, model.state(), control=1.0)
    goal = optimize.Reach(model, {"struck": 0.3})
    zeros = np.zeros((N, 1))
    with pytest.raises(ModelError, match="start from one that does"):
        optimize.shoot(model, model.state(), zeros, goal, h=h)
    found = optimize.transcribe(
        model, model.state(), cost, zeros, h=h, impacts=[("cue ~ struck", 0.5)], reach=goal
    )
    assert found.converged
    assert found.run().q[-1, 1] == pytest.approx(0.3, abs=1e-8)
    # elastic and of one mass: the struck ball takes the cue's speed v, so 0.3 = v (1 - t)
    ((_, t),) = found.impacts
    v = found.v[-1, 1]
    assert v * (1.0 - t) == pytest.approx(0.3, abs=1e-8)
    # a push is worth more the earlier it is: the force falls to 0 at the impact and stays there.
    # The cost is least to 1e-10, so forces are what they should be to the root of twice that.
    k = int(t / h)
    assert np.abs(found.control[k + 1 :]).max() < 1.5e-5
    assert np.all(np.diff(found.control[: k + 1, 0]) < 0)


def test_two_impacts_in_order():
    model, h, N = bouncer(), 0.1, 9
    cost = optimize.Quadratic(model, model.state(), control=1.0)
    plan = [("ball ~ floor", 0.2), ("ball ~ floor", 0.6)]
    found = optimize.transcribe(
        model,
        model.state(),
        cost,
        np.zeros((N, 1)),
        h=h,
        impacts=plan,
        reach=optimize.Reach(model, {"ball": 0.1}),
    )
    assert found.converged
    assert len(found.impacts) == len(found.run().impacts) == 2
    assert found.run().q[-1, 0] == pytest.approx(0.1, abs=1e-7)


def test_gaps_without_a_plan_stay_open():
    model, h, N = bouncer(), 0.05, 12
    cost = optimize.Quadratic(model, model.state(), control=1.0)
    goal = optimize.Reach(model, {"ball": 0.1}, {"ball": 4.0})  # it takes a run-up
    way = {"h": h, "impacts": [], "reach": goal}
    guess = np.full((N, 1), 9.81)
    through = optimize.transcribe(model, model.state(), cost, guess, **way)
    assert not through.converged
    assert "the run of the controls hits ball ~ floor, the plan nothing" in through.message
    above = optimize.transcribe(model, model.state(), cost, guess, clearance=0.03, **way)
    assert above.converged
    gaps = above.q[1:, 0] + 0.2
    assert gaps.min() == pytest.approx(0.03, abs=1e-7)
    assert len(above.run().impacts) == 0
    assert above.cost > through.cost


def test_it_turns_a_ball_joint():
    model, zeros = spinner(), np.zeros((5, 1))
    goal = model.state(model.integrate(model.neutral(), [0.0, 0.4, 0.0, -0.5]))
    cost = optimize.Quadratic(model, goal, control=0.01, final_q=100.0, final_v=1.0)
    ref = optimize.ilqr(model, model.state(), cost, zeros, h=0.1, second_order=True)
    found = optimize.transcribe(model, model.state(), cost, zeros, h=0.1, solver="trust-constr")
    assert found.converged
    assert found.cost == pytest.approx(ref.cost, rel=1e-8)


def newton(program: optimize.Program) -> optimize.Solution:
    """Solve equalities and the gradient of the Lagrangian by Newton's method."""
    n, m = len(program.guess), len(program.least)
    z, y = program.guess, np.zeros(m)
    for _ in range(20):
        J, H = dense(program.jacobian(z), m, n), dense(program.hessian(z, 1.0, y), n, n)
        K = np.block([[H, J.T], [J, np.zeros((m, m))]])
        step = np.linalg.solve(K, -np.concatenate([program.gradient(z), program.constraints(z)]))
        z, y = z + step[:n], step[n:]
        program.note(z)
        if np.abs(step[:n]).max() < 1e-10:
            return optimize.Solution(z, True, "small steps")
    return optimize.Solution(z, False, "no end")


def test_a_solver_of_ones_own():
    model, N = cart(), 10
    cost = optimize.Quadratic(model, model.state(), control=1.0)
    goal = optimize.Reach(model, {"cart": 1.0}, {"cart": 0.0})
    found = optimize.transcribe(
        model, model.state(), cost, np.zeros((N, 1)), h=0.1, reach=goal, solver=newton
    )
    assert found.converged
    assert found.message == "small steps"
    assert len(found.costs) == 2  # it is linear
    shot = optimize.shoot(model, model.state(), np.zeros((N, 1)), goal, h=0.1)
    assert np.abs(found.control - shot.control).max() < 1e-8  # the shortest, too


def test_states_can_be_guessed():
    model, N = acrobot(), 8
    start, goal = model.state(), model.state({"shoulder": 0.5})
    cost = optimize.Quadratic(model, goal, control=0.1, final_q=10.0, final_v=10.0)
    states = [model.state({"shoulder": 0.5 * k / N}) for k in range(N + 1)]  # no motion
    way = {"h": 0.1, "solver": newton}
    found = optimize.transcribe(model, start, cost, np.zeros((N, 1)), states=states, **way)
    other = optimize.transcribe(model, start, cost, np.zeros((N, 1)), **way)
    assert found.converged
    assert found.cost == pytest.approx(other.cost, rel=1e-9)
    assert found.states[0] is not states[0] or found.q[0] == pytest.approx(start.q)
    with pytest.raises(ModelError, match="states are 3; of 8 steps it is one more"):
        optimize.transcribe(model, start, cost, np.zeros((N, 1)), states=states[:3], **way)


def test_ctrl_c_keeps_the_best_so_far(capsys):
    model = acrobot()
    cost = optimize.Quadratic(model, model.state({"shoulder": 1.0}), control=0.1, final_q=10.0)
    parts = []
    stop = interrupting(parts, at=3)

    found = optimize.transcribe(
        model, model.state(), cost, np.zeros((10, 1)), h=0.1, iterations=60, progress=stop
    )
    assert parts == [1 / 60, 2 / 60, 3 / 60]
    assert not found.converged
    assert found.message.endswith("stopped after 3 iterations")
    assert "best so far" in capsys.readouterr().err
    assert found.cost in found.costs


def test_transcribe_says_what_is_wrong():
    model, zeros = bouncer(), np.zeros((5, 1))
    start = model.state()
    cost = optimize.Quadratic(model, start, control=1.0)
    with pytest.raises(ModelError, match="solver is 'ipopt'; it is one of 'trust-constr', 'slsqp'"):
        optimize.transcribe(model, start, cost, zeros, solver="ipopt")
    with pytest.raises(ModelError, match="clearance is -1"):
        optimize.transcribe(model, start, cost, zeros, clearance=-1)
    with pytest.raises(ModelError, match="reach returned 1 misses with derivatives of shape"):
        optimize.transcribe(model, start, cost, zeros, reach=lambda q, v: (q, [1.0]))
    with pytest.raises(TypeError, match="cost is a NoneType"):
        optimize.transcribe(model, start, None, zeros)
    with pytest.raises(ModelError, match="no pair is named 'ball ~ wall'"):
        optimize.transcribe(model, start, cost, zeros, impacts=[("ball ~ wall", 0.01)])
    lies = puck().builder().set_default_contact(friction=0, restitution=0).build()
    effort = optimize.Quadratic(lies, lies.state(), control=1.0)
    with pytest.raises(ModelError, match="in step 0 of the guess contacts stay closed: puck ~ flo"):
        optimize.transcribe(lies, lies.state(), effort, zeros)
    X = saltus.Pose((0.7, 0, 0))  # it touches the struck ball
    row = cue().builder().add_body("last", saltus.Sphere(0.1), mass=1.0, X=X, joint="prismatic")
    cradle = row.build()
    effort = optimize.Quadratic(cradle, cradle.state(), control=1.0)
    with pytest.raises(ModelError, match="of the guess several gaps close at once: cue ~ struck"):
        optimize.transcribe(cradle, cradle.state(v=[9.0, 0.0, 0.0]), effort, zeros)
    few = optimize.transcribe(
        model, start, cost, np.ones((5, 1)), iterations=1, reach=optimize.Reach(model, {"ball": 9})
    )
    assert not few.converged
    assert "Transcription(5 steps of 0.01 s, 0 planned impacts, cost" in repr(few)


def test_without_scipy_the_error_says_what_to_do(monkeypatch):
    hide_scipy(monkeypatch)
    model = cart()
    cost = optimize.Quadratic(model, model.state(), control=1.0)
    with pytest.raises(ImportError, match="transcribe needs SciPy, or a solver of your own"):
        optimize.transcribe(model, model.state(), cost, np.zeros((5, 1)))
