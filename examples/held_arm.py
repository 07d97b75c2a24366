"""An arm whose motors bear its weight stays where it is; one whose joints are dry does so alone.

Gravity asks 19.62 N m of the shoulder. Motors that are told so, and friction of 40 N m, hold it:
neither moves by a bit in 10 s.
"""

import saltus


def arm(friction=0.0):
    """Return two rods of 2 kg and 0.5 m, level, with motors."""
    builder = saltus.ModelBuilder("arm")
    parent, at = "world", 0.0
    rod = saltus.solid_cylinder(2.0, 0.02, 0.25).seen_from(saltus.Pose((0.25, 0, 0)))
    for name in ("shoulder", "elbow"):
        builder.add_link(name, rod)
        builder.add_joint(
            name,
            "revolute",
            parent=parent,
            child=name,
            axis=(0, 1, 0),
            X_PJ=saltus.Pose((at, 0, 0)),
        )
        builder.add_motor(name, joint=name).set_friction(name, friction)
        parent, at = name, 0.5
    return builder.build()


model = arm()
weight = -model.gravity_forces(model.neutral())
print(f"the shoulder bears {abs(weight[0]):.2f} N m, the elbow {abs(weight[1]):.2f} N m")
held = saltus.simulate(model, duration=10.0, control=weight)
print(f"held by motors it drifts by {abs(held.q).max():.1e} rad")
stuck = saltus.simulate(arm(friction=40.0), duration=10.0)
print(f"held by friction it drifts by {abs(stuck.q).max():.1e} rad")
