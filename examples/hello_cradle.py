"""A Newton's cradle of three balls, the first let go at 0.3 rad.

The first impact is at sqrt(I/g) K(sin 0.15) = 0.50460 s, I = 1.001 kg m^2 about the pivot.
"""

from pathlib import Path

import saltus

model = saltus.load_urdf(Path(__file__).parents[1] / "urdf" / "newtons_cradle_3.urdf")
run = saltus.simulate(model, q={"swing_0": 0.3}, duration=10.0, h=0.001)
print(f"first impact at {run.impacts['t'][0]:.5f} s")
print(f"{len(run.impacts)} impacts, energy error {run.energy_error:.1e}")
