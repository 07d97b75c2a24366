"""A quadruped stands on a floor for 2 s, its knees locked, and a parcel lies on its trunk.

Nothing moves: four feet bear 12 kg, four corners of the parcel 2 kg. The floor is given no
friction: it stands as a table does on ice. In stands_up.py it has servos.
"""

import saltus

model = saltus.load_urdf(saltus.urdf_dir() / "quadruped.urdf")
stepper = saltus.Stepper(model, h=0.01)
start = state = model.state()
for _ in range(200):
    state = stepper.advance(state)
print(f"drift in {state.t:.0f} s: {abs(state.q - start.q).max():.0e}")
print(f"contacts held: {stepper.report.sustained}")
