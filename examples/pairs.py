"""One picture per pair of shapes that has a gap, in pairs.png.

Whatever the shapes: moved along their normal n by s, they are s farther apart. So all 27 pairs are
brought to a gap of 0.4 m in one move, to rounding.
"""

import numpy as np

import saltus
from saltus.plots import plot_gaps

GEM = [(0.5, 0.1, 0.1), (-0.2, 0.45, 0.15), (-0.35, -0.4, 0.1), (0.1, 0.1, 0.6), (0, 0, -0.45)]
# Of each kind a shape, and how it is turned (roll, pitch, yaw) where it is the upper of two, and
# where it is the lower.
SHAPES = {
    "sphere": (saltus.Sphere(0.45), (0, 0, 0), (0, 0, 0)),
    "capsule": (saltus.Capsule(0.25, 0.45), (0.3, 0.9, 0), (1.5, 0, 0.9)),
    "ellipsoid": (saltus.Ellipsoid((0.65, 0.4, 0.28)), (0.2, 0.7, 0.2), (0, -0.3, 0.4)),
    "convex": (saltus.Convex(GEM), (0, 0.2, 0.5), (0.2, -0.2, 0.3)),
    "cylinder": (saltus.Cylinder(0.35, 0.4), (0.4, 0.7, 0), (1.5, 0, 0.9)),
    "box": (saltus.Box((0.45, 0.35, 0.3)), (0.5, 0.6, 0.4), (0, 0.1, 0.6)),
    "half_space": (saltus.HalfSpace(), (0, 0, 0), (0, 0, 0.5)),
}
KINDS = list(SHAPES)  # the upper one of a pair comes first

pairs = []
for kinds in sorted((sorted(row, key=KINDS.index) for row in saltus.gap_table()), key=str):
    (a, turned, _), (b, _, lies) = (SHAPES[kind] for kind in kinds)
    X_WB = saltus.Pose((0, 0, 0), saltus.rotation_from_rpy(*lies))
    R = saltus.rotation_from_rpy(*turned)
    above = saltus.Pose((0.05, 0.1, 2.5), R)
    gap = saltus.gap(a, above, b, X_WB)
    near = saltus.Pose(above.p + (0.4 - gap.phi) * gap.n_W, R)
    pairs.append((a, near, b, X_WB))
error = max(abs(saltus.gap(*pair).phi - 0.4) for pair in pairs)
plot_gaps(pairs, "pairs.png")
print(f"{len(pairs)} pairs 0.4 m apart, to {np.ceil(error / 1e-14) * 1e-14:.0e} m")
