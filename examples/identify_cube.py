"""Friction and restitution of a cube from eight tosses, by the exact gradient of their misfit.

The tosses stand for recorded ones: of a cube whose friction is 0.18 and whose restitution 0.125.
The search begins elsewhere and finds both again, without a finite difference and without a grid.
"""

import numpy as np
from scipy.optimize import minimize

import saltus

H, EDGE = 1 / 148, 0.1048  # s, m
UNITS = np.repeat([EDGE, 1], 3)  # of errors


def tosses(friction, restitution):
    builder = saltus.ModelBuilder().add_floor(friction=friction, restitution=restitution)
    builder.add_body("cube", saltus.Box((EDGE / 2,) * 3), mass=0.37, joint="floating")
    model, random = builder.build(), np.random.default_rng(1)
    for turn, push, spin in random.normal(size=(8, 3, 4)):
        q = model.normalized([0, 0, 0.15, *turn])
        v = [*push[:3] / 2, *3 * spin[:3]]
        yield saltus.simulate(model, q, v, duration=24 * H, h=H, progress=False)


def misfit(x):
    cost, slope = 0.0, np.zeros(2)
    for run, seen in zip(tosses(*x), recorded, strict=True):
        off = np.array(list(map(run.model.difference, seen.q, run.q))) / UNITS
        gradient = run.gradient(off / UNITS, np.zeros_like(off))
        cost += np.sum(off**2) / 2
        slope += sum(gradient.friction.values()), sum(gradient.restitution.values())
    return cost, slope


recorded = list(tosses(0.18, 0.125))
found = minimize(misfit, [0.3, 0.3], jac=True, bounds=[(0.01, 1)] * 2, options={"ftol": 1e-15})
print(f"friction {found.x[0]:.4f}, restitution {found.x[1]:.4f}")
print(f"fewer than 30 runs of each toss: {found.nfev < 30}")
