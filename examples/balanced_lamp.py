"""A lamp that stays wherever it is put: a spring of length 0 bears its weight at every angle.

A lamp of m = 1 kg sits l = 0.5 m along an arm. A spring from b = 0.25 m along the arm to a point
a = 0.4 m above the hinge has V = k a b sin(angle) and a constant, and the weight -m g l sin(angle):
they cancel where k = m g l / (a b) = 49.05 N/m. A push of 0.1 N m over 1 s leaves it turning at
0.1 / (m l^2) = 0.400 rad/s, and nothing slows it down; a spring that is 0.1 m long lets it fall.
"""

import numpy as np

import saltus


def lamp(length=0.0):
    """Return the lamp with a spring of this length, and a push in the first second."""
    builder = saltus.ModelBuilder("lamp")
    builder.add_link("arm", saltus.BodyInertia(1.0, (0.5, 0, 0), np.zeros((3, 3))))
    builder.add_joint("hinge", "revolute", parent="world", child="arm", axis=(0, 1, 0))
    ends = {"a": saltus.At("arm", (0.25, 0, 0)), "b": saltus.At("world", (0, 0, 0.4))}
    return builder.add_spring("spring", **ends, stiffness=49.05, length=length)


model = lamp().build()
angles = np.linspace(-1.5, 1.5, 31)[:, None]
zero = np.zeros((1, 1))
torque = abs(model.inverse_dynamics(angles, zero, zero)).max()
print(f"at 31 angles the greatest torque that holds it is {torque:.0e} N m")

pushed = lamp().add_force("push", lambda now: [0.1 if now.t < 1 else 0.0]).build()
run = saltus.simulate(pushed, duration=5.0, h=0.01)
print(f"pushed, it turns at {run.v[100, 0]:.3f} rad/s, and 4 s later at {run.v[-1, 0]:.3f} rad/s")

falls = saltus.simulate(lamp(length=0.1).build(), q=[0.5], duration=1.0, h=0.01)
print(f"on a spring of 0.1 m it is {abs(falls.q[-1, 0] - 0.5):.2f} rad away after 1 s")
