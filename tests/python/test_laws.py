"""Laws and orders of impacts, restitution and rest, as a script uses them."""

from __future__ import annotations

import numpy as np
import pytest
from scenes import beads, bouncing_ball

import saltus


def ball(restitution):
    return bouncing_ball(height=0.0).set_default_contact(restitution=restitution).build()


LAWS = [law for law in saltus.ImpactLaw if law is not saltus.ImpactLaw.custom]


@pytest.mark.parametrize("law", LAWS)
def test_every_law_sorts_velocities_of_equal_balls(law):
    model = beads(5).build()
    v = [3.0, -1.0, 2.0, 0.5, -2.0]
    run = saltus.simulate(model, v=v, duration=0.05, law=law)
    np.testing.assert_allclose(run.v[-1], sorted(v), atol=1e-12)
    assert run.options.law is law


def test_restitution_of_materials_decides():
    builder = beads(3)
    builder.set_material("x_0", "clay").set_material("x_1", "clay").set_material("x_2", "steel")
    builder.set_contact("clay", "clay", restitution=0.0).set_contact("clay", "steel")
    model = builder.build()
    assert model.contact_properties(0).restitution == 0
    assert model.contact_properties(2) != model.contact_properties(0)
    outcome = saltus.Stepper(model).advance(model.state(v={"x_1": -1.0}))
    np.testing.assert_allclose(outcome.p, [-0.5, -0.5, 0], atol=1e-12)
    with pytest.raises(saltus.ModelError, match=r"restitution 2; it is in \[0, 1\]"):
        builder.set_default_contact(restitution=2)


def test_a_ball_comes_to_rest_when_it_should():
    run = saltus.simulate(ball(0.5), q={"z": 1.0}, duration=3.0)
    assert run.settlings["t"] == pytest.approx([1.354571], abs=5e-7)
    assert run.pair_names[run.settlings["pair"][0]] == "ball ~ floor"
    assert np.abs(run.q[-100:]).max() < 1e-12


def test_settlings_are_kept_in_files(tmp_path):
    run = saltus.simulate(ball(0.5), q={"z": 1.0}, duration=3.0, order=saltus.ImpactOrder.index)
    run.save(tmp_path / "run.h5")
    again = saltus.load(tmp_path / "run.h5")
    np.testing.assert_array_equal(again.settlings, run.settlings)
    assert again.options.order is saltus.ImpactOrder.index


def reflect(problem):
    column = np.linalg.solve(problem.M, problem.N[0])
    return problem.p - 2 * problem.u[0] / (problem.N[0] @ column) * problem.N[0]


def test_a_function_may_be_the_law(tmp_path):
    model = ball(1.0)
    own = saltus.simulate(model, q={"z": 1.0}, duration=3.0, law=reflect)
    standard = saltus.simulate(model, q={"z": 1.0}, duration=3.0)
    np.testing.assert_allclose(own.q, standard.q, atol=1e-11)
    assert own.options.law is saltus.ImpactLaw.custom
    assert own.impact(0).law is saltus.ImpactLaw.custom
    own.save(tmp_path / "own.h5")
    again = saltus.load(tmp_path / "own.h5")
    assert again.options.law is saltus.ImpactLaw.custom
    batch = saltus.simulate_batch(model, q={"z": [1.0, 2.0]}, duration=3.0, law=reflect)
    np.testing.assert_array_equal(batch.q[0], own.q)


def test_what_a_function_does_wrong_is_said():
    stepper = saltus.Stepper(ball(1.0), law=lambda problem: "p")
    state = stepper.model.state(v={"z": -1.0})
    with pytest.raises(TypeError, match="the custom law returned 'p'; it is to return"):
        stepper.advance(state)
    stepper = saltus.Stepper(ball(1.0), law=lambda problem: [1.0, 2.0])
    with pytest.raises(saltus.StepError, match="returned 2 momenta; the model has 1 velocity"):
        stepper.advance(state)
    stepper = saltus.Stepper(ball(1.0), law=lambda problem: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        stepper.advance(state)
    assert "1 contact>" in repr(_seen(ball(1.0), state))


def _seen(model, state):
    problems = []

    def law(problem):
        problems.append(problem)
        return -problem.p

    saltus.Stepper(model, law=law).advance(state)
    return problems[0]


def test_an_overlap_is_resolved():
    model = beads(3).build()
    with pytest.raises(saltus.ModelError, match=r"x_0 ~ x_1 by 0.03 m.*resolve_overlap"):
        saltus.Stepper(model).advance(model.state(q={"x_0": 0.03}))
    q = saltus.resolve_overlap(model, {"x_0": 0.03})
    np.testing.assert_allclose(model.gaps(q).phi[[0, 2]], 0, atol=1e-11)
    saltus.Stepper(model).advance(model.state(q=q))


def test_every_law_has_a_line_in_the_documentation_of_its_enumeration():
    lines = (saltus.ImpactLaw.__doc__ or "").splitlines()
    assert [line for line in lines if line in saltus.ImpactLaw.__members__] == [
        law.name for law in saltus.ImpactLaw
    ]
    assert [law.value for law in saltus.ImpactLaw] == list(range(len(saltus.ImpactLaw)))
