"""Drop a box on a floor.

It is let go with its lower face 0.5 m up, meets the floor at sqrt(2 * 0.5 / 9.81) = 0.319275 s,
does not bounce, and lies at rest with its centre at half its height.
"""

import saltus

scene = saltus.ModelBuilder().add_floor(restitution=0, friction=0.5)
scene.add_body("box", saltus.Box((0.3, 0.2, 0.1)), mass=1.0, X=saltus.Pose((0, 0, 0.6)))
run = saltus.simulate(scene.build(), duration=1.0)
height = run.poses("box")[:, 2, 3]
print(f"meets the floor at {run.impacts['t'][0]:.6f} s")
print(f"lies at a height of {height[-1]:.6f} m, at rest: {bool(abs(run.v[-1]).max() < 1e-12)}")
