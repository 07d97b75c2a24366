"""How a model's trees are solved: chosen, overridden, told."""

from __future__ import annotations

import numpy as np
import pytest
from helpers import run_cli
from scenes import bouncing_ball, chain_on_a_body

import saltus
from saltus import TreeSolver


def solvers(model: saltus.Model) -> list[tuple[TreeSolver, int, int, int]]:
    return [(s.solver, s.trees, s.joints, s.depth) for s in model.solvers]


def test_automatic_goes_by_shape():
    cradle = saltus.load_urdf(saltus.scenes.cradle(3))
    assert solvers(cradle) == [(TreeSolver.lu, 3, 2, 2)]
    assert repr(cradle.solvers) == "[TreeSolution(lu, trees=3, joints=2, depth=2)]"
    assert solvers(saltus.load_urdf(saltus.scenes.chain(40))) == [(TreeSolver.sweep, 1, 40, 40)]


def test_it_can_be_overridden():
    sweep = saltus.load_urdf(saltus.scenes.cradle(2), solver=TreeSolver.sweep)
    assert solvers(sweep) == [(TreeSolver.sweep, 1, 2, 2)] * 2
    assert solvers(sweep.without_collisions()) == solvers(sweep)
    lu = saltus.read_urdf(saltus.scenes.chain(40), solver=TreeSolver.lu).build()
    assert solvers(lu) == [(TreeSolver.lu, 1, 40, 40)]
    built = bouncing_ball().set_solver(TreeSolver.sweep).build()
    assert solvers(built) == [(TreeSolver.sweep, 1, 1, 1)]


@pytest.mark.parametrize(
    ("text", "q", "impacts"),
    [
        (saltus.scenes.chain(12), np.linspace(0.3, -0.2, 12), 0),
        (saltus.scenes.cradle(3), [0.3, 0.02, 0, 0, 0, -0.01], 2),
    ],
    ids=["chain", "cradle"],
)
def test_trajectories_differ_by_rounding_only(text, q, impacts):
    runs = [
        saltus.simulate(saltus.load_urdf(text, solver=solver), q=q, duration=2.0, progress=False)
        for solver in TreeSolver
    ]
    assert len(runs) == 3
    assert len(runs[0].impacts) >= impacts
    for run in runs[1:]:
        np.testing.assert_allclose(run.q, runs[0].q, rtol=0, atol=1e-10)
        np.testing.assert_allclose(run.v, runs[0].v, rtol=0, atol=1e-10)
        assert run.impacts["count"].tolist() == runs[0].impacts["count"].tolist()


@pytest.mark.parametrize("solver", [1, None, saltus.ImpactLaw.nodal_energy])
def test_what_is_no_solver_is_a_type_error_in_words(solver):
    message = r"is no TreeSolver; there are saltus\.TreeSolver\.automatic, saltus\.TreeSolver\.lu, "
    text = saltus.scenes.chain(1)
    for act in (
        lambda: saltus.load_urdf(text, solver=solver),
        lambda: saltus.read_urdf(text, solver=solver),
        lambda: saltus.ModelBuilder().set_solver(solver),
    ):
        with pytest.raises(TypeError, match=message) as error:
            act()
        assert str(error.value).startswith(f"solver = {solver!r} is ")


def test_what_is_no_root_joint_is_a_type_error_in_words():
    with pytest.raises(
        TypeError, match=r"^root_joint = True is no JointType; there are saltus.JointType.fixed, "
    ):
        saltus.load_urdf(saltus.scenes.chain(1), root_joint=True)


def test_info_tells_of_it(tmp_path):
    path = tmp_path / "model.urdf"

    def told(text: str, *options: str) -> str:
        path.write_text(text)
        return run_cli("info", path, *options).stdout.splitlines()[1]

    assert told(saltus.scenes.cradle(3)) == "solver: lu (depth 2, 3 equal trees in lanes)"
    assert told(saltus.scenes.chain(12)) == "solver: lu (depth 12)"
    assert told(chain_on_a_body(40), "--floating") == "solver: sweep (depth 46)"
    assert told('<robot name="m"><link name="a"/></robot>') == "solver: none, nothing moves"
    deep = saltus.scenes.chain(90)
    again = deep.replace("joint_", "joint_b").replace("link_", "link_b")
    joints = again.partition('<link name="frame"/>')[2]
    assert told(deep.replace("</robot>", joints)) == "solver: 2 x sweep (depth 90)"


@pytest.mark.parametrize("solver", TreeSolver)
def test_a_file_of_a_run_keeps_it(tmp_path, solver):
    model = saltus.load_urdf(saltus.scenes.cradle(2), solver=solver)
    run = saltus.simulate(model, q={"swing_0": 0.3}, duration=0.4)
    run.save(tmp_path / "run.h5")
    again = saltus.load(tmp_path / "run.h5")
    assert solvers(again.model) == solvers(model)
    ends = [
        saltus.simulate(r.model, state=r.state(-1), duration=0.4).state(-1) for r in (run, again)
    ]
    assert ends[0] == ends[1]
