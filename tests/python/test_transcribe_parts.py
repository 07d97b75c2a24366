"""What a transcribed problem is made of, each derivative against differences and the stepper's."""

from __future__ import annotations

import numpy as np
import pytest
from tests.python.driven_models import batter, bouncer, cue, spinner

import saltus
from saltus import ModelError, optimize
from saltus.optimize.pieces import Setting
from saltus.optimize.planned import Hit, Planner, instants, neighbours, plan_of, planned_steps
from saltus.optimize.program import Program, overlaps
from saltus.optimize.sparse import Triplets
from saltus.optimize.system import System, to_bounds

H = 0.05
FLOOR = [Hit(0, 0)]


def dense(entries: Triplets, rows: int, columns: int) -> np.ndarray:
    out = np.zeros((rows, columns))
    np.add.at(out, (entries.rows, entries.columns), entries.values)
    return out


def moving(model: saltus.Model, seed: int) -> saltus.State:
    rng = np.random.default_rng(seed)
    start = model.state(v=rng.normal(size=model.n_v))
    return System(model, H, {}).shift(start, 0.1 * rng.normal(size=2 * model.n_v))


def differences(f, d, e=1e-6):
    """Return the derivative of f at 0 along d by central differences of order 4."""
    near, far = f(e * d) - f(-e * d), f(2 * e * d) - f(-2 * e * d)
    return (8 * near - far) / (12 * e)


@pytest.mark.parametrize(
    ("make", "hits", "taus"),
    [
        (bouncer, FLOOR, [0.02]),
        (bouncer, FLOOR, [0.0]),
        (batter, FLOOR, [0.02]),
        (batter, [Hit(1, 0)], [0.03]),
        (batter, [Hit(0, 0), Hit(1, 0)], [0.02, 0.01]),
        (spinner, [], []),
    ],
)
def test_planned_steps_against_differences(make, hits, taus):
    model = make()
    planner, system = Planner(model, H, {}), System(model, H, {})
    x, u, taus = moving(model, 1), np.array([2.0]), np.array(taus)
    step, n = planner.step(x, u, hits, taus), 2 * model.n_v

    def outputs(d):
        near = planner.step(system.shift(x, d[:n]), u + d[n : n + 1], hits, taus + d[n + 1 :])
        return np.concatenate([system.difference(step.end, near.end), near.gaps])

    whole = np.vstack([step.by, step.gaps_by])
    if np.any(taus == 0):  # an arc has no negative duration
        whole = whole[:, : n + 1]
    for d, column in zip(np.eye(step.by.shape[1]), whole.T, strict=False):
        # of order 4: rounding 1e-16 / e remains
        assert np.abs(differences(outputs, d) - column).max() < 1e-9 * max(1, np.abs(whole).max())


@pytest.mark.parametrize(("make", "v"), [(bouncer, [-6.0]), (cue, [9.0, 0.5])])
def test_a_planned_step_is_the_steppers_where_its_gap_is_closed(make, v):
    model, u = make(), np.array([3.0])
    x = model.state(v=v)
    stepper = saltus.Stepper(model, H, record=True)
    end, own = stepper.advance(x, control=u), stepper.derivative()
    (impact,) = stepper.report.impacts
    tau = np.array([impact.t])
    step = Planner(model, H, {}).step(x, u, FLOOR, tau)
    assert abs(step.gaps[0]) < 1e-12
    assert np.abs(step.end.q - end.q).max() < 1e-12
    assert np.abs(step.end.p - end.p).max() < 1e-12
    # the instant moves so that the gap stays closed
    n = 2 * model.n_v
    moves = -step.gaps_by[:, : n + 1] / step.gaps_by[0, n + 1]
    whole = step.by[:, : n + 1] + step.by[:, n + 1 :] @ moves
    np.testing.assert_allclose(whole, np.hstack([own.A, own.B]), atol=1e-11 * np.abs(whole).max())


