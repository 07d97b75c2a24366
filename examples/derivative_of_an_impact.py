"""Two equal balls collide, and the end of the struck one is differentiated by the start of both.

An elastic impact of equal masses exchanges the velocities: the struck ball goes on where the other
would have gone, x_f = x1 + v1 T + 2 r. So d x_f / d (x1, x2, v1, v2) = (1, 0, T, 0), T = 1 s.
"""

import numpy as np

import saltus

builder = saltus.ModelBuilder().set_gravity((0, 0, 0))
for name, x in (("cue", 0.0), ("struck", 0.5)):
    at = saltus.Pose((x, 0, 0))
    builder.add_body(name, saltus.Sphere(0.1), mass=1.0, X=at, joint="prismatic")
stepper = saltus.Stepper(builder.build(), h=1.0, record=True)

start = stepper.model.state(v={"cue": 1.0})
end = stepper.advance(start)
print(f"the struck ball ends at {0.5 + end.q[1]:.3f} m")

A = stepper.derivative().A  # rows: q, p at the end; columns: q, p at the start
print(f"by x1, x2, v1, v2: {np.round(A[1], 12) + 0.0}")

# the gradient of a cost by all of the start at once
gradient = stepper.vjp(q_hat=[0, 1], p_hat=[0, 0])
print(f"the same backwards: {np.round(np.r_[gradient.q, gradient.p], 12) + 0.0}")
