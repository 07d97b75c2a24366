"""A tippe-top turns over: a ball whose centre of mass lies low spins until that is above.

Friction at the floor makes it climb; the spin pays. Whatever the friction is, the angular momentum
along the line from the centre of mass to the contact stays (Jellett's constant, 1872). The midpoint
rule keeps it to h^2: half the step leaves a quarter of the error, 4.0 times less.
"""

import numpy as np

import saltus

radius, below, mass = 0.025, 0.005, 0.015
inertia = 0.4 * mass * radius**2
builder = saltus.ModelBuilder("tippe top").add_floor()
builder.set_default_contact(restitution=0, friction=0.3)
builder.add_link("top", saltus.BodyInertia(mass, (0, 0, -below), np.eye(3) * inertia))
builder.add_joint("free", "floating", parent="world", child="top")
model = builder.add_shape("top", saltus.Sphere(radius)).build()

errors = []
for h in (0.002, 0.001):
    q = model.normalized([0, 0, radius, np.sin(0.05), 0, 0, np.cos(0.05)])
    run = saltus.simulate(model, q=q, v={"free_wz": 150}, duration=2.0, h=h, progress=False)
    axis = model.all_poses(run.q)[:, -1, :3, 2]  # where the top's z points
    line = below * axis - (0, 0, radius)
    constant = inertia * np.sum(run.v[:, 3:] * line, axis=1)
    errors.append(abs(constant / constant[0] - 1).max())

print(f"its axis points up by {axis[0, 2]:.2f} at first, by {axis[-1, 2]:.2f} after 2 s")
print(f"spin {run.v[0, 5]:.0f} rad/s at first, {run.v[-1, 5]:.0f} rad/s at the end")
print(f"error of Jellett's constant: {errors[1]:.1e}, {errors[0] / errors[1]:.1f} times less")
