"""A hundred pendulums let go at 0.03 to 3 rad, all in one batch: how the period grows.

The theory is T = 4 sqrt(I / (m g l)) K(sin(q0 / 2)), with I = 1.004 kg m^2. Each starts from rest,
so that it is at its lowest after a quarter of its period: where swing changes its sign. The error
of the step, O(h^2), is 3e-6 s at h = 0.001.
"""

from math import cos, pi, sqrt

import numpy as np

import saltus


def agm(a: float, b: float) -> float:
    """Return the arithmetic-geometric mean."""
    while abs(a - b) > 1e-15:
        a, b = (a + b) / 2, sqrt(a * b)
    return a


angles = np.linspace(0.03, 3.0, 100)
model = saltus.load_urdf(saltus.urdf_dir() / "pendulum_and_wall.urdf")
batch = saltus.simulate_batch(model, q={"swing": angles}, duration=2.0, h=0.001, collisions=False)
swing, rate = batch.column("swing"), batch.column("swing", of="v")
last = (swing > 0).argmin(axis=1) - 1  # the row before the sign changes
runs = np.arange(100)
quarter = batch.t[last] - swing[runs, last] / rate[runs, last]
exact = sqrt(1.004 / 9.81) * pi / 2 / np.array([agm(1, cos(q0 / 2)) for q0 in angles])
print(f"at {angles[0]:.2f} rad {4 * quarter[0]:.5f} s, predicted {4 * exact[0]:.5f} s")
print(f"at {angles[-1]:.2f} rad {4 * quarter[-1]:.5f} s, predicted {4 * exact[-1]:.5f} s")
print(f"100 periods, greatest difference from theory {4 * abs(quarter - exact).max():.0e} s")