def program_of(model: saltus.Model, N: int, impacts: list, reach=None, clear=()) -> Program:
    """Return a problem whose guess is no motion."""
    planner, system = Planner(model, H, {}), System(model, H, {})
    start, control = moving(model, 2), np.ones((N, 1))
    goal = moving(model, 3)
    cost = optimize.Quadratic(model, goal, q=0.3, v=0.2, control=0.5, final_q=2.0, final_v=1.0)
    hits, taus = plan_of(planner, start, N, impacts)
    states = planned_steps(planner, start, control, hits, taus)
    bounds = to_bounds(model, None)
    setting = Setting(
        system, planner, cost, reach, bounds, states, control, hits, taus, list(clear)
    )
    return Program(setting, 1e-8, 100)


PROBLEMS = {
    "floor": lambda: program_of(
        bouncer(),
        4,
        [("ball ~ floor", 0.06), ("ball ~ floor", 0.08)],
        optimize.Reach(bouncer(), {"ball": 0.1}, {"ball": 0.2}),
        [(0, 1), (0, 4)],
    ),
    "batter": lambda: program_of(batter(), 2, [("upper ~ ball", 0.07)], clear=[(0, 1)]),
    "spinner": lambda: program_of(spinner(), 3, []),
}


@pytest.mark.parametrize("name", PROBLEMS)
def test_derivatives_of_a_program_against_differences(name):
    program = PROBLEMS[name]()
    n, m = len(program.guess), len(program.least)
    rng = np.random.default_rng(4)
    z = program.guess + 0.05 * rng.normal(size=n)
    z[program.first_tau :] = program.guess[program.first_tau :] + 1e-3
    y = rng.normal(size=m)

    def slope(z):
        return 0.7 * program.gradient(z) + dense(program.jacobian(z), m, n).T @ y

    J, H = dense(program.jacobian(z), m, n), dense(program.hessian(z, 0.7, y), n, n)
    assert np.array_equal(H, H.T)
    bare = dense(program.hessian(z, 0.7, None), n, n)
    rest = dense(program.hessian(z, 0.0, y), n, n)
    np.testing.assert_allclose(bare + rest, H, atol=1e-7 * np.abs(H).max())
    for d in rng.normal(size=(3, n)):
        by = differences(lambda dz: program.constraints(z + dz), d)
        assert np.abs(by - J @ d).max() < 1e-9 * np.abs(J @ d).max()  # rounding is 1e-16 / e
        by = differences(lambda dz: program.cost(z + dz), d)
        assert abs(by - program.gradient(z) @ d) < 1e-9 * max(1, abs(by))
        by = differences(lambda dz: slope(z + dz), d)
        assert np.abs(by - H @ d).max() < 1e-6 * np.abs(by).max()  # H is of differences itself


def test_the_hessian_of_smooth_steps_is_exact():
    builder = saltus.read_urdf(saltus.scenes.chain(2))
    builder.add_motor("motor", joint=builder.joint_names[-1])
    program = program_of(builder.build(), 3, [])
    n, m = len(program.guess), len(program.least)
    rng = np.random.default_rng(6)
    z, y = program.guess + 0.05 * rng.normal(size=n), rng.normal(size=m)
    H = dense(program.hessian(z, 0.0, y), n, n)

    def slope(z):
        return dense(program.jacobian(z), m, n).T @ y

    for d in rng.normal(size=(3, n)):
        by = differences(lambda dz: slope(z + dz), d, 1e-4)
        # truncation 1e-16 times fifth derivatives, rounding 1e-12; H of differences is off by 4e-9
        assert np.abs(by - H @ d).max() < 1e-10 * np.abs(by).max()


def test_rows_of_a_program_are_those_it_tells():
    program = PROBLEMS["floor"]()
    c = program.constraints(program.guess)
    steps = 4 * program.n
    assert np.abs(c[:steps]).max() < 1e-13  # the guess makes its own steps
    assert len(c) == steps + 2 + 2 + 2 + 1 == len(program.least)
    assert np.all(program.least[:-1] == 0)
    assert program.most[-1] == H
    assert np.isinf(program.most[-3:-1]).all()
    assert program.defect(program.guess) == np.abs(c[steps : steps + 4]).max()
    first = program.states(program.guess)[1]
    assert c[-3] == pytest.approx(program.setting.system.model.gaps(first.q).phi[0])


