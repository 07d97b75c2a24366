"""An arm of two rods reaches for a point with Newton's method, and is held still there.

The rods, 0.4 m and 0.3 m long, make a triangle of 3, 4 and 5 with a point at the shoulder's height
0.5 m away, so the elbow is at a right angle, pi/2 = 1.570796. Their centres are 0.16 m and 0.41 m
from the shoulder then: it holds g (4 * 0.16 + 3 * 0.41) = 18.3447 N m, the elbow g * 3 * 0.09.
"""

import numpy as np

import saltus

TIP, TARGET = (0.3, 0.0, 0.0), np.array((0.5, 0.0, 0.0))

arm = saltus.ModelBuilder("arm")
for name, parent, start, length, mass in [
    ("upper", "world", 0.0, 0.4, 4.0),
    ("lower", "upper", 0.4, 0.3, 3.0),
]:
    inertia = mass * length**2 / 12 * np.diag((0, 1, 1))
    arm.add_link(name, saltus.BodyInertia(mass, (length / 2, 0, 0), inertia))
    place = saltus.Pose((start, 0, 0))
    arm.add_joint(f"to_{name}", "revolute", parent=parent, child=name, X_PJ=place, axis=(0, -1, 0))
model = arm.build()
print(model)

frames, q = model.at(), np.array((-0.3, 1.0))
for _ in range(8):
    error = frames.set(q).pose("lower") * TIP - TARGET
    q = q - np.linalg.solve(frames.jacobian("lower", TIP)[[0, 2]], error[[0, 2]])
print(f"elbow at {q[1]:.6f} rad, tip {np.abs(error).max():.0e} m away")

hold = -model.gravity_forces(q)
print(f"held by {hold[0]:.4f} N m at the shoulder and {hold[1]:.4f} N m at the elbow")
a = model.accelerations(q, None, hold)
print(f"accelerations less than 1e-12 rad/s^2: {bool(np.abs(a).max() < 1e-12)}")
