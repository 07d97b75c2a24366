"""A tower of four boxes of 1 kg, and what its contacts bear: m g times the boxes above.

The floor bears 4 * 9.81 = 39.24 N, the topmost box 9.81 N. Then the lowest box is hit with 0.5 m/s:
friction (0.5) takes its 0.125 J within a few hundredths of a second, and the tower stands again.
"""

import saltus

builder = saltus.ModelBuilder("tower").add_half_space("floor", (0, 0, 1))
builder.set_default_contact(restitution=0, friction=0.5)
half = (0.2, 0.15, 0.1)
for i in range(4):
    builder.add_link(f"box_{i}", saltus.solid_box(1.0, half))
    builder.add_shape(f"box_{i}", saltus.Box(half))
    at = saltus.Pose((0, 0, 0.1 + 0.2 * i))
    builder.add_joint(
        f"box_{i}", saltus.JointType.floating, parent="world", child=f"box_{i}", X_PJ=at
    )
model = builder.build()

stepper = saltus.Stepper(model, h=0.01)
stepper.advance(model.state())
contacts = stepper.report.contacts
for name in ("floor", "box_3"):
    force = sum(c.impulse for c in contacts if name in c.pair) / stepper.options.h
    print(f"the contacts of {name} bear {force:.3f} N")

run = saltus.simulate(model, v={"box_0_vx": 0.5}, duration=1.0, h=0.01)
print(f"energy lost: {run.total[0] - run.total[-1]:.3f} J")
print(f"the fastest box at the end moves with less than 1e-9 m/s: {abs(run.v[-1]).max() < 1e-9}")
