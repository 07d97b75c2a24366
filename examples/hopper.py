"""A hopper on one leg travels by a gait that repeats: its foot lands without rebound and sticks.

A spring is in the leg, a motor thrusts, a servo swings the hip, alike in each stride; a slide keeps
the body upright. Newton's method on the exact derivative of a stride, through landing, stance and
take-off, closes the orbit to 1e-10. Over a stride the floor bears the weight of what moves up and
down: 9 kg times 9.81 m/s^2 are 88.290 N.
"""

import numpy as np

import saltus
from saltus import BodyInertia, optimize

builder = saltus.ModelBuilder("hopper").add_half_space("floor", (0, 0, 1))
for link, mass, joint, kind, parent, axis in (
    ("slide", 0.1, "x", "prismatic", "world", (1, 0, 0)),
    ("body", 8.0, "z", "prismatic", "slide", (0, 0, 1)),
    ("thigh", 0.5, "hip", "revolute", "body", (0, -1, 0)),
    ("foot", 0.5, "leg", "prismatic", "thigh", (0, 0, -1)),
):
    builder.add_link(link, BodyInertia(mass, (0, 0, 0), 0.01 * np.eye(3)))
    builder.add_joint(joint, kind, parent=parent, child=link, axis=axis)
builder.add_shape("foot", saltus.Sphere(0.04)).add_joint_spring("leg", stiffness=4000, rest=0.6)
builder.set_damping("leg", 60).set_default_contact(restitution=0, friction=1)
builder.add_position_servo("swing", joint="hip", kp=100, kd=20).add_motor("thrust", joint="leg")
model = builder.build()

controls = np.zeros((90, 2))  # of a stride of 0.45 s
controls[:, 0] = 0.3  # [rad] the hip swings the leg forward in flight,
controls[12:70, 0] = -0.3  # back in stance
controls[60:78, 1] = 200  # [N] before take-off
guess = model.state({"z": 0.7, "leg": 0.6, "hip": 0.3}, {"x": 0.5})
gait = optimize.orbit(model, guess, controls, h=0.005, free=["x"], settle=4, progress=False)
run = gait.run(record_contacts=True)
bears = run.contacts["lambda"].sum() / run.t[-1]
print(f"closed to 1e-10: {gait.miss < 1e-10}, a stride of {gait.travel[0]:.4f} m")
print(f"largest Floquet multiplier: {abs(gait.multipliers[0]):.4f}")
print(f"{len(run.impacts)} landing; the floor bears {bears:.3f} N on average")
