"""The paper's Fig. 3: velocities of the outer balls of a cradle, with sketches, in fig3.png.

Each ball passes the lowest point with sqrt(2 g (1 - cos 0.3) / I) = 0.9356 m/s, where I = 1.001
kg m^2 about the pivot; the ball in the middle does not move.
"""

import saltus

model = saltus.load_urdf(saltus.urdf_dir() / "newtons_cradle_3.urdf")
run = saltus.simulate(model, q={"swing_0": 0.3}, duration=4.0, h=0.001)
run.plot("fig3.png", times=[0.0, 1.0, 1.515, 2.02, 3.03, 3.53])
print(f"the right ball reaches {abs(run.column('swing_2', 'v')).max():.4f} m/s")
print(f"the middle ball moves by {abs(run.column('swing_1')).max():.0g} rad")
