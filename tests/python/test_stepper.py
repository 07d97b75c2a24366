"""Stepper from Python."""

from __future__ import annotations

import math
import pickle
import threading
import time

import numpy as np
import pytest
from scenes import bouncing_ball, chain, cradle

import saltus


def advance(stepper: saltus.Stepper, state: saltus.State, steps: int) -> saltus.State:
    for _ in range(steps):
        state = stepper.advance(state)
    return state


def test_a_step_is_a_new_state():
    stepper = saltus.Stepper(cradle(), h=0.01)
    start = cradle().state({"swing_0": 0.3})
    kept = pickle.loads(pickle.dumps(start))
    after = stepper.advance(start)
    assert start == kept
    assert after.t == pytest.approx(0.01)
    assert after != start
    assert stepper.report.arcs == 1
    assert stepper.report.impacts == []
    assert 0 < stepper.report.residual < 1e-10
    assert stepper.options.h == 0.01
    assert stepper.model.coordinate_names == cradle().coordinate_names


def test_the_same_states_give_the_same_bits():
    start = cradle().state({"swing_0": 0.3})
    ends = [advance(saltus.Stepper(cradle()), start, 60) for _ in range(2)]
    assert ends[0] == ends[1]
    # and through a pickle halfway
    stepper = saltus.Stepper(cradle())
    halfway = pickle.loads(pickle.dumps(advance(stepper, start, 30)))
    assert advance(stepper, halfway, 30) == ends[0]


def test_report_names_the_impacts():
    stepper = saltus.Stepper(cradle(), 0.01, saltus.ImpactLaw.nodal_energy)
    state = advance(stepper, cradle().state({"swing_0": 0.3}), 50)
    assert stepper.report.impacts == []
    stepper.advance(state)
    report = stepper.report
    (impact,) = report.impacts
    assert impact.t == pytest.approx(0.504604, abs=1e-4)
    assert impact.pairs == ["ball_0 ~ ball_1", "ball_1 ~ ball_2"]
    assert impact.contacts == 2
    assert impact.law is saltus.ImpactLaw.nodal_energy
    assert impact.fallback is False
    assert impact.lambdas == pytest.approx([impact.lambdas[0]] * 2)
    assert report.arcs == 2
    stepper.advance(state)
    assert report.impacts[0].pairs == impact.pairs  # a report outlives the next step
    assert "ball_0 ~ ball_1" in repr(report)


def test_discrete_energy_law():
    start = cradle().state({"swing_0": 0.3})
    stepper = saltus.Stepper(cradle(), law=saltus.ImpactLaw.discrete_energy)
    state = advance(stepper, start, 51)
    (impact,) = stepper.report.impacts
    assert impact.law in (saltus.ImpactLaw.nodal_energy, saltus.ImpactLaw.discrete_energy)
    assert impact.fallback is (impact.law is saltus.ImpactLaw.nodal_energy)
    assert cradle().velocity(state)[4] < -0.5  # ball 2 flies to the right


def test_collisions_can_be_left_out():
    stepper = saltus.Stepper(cradle(), collisions=False)
    state = advance(stepper, cradle().state({"swing_0": 0.3}), 60)
    assert state.q[0] < 0  # through the others
    assert state.q[4] == 0


@pytest.mark.parametrize(
    "options",
    [{"h": 0.0}, {"h": -1.0}, {"h": math.nan}, {"max_iterations": 0}, {"rest": -1.0}],
)
def test_options_out_of_range(options):
    with pytest.raises(saltus.ModelError, match=next(iter(options))):
        saltus.Stepper(cradle(), **options)


def test_wrong_options_are_type_errors():
    laws = ", ".join(f"saltus.ImpactLaw.{law.name}" for law in saltus.ImpactLaw)
    for act in (
        lambda law: saltus.Stepper(cradle(), law=law),
        lambda law: saltus.StepOptions(law=law),
    ):
        for law in (0, None):  # numbers are laws in arrays of impacts only
            with pytest.raises(TypeError) as error:
                act(law)
            assert str(error.value) == f"law = {law!r} is no ImpactLaw; there are {laws}"
    with pytest.raises(TypeError, match=r"^model is a str; saltus.load_urdf makes a Model of it$"):
        saltus.Stepper("model.urdf")
    with pytest.raises(TypeError):
        saltus.Stepper(cradle(), hh=0.1)
    with pytest.raises(TypeError):
        saltus.Stepper(cradle(), 0.01, saltus.ImpactLaw.nodal_energy, True)  # keyword-only


def test_foreign_and_overlapping_states():
    stepper = saltus.Stepper(cradle())
    with pytest.raises(saltus.ModelError, match="3"):
        stepper.advance(chain(3).state())
    with pytest.raises(saltus.ModelError, match="ball_0 ~ ball_1"):
        stepper.advance(cradle().state({"swing_0": -0.05}))
    with pytest.raises(saltus.ModelError, match="finite"):
        stepper.advance(saltus.State(0.0, [math.nan] * 6, [0.0] * 6))


def test_step_error_has_numbers():
    # A long chain under gravity at a coarse step does not converge; theory: h omega > 2.
    model = chain(100)
    rng = np.random.default_rng(0)
    stepper = saltus.Stepper(model, h=0.5, max_iterations=5)
    state = model.state(rng.uniform(-2, 2, 100), rng.uniform(-20, 20, 100))
    with pytest.raises(saltus.StepError) as error:
        advance(stepper, state, 20)
    assert isinstance(error.value, RuntimeError)
    assert error.value.t >= 0
    assert error.value.residual > 0
    assert error.value.iterations > 0


def test_threads_may_share_a_stepper():
    model = bouncing_ball().build()
    stepper = saltus.Stepper(model)
    start = model.state([0.0])
    expected = saltus.Stepper(model).advance(start)
    wrong = []

    def work() -> None:
        wrong.extend(s for s in (stepper.advance(start) for _ in range(200)) if s.q != expected.q)

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def test_long_calls_release_the_interpreter():
    """Counts how far another thread gets while a run is on."""
    model = chain(16)
    ticks, done = 0, False

    def run() -> None:
        nonlocal done
        saltus.simulate(model, q=[0.1] * 16, duration=40.0, h=0.002, progress=False)
        done = True

    thread = threading.Thread(target=run)
    thread.start()
    while not done:
        ticks += 1
        time.sleep(0.001)
    thread.join()
    assert ticks > 20
