"""A slider-crank hits a wall: one freedom, so an elastic impact turns its motion round exactly.

The crank is carried by the world, the rod by the crank, and a loop keeps the slider on its line.
After the impact all goes back the way it came, as a film that is run backwards.
"""

import numpy as np

import saltus
from saltus import At, BodyInertia, Pose

builder = saltus.ModelBuilder("slider-crank").set_gravity((0, -9.81, 0))
parent, at = "world", 0.0
for name, mass, length in (("crank", 1.0, 0.3), ("rod", 2.0, 1.0)):
    about_centre = np.diag([0, mass * length**2 / 12, mass * length**2 / 12])
    builder.add_link(name, BodyInertia(mass, (length / 2, 0, 0), about_centre))
    pose = Pose((at, 0, 0))
    builder.add_joint(name, "revolute", parent=parent, child=name, axis=(0, 0, 1), X_PJ=pose)
    parent, at = name, length
builder.add_link("slider", BodyInertia(1.5, (0, 0, 0), np.zeros((3, 3))))
builder.add_joint("pin", "fixed", parent="rod", child="slider", X_PJ=Pose((1, 0, 0)))
builder.add_shape("slider", saltus.Box((0.1, 0.1, 0.1)))
builder.add_half_space("wall", (-1, 0, 0), -1.3)
upwards = saltus.rotation_from_rpy(-np.pi / 2, 0, 0)  # z of the end on the world is y
builder.add_loop("guide", "on_plane", a=At("slider"), b=At("world", R=upwards))
model = builder.set_default_contact(restitution=1.0).build()

state = saltus.close_loops(model, q={"crank": 2.2, "rod": -2.4}, v={"crank": -5.0}, keep=["crank"])
run = saltus.simulate(model, state=state, duration=1.2, h=0.001)
t = run.impacts["t"][0]
there, back = (
    run.q[int(1000 * t) - 200, 0],
    np.interp(2 * t - (int(1000 * t) - 200) / 1000, run.t, run.q[:, 0]),
)
print(f"impact at {t:.4f} s")
print(f"0.2 s before it the crank stands at {there:.4f} rad, 0.2 s after it at {back:.4f} rad")
open_by = max(abs(model.loop_gaps(q)["guide"][0]) for q in run.q)
print(f"the guide is open by {open_by:.0e} m at most")