def test_gaps_that_have_closed_are_found():
    model = bouncer()
    planner, system = Planner(model, H, {}), System(model, H, {})
    start, control = model.state(), np.zeros((6, 1))
    cost = optimize.Quadratic(model, start, control=1.0)
    states = planned_steps(planner, start, control, [], np.zeros(0))  # through the floor
    setting = Setting(system, planner, cost, None, to_bounds(model, None), states, control, [],
                      np.zeros(0), [], clearance=0.05)  # fmt: skip
    program = Program(setting, 1e-8, 10)
    fallen = [(0, k) for k in range(1, 7) if 0.2 - 9.81 / 2 * (k * H) ** 2 < 0.05]
    assert overlaps(program, program.guess) == fallen
    assert 1 < len(fallen) < 6


def test_plans_are_steps_and_durations():
    model = bouncer()
    planner, start = Planner(model, H, {}), model.state(t=1.0)
    plan = [("ball ~ floor", 1.06), ("ball ~ floor", 1.08), ("ball ~ floor", 1.17)]
    hits, taus = plan_of(planner, start, 4, plan)
    assert [hit.step for hit in hits] == [1, 1, 3]
    assert taus == pytest.approx([0.01, 0.02, 0.02])
    assert instants(start, H, hits, taus) == pytest.approx([t for _, t in plan])
    with pytest.raises(ModelError, match=r"no pair is named 'ball ~ roof'; pairs are ball ~ floor"):
        plan_of(planner, start, 4, [("ball ~ roof", 1.0)])
    with pytest.raises(ModelError, match=r"planned at 1\.02 s, after one at 1\.1 s; times ascend"):
        plan_of(planner, start, 4, [("ball ~ floor", 1.1), ("ball ~ floor", 1.02)])
    with pytest.raises(ModelError, match=r"planned at 1\.2 s, .* end before 1\.2 s"):
        plan_of(planner, start, 4, [("ball ~ floor", 1.2)])
    rough = model.builder().set_default_contact(friction=0.3).build()
    with pytest.raises(ModelError, match=r"ball ~ floor has friction 0\.3; planned impacts have"):
        plan_of(Planner(rough, H, {}), start, 4, plan)
    with pytest.raises(ModelError, match="law is shadow_energy; planned impacts are those of"):
        Planner(model, H, {"law": "shadow_energy"})


def test_impacts_at_an_end_of_their_step_are_tried_in_the_next():
    def plans(hits, taus):
        found = neighbours(hits, np.array(taus), 4, H)
        return [([hit.step for hit in plan], pytest.approx(durations)) for plan, durations in found]

    two = [Hit(0, 1), Hit(0, 2)]
    assert plans(two, [0.02, 0.03]) == []
    assert plans(two, [0.0, 0.03]) == [
        ([0, 2], [0.05 * H, 0.03]),
        ([2, 2], [0.05 * 0.03, 0.95 * 0.03]),
    ]
    assert plans(two, [H, 0.03]) == [
        ([0, 2], [0.95 * H, 0.03]),
        ([2, 2], [0.95 * 0.03, 0.05 * 0.03]),
    ]
    assert plans(two, [0.02, 0.0]) == [
        ([1, 1], [0.02, 0.05 * (H - 0.02)]),
        ([1, 3], [0.02, 0.05 * H]),
    ]
    # of two in a step the first can go back, and the last on
    both = [Hit(0, 1), Hit(1, 1)]
    assert plans(both, [0.0, 0.02]) == [([0, 1], [0.05 * H, 0.02])]
    assert plans(both, [0.01, 0.04]) == [([1, 2], [0.01, 0.95 * H])]
    # nothing is before the first step, nor behind the last, and no room where another is
    assert plans([Hit(0, 0)], [0.0]) == [([1], [0.05 * H])]
    assert plans([Hit(0, 3)], [H]) == [([2], [0.95 * H])]
    assert plans(two, [H, 0.0])[1:] == [([1, 3], [H, 0.05 * H])]
