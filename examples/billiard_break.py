"""A billiard break: the cue comes with 5 m/s along the axis of a triangle of 15 balls that touch.

It gets there after 18 radii of 28.575 mm, at 0.102870 s; all 31 contacts (30 in the triangle) make
one impact. Momentum m v = 0.85 kg m/s and energy m v^2 / 2 = 2.125 J are kept to rounding. Which
balls get them hangs on the order of impulses: they do not fly as symmetrically as they lay.
"""

import saltus

model = saltus.load_urdf(saltus.scenes.billiard(), gravity=(0, 0, 0))
run = saltus.simulate(model, v={"x_0": 5.0}, duration=1.0)
along = sum(run.column(f"x_{i}", "p") for i in range(16))
across = sum(run.column(f"y_{i}", "p") for i in range(16))
hit = run.impact(0)
print(f"{len(run.impacts)} impact, at {hit.t:.6f} s: {hit.contacts} contacts")
print(f"momentum at the end {along[-1]:.6f} kg m/s along, {abs(across[-1]):.6f} across")
print(f"energy at the end {run.total[-1]:.6f} J")
