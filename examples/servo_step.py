"""A cart of 2 kg on a critically damped servo follows its target as 1 - (1 + w t) exp(-w t).

kp = 200 N/m and kd = 40 N s/m make w = 10 1/s: after 0.3 s it has gone 0.800852 of the way.
"""

from math import exp

import saltus

builder = saltus.ModelBuilder("cart")
builder.add_body("cart", saltus.Box((0.1, 0.1, 0.1)), mass=2.0, joint="prismatic")
builder.add_position_servo("x", joint="cart", kp=200.0, kd=40.0)

run = saltus.simulate(builder.build(), duration=0.3, h=0.001, control={"x": 1.0})
exact = 1 - (1 + 3) * exp(-3)
print(f"after {run.t[-1]:.1f} s at {run.q[-1, 0]:.4f} of the way, exactly {exact:.6f}")
balance = run.total - run.total[0] - run.work["x"]
print(f"energy is the work of the servo, to 1e-12 J: {abs(balance).max() < 1e-12}")
