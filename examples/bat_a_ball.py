"""A bat on a motor hits a ball so that it flies to a target 1 m farther and higher.

Twenty torques are unknown, and the derivative of the flight by them goes through the impact, whose
instant and place move with them. Newton's method meets the target to 1e-12 m in 5 steps.
"""

import numpy as np

import saltus
from saltus import Capsule, Pose, optimize

h, steps, pushes = 0.02, 50, 20

builder = saltus.ModelBuilder("batting")
builder.add_link("bat", saltus.BodyInertia(1.0, (0.4, 0, 0), np.diag([0.01, 0.06, 0.06])))
lying = saltus.rotation_from_rpy(0, np.pi / 2, 0)
builder.add_shape("bat", Capsule(0.04, 0.8), Pose((0.4, 0, 0), lying))
builder.add_joint(
    "shoulder", "revolute", parent="world", child="bat", X_PJ=Pose((0, 0, 1)), axis=(0, -1, 0)
)
builder.add_body("ball", saltus.Sphere(0.05), mass=0.15, X=Pose((0.6, 0, 1.5)), joint="floating")
builder.set_default_contact(restitution=0.9).add_motor("torque", joint="shoulder")
model = builder.build()

torques = np.zeros((steps, 1))
torques[:pushes] = 12.0  # [N m] a guess that hits the ball
unknown = np.zeros((steps, 1, pushes))
unknown[:pushes, 0] = np.eye(pushes)

guess = saltus.simulate(model, duration=steps * h, h=h, control=torques)
goal = {"ball_x": guess.column("ball_x")[-1] - 1, "ball_z": guess.column("ball_z")[-1] + 1}
shot = optimize.shoot(
    model, model.state(), torques, optimize.Reach(model, goal), h=h, by_control=unknown
)
print("misses:", ", ".join(f"{miss:.1e}" for miss in shot.misses), "m")
print(f"below 1e-12 m after {len(shot.misses) - 1} steps: {shot.miss < 1e-12}")
before, after = guess.impacts["t"][0], shot.run().impacts["t"][0]
print(f"the bat meets the ball at {after:.4f} s, at first at {before:.4f} s")
