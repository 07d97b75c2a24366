"""A box that falls 0.5 m onto one of its edges, tilted by 0.3 rad.

Both corners of the edge touch at sqrt(2 d / g) = 0.319275 s. In the plane they are one contact, so
that one of them takes the whole impulse. It acts beside the centre of mass: the box turns and hops
on, on other corners, and keeps its energy to rounding.
"""

from math import cos, sin

import saltus

d, tilt = 0.5, 0.3
model = saltus.load_urdf(saltus.urdf_dir() / "box_on_edge.urdf")
start = {"slide_z": 0.2 * sin(tilt) + 0.1 * cos(tilt) + d, "turn": tilt}
run = saltus.simulate(model, q=start, duration=3.0)
first = run.impact(0)
print(f"first impact at {first.t:.6f} s, contacts {first.contacts}: {', '.join(first.pairs)}")
print(f"{len(run.impacts)} impacts, energy error {run.energy_error:.0e} J")
