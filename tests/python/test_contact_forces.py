"""What a run and a stepper tell of the forces between bodies: carried, held, rubbed."""

from __future__ import annotations

import numpy as np
import pytest
from scenes import on_slope, puck

import saltus

G = 9.81
A, H = 0.3, 0.01  # [rad] the slope, [s] a step
DOWNHILL = np.array([np.cos(A), 0, -np.sin(A)])


def block_on_slope(friction: float) -> saltus.Model:
    """Return a free box of 2 kg that lies on a slope which falls towards +x."""
    return on_slope(saltus.Box((0.3, 0.2, 0.1)), A, restitution=0, friction=friction)


def contacts_after(model: saltus.Model, state: saltus.State, steps: int = 5):
    stepper = saltus.Stepper(model, h=H)
    for _ in range(steps):
        state = stepper.advance(state)
    return state, stepper.report.contacts


def test_a_block_on_a_slope_is_carried_and_held():
    model = block_on_slope(friction=0.5)
    state, contacts = contacts_after(model, model.state())
    assert {contact.pair.partition("[")[0] for contact in contacts} == {"block"}
    assert len({contact.pair for contact in contacts}) == len(contacts) <= 4
    weight = 2.0 * G * H
    assert sum(c.impulse for c in contacts) == pytest.approx(weight * np.cos(A), abs=1e-12)
    held = sum(c.tangential for c in contacts)  # the force uphill, on the block
    np.testing.assert_allclose(held, -weight * np.sin(A) * DOWNHILL, atol=1e-12)
    assert np.abs(state.p).max() < 1e-12


def test_a_block_that_slides_is_rubbed_by_mu_times_what_carries_it():
    model = block_on_slope(friction=0.1)
    state, contacts = contacts_after(model, model.state())
    assert sum(c.impulse for c in contacts) == pytest.approx(2.0 * G * H * np.cos(A), abs=1e-12)
    for contact in contacts:
        size = np.linalg.norm(contact.tangential)
        assert size == pytest.approx(0.1 * contact.impulse, abs=1e-12)
        np.testing.assert_allclose(contact.tangential, -size * DOWNHILL, atol=1e-12)
    gained = 2.0 * G * (np.sin(A) - 0.1 * np.cos(A)) * 5 * H
    assert state.p[0] == pytest.approx(gained, abs=1e-12)


def test_a_contact_without_friction_has_none():
    model = block_on_slope(friction=0.0)
    _, contacts = contacts_after(model, model.state())
    assert sum(c.impulse for c in contacts) == pytest.approx(2.0 * G * H * np.cos(A), abs=1e-12)
    assert not any(c.tangential.any() for c in contacts)


def test_what_flies_has_no_contacts():
    model = puck(friction=0.4)
    assert contacts_after(model, model.state({"z": 1.0}))[1] == []


def test_a_contact_is_printed_with_its_numbers():
    model = puck(restitution=0, friction=0.4)
    _, (contact,) = contacts_after(model, model.state(v={"x": 2.0}), steps=1)
    assert contact.pair == "puck ~ floor"
    assert contact.impulse == pytest.approx(G * H, abs=1e-12)
    np.testing.assert_allclose(contact.tangential, [-0.4 * G * H, 0, 0], atol=1e-12)
    assert repr(contact).startswith("ContactImpulse(pair='puck ~ floor', impulse=0.098")


def oblique(**options) -> saltus.Trajectory:
    """Return the run of a puck that hits the floor at 0.1 s, sliding."""
    start = {"q": {"z": 0.1}, "v": {"x": 2.0, "z": -1.0 + G * 0.05}}
    model = puck(restitution=0.5, friction=0.2)
    return saltus.simulate(model, **start, duration=0.2, **options)


def test_an_oblique_impact_takes_its_friction_from_the_momentum_along_the_floor():
    run = oblique()
    (impulse,) = run.impulses
    before, after = run.p[0, 0], run.p[-1, 0]  # nothing else acts along the floor
    np.testing.assert_allclose(impulse["tangential"], [after - before, 0, 0], atol=1e-12)
    assert after - before == pytest.approx(-0.2 * impulse["lambda"], abs=1e-12)


def test_an_impact_can_take_all_of_it_and_no_more():
    model = puck(restitution=0.0, friction=2.0)
    run = saltus.simulate(model, q={"z": 0.1}, v={"x": 0.5, "z": -2.0}, duration=0.2)
    np.testing.assert_allclose(run.impulses["tangential"][0], [-0.5, 0, 0], atol=1e-12)
    assert run.v[-1, 0] == pytest.approx(0, abs=1e-12)


def test_stepper_run_and_batch_tell_of_the_same_friction():
    run = oblique()
    stepper = saltus.Stepper(run.model, h=H)
    state = run.state(0)
    while not stepper.report.impacts:
        state = stepper.advance(state)
    (impact,) = stepper.report.impacts
    assert impact.tangentials.shape == (1, 3)
    np.testing.assert_array_equal(impact.tangentials, run.impulses["tangential"])
    np.testing.assert_array_equal(run.impact(0).tangentials, impact.tangentials)
    assert str(run.impact(0)) == str(impact)
    states = [run.state(0), run.model.state({"z": 5.0})]
    batch = saltus.simulate_batch(run.model, states=states, duration=0.2, progress=False)
    np.testing.assert_array_equal(batch[0].impulses, run.impulses)
    assert batch[1].impulses["tangential"].shape == (0, 3)


def test_a_long_run_keeps_each_friction_with_its_impulse():
    run = saltus.simulate(
        puck(restitution=0.8, friction=0.1), q={"z": 0.5}, v={"x": 5.0}, duration=1.5
    )
    taken = run.impulses["tangential"]
    assert len(taken) > 2
    np.testing.assert_allclose(taken[:, 0], -0.1 * run.impulses["lambda"], atol=1e-12)
    assert not taken[:, 1:].any()
    assert run.p[-1, 0] - run.p[0, 0] == pytest.approx(taken[:, 0].sum(), abs=1e-12)
