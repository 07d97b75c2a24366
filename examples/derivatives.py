"""All first and second partials of L for a double pendulum, against central differences.

L_vv is the mass matrix, and its last entry the inertia of the lower bob about the elbow:
1 kg (1 m)^2 + 0.001 kg m^2 = 1.001 kg m^2.
"""

import numpy as np

import saltus

model = saltus.load_urdf(saltus.urdf_dir() / "double_pendulum.urdf")
q, v = np.array([0.4, -0.7]), np.array([1.1, 0.3])
L = model.lagrangian(q, v)


def difference(name: str, by: str, step: float = 1e-5) -> np.ndarray:
    """Return the derivative of a partial; its last index counts what it is taken by."""
    columns = []
    for e in step * np.eye(2):
        dq, dv = (e, 0 * e) if by == "q" else (0 * e, e)
        after, before = model.lagrangian(q + dq, v + dv), model.lagrangian(q - dq, v - dv)
        columns.append((getattr(after, name) - getattr(before, name)) / (2 * step))
    return np.stack(columns, axis=-1)


for name, of, by in [
    ("L_q", "value", "q"),
    ("L_v", "value", "v"),
    ("L_qq", "L_q", "q"),
    ("L_vq", "L_v", "q"),  # row: velocity, column: coordinate
    ("L_vv", "L_v", "v"),
]:
    error = abs(getattr(L, name) - difference(of, by)).max()
    print(f"{name:4} {getattr(L, name).round(4).tolist()}: differs by {error:.0e}")
print(f"L_vv[1, 1] = {L.L_vv[1, 1]:.3f} kg m^2")
