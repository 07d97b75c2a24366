"""A ball falls 1 m onto the floor and bounces for 10 s without loss.

Impact k is at (2 k + 1) sqrt(2 h / g), so the last of 11 is at 9.481996 s. The midpoint rule is
exact in free fall: times and height are kept to rounding.
"""

from math import sqrt

import numpy as np

import saltus

model = saltus.load_urdf(saltus.urdf_dir() / "bouncing_ball.urdf")
run = saltus.simulate(model, q={"height": 0.1 + 1.0}, duration=10.0)
times = run.impacts["t"]
exact = (2 * np.arange(len(times)) + 1) * sqrt(2 * 1.0 / 9.81)
print(f"{len(times)} impacts, the last at {times[-1]:.6f} s")
print(f"greatest error of a time: {abs(times - exact).max():.0e} s")
print(f"energy error: {run.energy_error:.0e}")
