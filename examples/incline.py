"""A block with friction 0.5 on slopes: it stays where tan(angle) < 0.5, and slides elsewhere.

It slides with g (sin(angle) - 0.5 cos(angle)): 1.608844 m/s after 1 s on the slope of 35 degrees.
"""

from math import cos, radians, sin, tan

import numpy as np

import saltus

MU, G = 0.5, 9.81


def block_on_slope(degrees):
    """Return a box on a floor; it is gravity that is tilted, so that x is down the slope."""
    angle, half = radians(degrees), (0.2, 0.15, 0.1)
    builder = saltus.ModelBuilder("block").set_gravity((G * sin(angle), 0, -G * cos(angle)))
    builder.add_link("block", saltus.solid_box(1.0, half)).add_shape("block", saltus.Box(half))
    builder.add_joint("at", saltus.JointType.floating, parent="world", child="block")
    builder.add_half_space("floor", (0, 0, 1), -half[2])
    return builder.set_default_contact(restitution=0, friction=MU).build()


for degrees in (15, 25, 30, 35):
    run = saltus.simulate(block_on_slope(degrees), duration=1.0)
    way, speed = run.q[-1, 0], run.v[-1, 0]
    what = "stays" if abs(way) < 1e-12 else f"slides {way:.6f} m, speed {speed:.6f} m/s"
    print(f"{degrees} degrees, slope {tan(radians(degrees)):.3f}: {what}")
    a = max(0.0, G * (sin(radians(degrees)) - MU * cos(radians(degrees))))
    assert np.allclose([way, speed], [a / 2, a], atol=1e-10)
