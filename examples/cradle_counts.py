"""Newton's cradles of 3 and 5 balls: as many balls leave as came.

With n of N balls up, the first impact takes n (N - n) impulses, and after half a period, pi
sqrt(I/g) = 1.004 s a little lengthened by the swing, n balls stand high on the other side while the
rest hang still.
"""

import saltus

for balls in (3, 5):
    model = saltus.load_urdf(saltus.urdf_dir() / f"newtons_cradle_{balls}.urdf")
    for up in range(1, min(balls, 4)):
        start = {f"swing_{i}": 0.3 for i in range(up)}
        run = saltus.simulate(model, q=start, duration=1.01)
        high = sum(run.column(f"swing_{i}")[-1] < -0.29 for i in range(balls))
        still = sum(abs(run.column(f"swing_{i}")[-1]) < 1e-12 for i in range(balls))
        impulses = len(run.impact(0).pairs)
        print(f"{balls} balls, {up} up: {high} left, {still} still, {impulses} impulses")
