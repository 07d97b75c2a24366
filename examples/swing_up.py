"""An acrobot, driven at its elbow alone, swings up and stands still upside down after 4 s.

iLQR finds a way up, Newton's method the least effort: its decrements converge quadratically (how
small the last ones are depends on the processor's rounding). To end upright to 1e-8, each plan
aims off by what the one before missed.
"""

import numpy as np

import saltus
from saltus import optimize

h, steps = 0.05, 80
builder = saltus.ModelBuilder("acrobot")
for name, joint, parent, z in (
    ("upper", "shoulder", "world", 0),
    ("lower", "elbow", "upper", -1),
):
    builder.add_link(name, saltus.BodyInertia(1.0, (0, 0, -0.5), np.eye(3) / 12))
    X_PJ = saltus.Pose((0, 0, z))
    builder.add_joint(joint, "revolute", parent=parent, child=name, X_PJ=X_PJ, axis=(0, 1, 0))
model = builder.add_motor("motor", joint="elbow").build()
start, up = model.state(), np.array([np.pi, 0, 0, 0])  # q, v

aim, u, decrements = up.copy(), np.ones((steps, 1)), []
for weight, tolerance in [(10, 1e-2), (100, 1e-4), *[(1e3, 1e-15)] * 7]:
    goal = model.state(aim[:2], aim[2:])
    cost = optimize.Quadratic(model, goal, control=0.01, final_q=weight, final_v=weight)
    newton = weight > 10
    plan = optimize.ilqr(
        model, start, cost, u, h=h, tolerance=tolerance, second_order=newton, progress=False
    )
    u = plan.control
    miss = np.concatenate([plan.q[-1], plan.v[-1]]) - up
    aim -= miss if weight == 1e3 else 0
    decrements = max(decrements, plan.decrements[-3:], key=len) if weight == 1e3 else []
print(f"upside down, at rest: |x - x*| below 1e-8: {abs(miss).max() < 1e-8}")
orders = np.log(decrements[1:]) / np.log(decrements[:-1])
small = (np.array(decrements) < (1e-4, 1e-8, 1e-15)).all()
print(f"last decrements below 1e-4, 1e-8, 1e-15: {small}, quadratic: {orders.min() > 1.5}")
