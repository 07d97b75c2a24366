"""A cart is driven against a wall, and is back at rest 1 s later, with least effort.

The impact is planned, its instant unknown: the guess is that it comes after 0.3 s, of a cart that
does not move. Behind the wall the cart's mirror image would go on, 2 m in 1 s: by symmetry the
impact is at 0.5 s, and of a force that varies freely the effort is 12 m^2 d^2 / T^3 = 192 N^2 s.
In steps it is a little more.
"""

import numpy as np

import saltus
from saltus import optimize

steps, T = 25, 1.0
builder = (
    saltus.ModelBuilder("cart").set_gravity((0, 0, 0)).add_half_space("wall", (-1, 0, 0), -1.1)
)
builder.add_body("cart", saltus.Sphere(0.1), mass=2.0, joint="prismatic")
model = builder.add_motor("force", joint="cart").build()

found = optimize.transcribe(
    model,
    model.state(),
    optimize.Quadratic(model, model.state(), control=1.0),
    np.zeros((steps, 1)),
    h=T / steps,
    impacts=[("cart ~ wall", 0.3)],
    reach=optimize.Reach(model, q={"cart": 0.0}, v={"cart": 0.0}),
    progress=False,
)
run = found.run()
effort = np.sum(found.control**2) * T / steps
print(f"converged: {found.converged}, the cart meets the wall at {run.impacts['t'][0]:.4f} s")
print(f"effort {effort:.2f} N^2 s, of a force that varies freely 192")
print(f"back at rest to 1e-8: {max(abs(run.q[-1, 0]), abs(run.v[-1, 0])) < 1e-8}")
