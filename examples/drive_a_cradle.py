"""A cradle of three touching balls: a motor lifts the first, so that the last leaves with 1 m/s.

The motor pulls for 0.4 s with one torque, the unknown; the ball comes back and hits. Through two
impulses at one instant the speed of the last ball, counted from its energy, has an exact derivative
by that torque, and Newton's method finds it: 2.6743 N m.
"""

import numpy as np

import saltus
from saltus import optimize

h, steps = 0.02, 65
builder = saltus.load_urdf(saltus.scenes.cradle(3, sways=False)).builder()
model = builder.add_motor("pull", joint="swing_0").build()
inertia, weight, length = model.mass_matrix(model.neutral())[2, 2], 9.81, 1.0


def too_fast(q: np.ndarray, v: np.ndarray) -> tuple[float, np.ndarray]:
    """Return the last ball's speed at the bottom less 1 m/s, and its derivative by q and v."""
    speed = np.sqrt(v[2] ** 2 + 2 * weight * length * (1 - np.cos(q[2])) / inertia)
    slopes = np.zeros((1, 6))
    slopes[0, 2] = weight * length * np.sin(q[2]) / inertia / speed
    slopes[0, 5] = v[2] / speed
    return length * speed - 1.0, length * slopes


pull = np.zeros((steps, 1))
pull[:20] = 1.0
shot = optimize.shoot(model, model.state(), 2 * pull, too_fast, h=h, by_control=pull)

print("misses:", ", ".join(f"{miss:.1e}" for miss in shot.misses), "m/s")
print(f"the motor pulls with {2 + shot.x[0]:.4f} N m: miss below 1e-10: {shot.miss < 1e-10}")
left = abs(model.velocity(shot.states[-1])[:2]).max()
print(f"the others rest, to 1e-10 rad/s: {left < 1e-10}")
hit = next(k for k, each in enumerate(shot.smoothness) if each.name != "smooth")
print(f"step {hit} has the impact: {shot.smoothness[hit].name}, two balls touched at rest")
