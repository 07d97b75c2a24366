"""Where the floor bears a plank: the centre of pressure, and by what a weight on it moves that.

A plank of 2 kg and 1.2 m lies with its middle at x = 0. A cube of 1 kg stands on it 0.3 m to the
right: the floor's impulses act on average at x = 0.3 * 1 / (1 + 2) = 0.1 m. Then the cube is pushed
to the right with 0.5 m/s. Friction (0.3) stops it after 0.5^2 / (2 * 0.3 * 9.81) = 0.042 m, and the
floor bears all 0.042 / 3 = 0.014 m further to the right.
"""

import numpy as np

import saltus

builder = saltus.ModelBuilder("plank").add_half_space("floor", (0, 0, 1))
builder.set_default_contact(restitution=0, friction=0.3)
for name, mass, half, at in (
    ("plank", 2.0, (0.6, 0.2, 0.02), (0, 0, 0.02)),
    ("cube", 1.0, (0.05, 0.05, 0.05), (0.3, 0, 0.09)),
):
    builder.add_link(name, saltus.solid_box(mass, half)).add_shape(name, saltus.Box(half))
    free = saltus.JointType.floating
    builder.add_joint(name, free, parent="world", child=name, X_PJ=saltus.Pose(at))
model = builder.build()
run = saltus.simulate(model, v={"cube_vx": 0.5}, duration=0.5, h=0.01, record_contacts=True)


def pressure_at(row: int) -> float:
    """Return x of the centre of pressure of the floor over the step that ends with a row."""
    contacts = run.contacts[run.contacts["row"] == row]
    floor = contacts[["floor" in run.pair_names[pair] for pair in contacts["pair"]]]
    return float(np.average(floor["point"][:, 0], weights=floor["lambda"]))


print(f"the cube slides {run.poses('cube')[-1, 0, 3] - 0.3:.3f} m")
print(f"the floor bears at the end at x = {pressure_at(len(run) - 1):.3f} m")
