"""One impact is no "1 impacts"."""

from __future__ import annotations

import numpy as np
import pytest
from scenes import bouncing_ball, cradle

import saltus
from saltus.cli.main import main


def test_summaries_of_one_of_each():
    run = saltus.simulate(bouncing_ball().build(), duration=0.5, h=0.5)
    text = run.summary()
    assert " 2 rows, 1 coordinate, 1 impact with 1 impulse, " in text
    batch = saltus.simulate_batch(bouncing_ball().build(), q=[[0.0]], duration=0.5, h=0.5)
    assert batch.summary().startswith("1 run, 0 to ")
    assert batch.summary().endswith(" 2 rows, 1 coordinate, 1 impact")


def test_summaries_of_more():
    run = saltus.simulate(cradle(), q={"swing_0": 0.3}, duration=1.0)
    assert " 101 rows, 6 coordinates, 1 impact with 2 impulses, " in run.summary()


def test_models_and_outcomes():
    assert repr(bouncing_ball().build()) == "Model('ball', 1 coordinate, 2 shapes, 1 pair)"
    free = saltus.ModelBuilder().add_body("a", saltus.Sphere(1), mass=1).build()
    assert repr(free) == "Model('model', 7 coordinates, 6 velocities, 1 shape, 0 pairs)"
    one = saltus.resolve_impact([[1.0]], [[1.0]], [-1.0])
    assert repr(one) == "ImpactOutcome(v=[1.0], 1 impulse)"
    assert repr(saltus.impact_outcomes([[1.0]], [[1.0]], [-1.0])) == (
        "<ImpactOutcomes: 1 outcome, 2 velocities met>"
    )


def test_plans():
    builder = saltus.ModelBuilder("cart").set_gravity((0, 0, 0))
    builder.add_body("cart", saltus.Sphere(0.1), mass=2.0, joint="prismatic")
    model = builder.add_motor("force", joint="cart").build()
    cost = saltus.optimize.Quadratic(model, model.state(q=[1.0]), control=1.0, final_q=1.0)
    plan = saltus.optimize.ilqr(model, model.state(), cost, np.zeros((5, 1)), h=0.1)
    assert ", 1 iteration: converged" in repr(plan)  # the problem is linear
    there = saltus.optimize.Reach(model, {"cart": 1.0})
    shot = saltus.optimize.shoot(model, model.state(), 5, there, h=0.1)
    assert ", 1 iteration: " in repr(shot)


def test_errors():
    with pytest.raises(saltus.ModelError, match=r"^v has 1 entry; the model has 6 velocities$"):
        cradle().state(v=[0.0])
    with pytest.raises(saltus.ModelError, match="q has 1 row and v has 2; a row is a run"):
        saltus.simulate_batch(cradle(), q=np.zeros((1, 6)), v=np.zeros((2, 6)), duration=1.0)


def test_info(capsys):
    main(["info", str(saltus.urdf_dir() / "bouncing_ball.urdf")])
    first = capsys.readouterr().out.splitlines()[0]
    assert ", 1 coordinate, 1 velocity, 2 shapes, 1 gap, " in first
