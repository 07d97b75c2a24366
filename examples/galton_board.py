"""A Galton board of 200 pins: no way through the pins adds or takes energy.

So a ball that has left the board is as fast as one that fell freely, v^2 = 2 g (height lost),
whichever and however many pins it hit: 5 balls, and the greatest difference is rounding. The way
of a ball is chaotic, it hangs on the last bit; but after 60 s they have all left.
"""

import numpy as np

import saltus

balls = range(5)
model = saltus.load_urdf(saltus.scenes.galton(balls=len(balls)))
run = saltus.simulate(model, duration=60.0)
fall = np.array([-run.column(f"z_{i}")[-1] for i in balls])
v = np.array([[run.column(f"{axis}_{i}", "v")[-1] for axis in "xz"] for i in balls])
error = abs((v**2).sum(axis=1) / (2 * 9.81 * fall) - 1).max()
print(f"{model.n_pairs} pairs: 5 balls with 200 pins and 2 walls each")
print(f"{(fall > 21 * 0.05).sum()} balls below the pins")
print(f"v^2 / (2 g height) differs from 1 by less than {np.ceil(error / 1e-11) * 1e-11:.0e}")
