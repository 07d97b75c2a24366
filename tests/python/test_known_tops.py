"""What spins, with known answers: a top that turns over, a coin that rolls round and falls."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import saltus

G = 9.81
UP = np.array([0.0, 0.0, 1.0])


def axis_of(q):
    """Return where the body's z points, (..., 3), by its quaternion in q[..., 3:7]."""
    x, y, z, w = np.moveaxis(q[..., 3:7], -1, 0)
    return np.stack([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)], axis=-1)


RADIUS, OFF, MASS = 0.025, 0.005, 0.015
INERTIA = 0.4 * MASS * RADIUS**2


def tippe_top(h: float, duration: float) -> saltus.Trajectory:
    """Return the run of a ball that spins on the floor, its centre of mass below its middle."""
    builder = saltus.ModelBuilder().add_floor().set_default_contact(restitution=0, friction=0.3)
    builder.add_link("top", saltus.BodyInertia(MASS, (0, 0, -OFF), np.eye(3) * INERTIA))
    builder.add_joint("free", "floating", parent="world", child="top")
    model = builder.add_shape("top", saltus.Sphere(RADIUS)).build()
    q = model.normalized([0, 0, RADIUS, np.sin(0.05), 0, 0, np.cos(0.05)])
    return saltus.simulate(model, q=q, v={"free_wz": 150}, duration=duration, h=h, progress=False)


def jellett(run: saltus.Trajectory) -> np.ndarray:
    """Return the angular momentum along the line from the centre of mass to the contact."""
    line = OFF * axis_of(run.q) - RADIUS * UP
    return INERTIA * np.sum(run.v[:, 3:] * line, axis=1)


def test_a_tippe_top_turns_over_and_keeps_jelletts_constant():
    """J. H. Jellett, A treatise on the theory of friction, 1872: whatever friction does."""
    drifts = []
    for h in (0.002, 0.001):
        run = tippe_top(h, 2.0)
        assert len(run.fallbacks) == 0
        constant = jellett(run)
        drifts.append(np.abs(constant / constant[0] - 1).max())
        tilt = axis_of(run.q)[:, 2]
        assert tilt[0] > 0.99
        assert tilt[-1] < -0.9  # upside down
        # friction lifts the centre of mass out of the spin
        assert run.potential[-1] - run.potential[0] == pytest.approx(
            MASS * G * OFF * (tilt[0] - tilt[-1]), rel=1e-6
        )
        rise = (run.total - np.minimum.accumulate(run.total)).max()
        assert rise < 5e-6 * run.total[0]  # the swing of a step, of order h^2
    assert drifts[0] / drifts[1] == pytest.approx(4, rel=0.02)
    assert drifts[1] < 3e-4


def rolling_disc(n, w, radius: float, duration: float) -> np.ndarray:
    """Return the axis of a thin disc of 1 kg that rolls without slip, by its own equation.

    About the contact: I w' + w x I w = -a u x (v' + g z), v = w x a u, u from the contact to the
    middle.
    """
    across, along = radius**2 / 4, radius**2 / 2

    def rates(_, y):
        n, w = y[:3], y[3:]
        sine = np.hypot(n[0], n[1])
        u = (UP - n[2] * n) / sine
        turn = np.cross(w, n)
        change = -turn[2] * n - n[2] * turn
        change = (change - u * (u @ change)) / sine

        def inertia(x):
            return across * x + (along - across) * (n @ x) * n

        arm = radius * u
        columns = [inertia(e) + np.cross(arm, np.cross(e, arm)) for e in np.eye(3)]
        pull = np.cross(w, radius * change) + G * UP
        moment = -np.cross(w, inertia(w)) - np.cross(arm, pull)
        return [*turn, *np.linalg.solve(np.stack(columns, axis=1), moment)]

    return solve_ivp(rates, (0, duration), [*n, *w], rtol=1e-11, atol=1e-13).y[:3, -1]


def coin(half: float) -> saltus.Model:
    """Return a coin that does not slip."""
    builder = saltus.ModelBuilder().add_floor().set_default_contact(restitution=0, friction=20)
    shape = saltus.Cylinder(0.1, half)
    return builder.add_body("coin", shape, mass=1.0, joint_name="free").build()


@pytest.mark.parametrize("kind", ["spins", "rolls"])
def test_a_coin_that_spins_or_rolls_falls_as_its_equation_says(kind):
    """Spun about its diameter, or rolling: so slowly that it falls, by order h^2."""
    half, tilt = 1e-7, np.pi / 2 - 0.1
    n, u = (np.array([np.sin(tilt), 0, np.cos(tilt)]), np.array([-np.cos(tilt), 0, np.sin(tilt)]))
    w = np.array([0, 0, 8.0]) if kind == "spins" else 5 * n
    expected = rolling_disc(n, w, 0.1, 0.4)
    model, errors = coin(half), []
    z = half * np.cos(tilt) + 0.1 * np.sin(tilt)
    q = model.normalized([0, 0, z, 0, np.sin(tilt / 2), 0, np.cos(tilt / 2)])
    for h in (0.004, 0.002):
        v = [*np.cross(w, 0.1 * u), *w]
        run = saltus.simulate(model, q=q, v=v, duration=0.4, h=h, progress=False)
        assert len(run.fallbacks) == 0
        errors.append(np.abs(axis_of(run.q[-1]) - expected).max())
    assert abs(expected[2] - n[2]) > 0.05  # it has fallen
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.1)
    assert errors[1] < 2e-4
