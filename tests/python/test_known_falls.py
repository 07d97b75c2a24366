"""Falls with answers that are known: a block that rocks, a rod that slides and topples, a disc."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from scenes import add_in_the_plane
from scipy.integrate import solve_ivp

import saltus

G = 9.81


def rocking(h: float, duration: float) -> saltus.Trajectory:
    """Return the run of a slender block that is let go at rest, 0.1 rad tilted."""
    builder = add_in_the_plane(saltus.ModelBuilder(), "block", saltus.Box((0.05, 0.1, 0.2)), 1.0)
    builder.add_floor().set_default_contact(restitution=0, friction=2)
    model = builder.build()
    z = 0.2 * np.cos(0.1) + 0.05 * np.sin(0.1)
    return saltus.simulate(model, q={"z": z, "turn": 0.1}, duration=duration, h=h, progress=False)


@pytest.mark.parametrize("h", [0.005, 0.002])
def test_a_rocking_block_against_housner(h):
    """G. Housner, The behavior of inverted pendulum structures, BSSA 53, 1963."""
    radius, slender = np.hypot(0.05, 0.2), np.arctan(0.05 / 0.2)
    p_squared = 3 * G / (4 * radius)

    def fall(_, y):
        return [y[1], -p_squared * np.sin(slender - y[0])]

    def lands(_, y):
        return y[0]

    lands.terminal = True
    quarter = solve_ivp(fall, (0, 1), [0.1, 0], events=lands, rtol=1e-10, atol=1e-12)
    run = rocking(h, 2.0)
    assert len(run.fallbacks) == 0
    turn, rate = run.q[:, -1], run.v[:, -1]
    first = run.impacts["t"][0]
    assert first == pytest.approx(quarter.t_events[0][0], rel=2e-3)
    # each landing leaves this part of the rate: it turns about the other edge from there on
    part = 1 - 1.5 * np.sin(slender) ** 2
    landings = np.flatnonzero(turn[:-1] * turn[1:] < 0)
    assert len(landings) >= 3
    peaks = [np.abs(rate[a + 1 : b]).max() for a, b in pairwise(landings)]
    before = np.abs(rate[: landings[0]]).max()
    for peak in peaks[:3]:
        assert peak / before == pytest.approx(part, rel=10 * h)  # of rows h apart
        before = peak
    assert (np.diff(run.total) < 1e-4).all()


def test_a_rod_that_slides_and_topples():
    """Without friction its middle falls straight down, whatever its end does."""
    builder = saltus.ModelBuilder().add_floor().set_default_contact(restitution=0, friction=0)
    add_in_the_plane(builder, "rod", saltus.Capsule(0.01, 0.5), 1.0)
    model = builder.build()
    tilt = 0.1
    z = 0.01 + 0.5 * np.cos(tilt)
    run = saltus.simulate(model, q={"z": z, "turn": tilt}, duration=0.8, h=0.005, progress=False)
    np.testing.assert_allclose(run.q[:, 0], 0, atol=1e-10)
    down = run.t < run.impacts["t"][0]
    np.testing.assert_allclose(run.q[down, 1], 0.01 + 0.5 * np.cos(run.q[down, 2]), atol=1e-8)
    assert np.ptp(run.total[down]) < 1e-3 * run.kinetic.max()
    assert abs(run.q[-1, 2]) == pytest.approx(np.pi / 2, abs=1e-6)
    assert (np.diff(run.total) < 1e-3).all()


def test_a_disc_that_spins_down_gains_nothing():
    """Euler's disc: it rolls round on its rim, ever flatter, and comes to rest."""
    builder = saltus.ModelBuilder().add_floor().set_default_contact(restitution=0, friction=0.8)
    radius, half, tilt = 0.04, 0.005, 0.25
    builder.add_body("disc", saltus.Cylinder(radius, half), mass=0.4, joint_name="free")
    model = builder.build()
    # rolls without slip: its middle still, it turns about the diameter through the contact
    z = half * np.cos(tilt) + radius * np.sin(tilt)
    q = model.normalized([0, 0, z, np.sin(tilt / 2), 0, 0, np.cos(tilt / 2)])
    inertia = 0.4 * (radius**2 / 4 + (2 * half) ** 2 / 12)
    rate = np.sqrt(0.4 * G * radius / inertia / np.sin(tilt)) * np.sin(tilt)
    v = [0, 0, 0, 0, -rate * np.cos(tilt), -rate * np.sin(tilt)]
    run = saltus.simulate(model, q=q, v=v, duration=1.0, h=0.001, progress=False)
    rise = (run.total - np.minimum.accumulate(run.total)).max()
    assert rise < 2e-3 * run.kinetic.max()
    assert min(model.gaps(q).phi.min() for q in run.q[::10]) > -1e-9
    assert run.total[-1] < run.total[0]
