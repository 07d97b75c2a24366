"""A disc hits two that touch each other: Bernoulli's problem, and whether its answer is unique.

All discs are alike, the cue comes with speed 2 along x. The normals make an angle of 60 degrees, so
that the wedge angle has cos = -1/4: no part of a half turn. Whichever target is hit first takes the
larger part, and the cue leaves with (-1/4, +-sqrt(3)/4) = (-0.25, +-0.433013). Both at once,
mirrored as they lie, send it straight back with -2/5. In a line the same discs have one outcome.
"""

from math import sqrt

import numpy as np

import saltus

c = sqrt(3) / 2
normals = np.array([[-c, 0.5, c, -0.5, 0, 0], [-c, -0.5, 0, 0, c, 0.5]])
came = np.array([2.0, 0, 0, 0, 0, 0])

certificate = saltus.classify_impact(np.eye(6), normals)
print(certificate, f"cos = {np.cos(certificate.angles[0, 1]):.4f}")
every = saltus.impact_outcomes(np.eye(6), normals, came)
for outcome in every.outcomes:
    print("one after the other: cue", outcome.v[:2].round(6).tolist())
both = saltus.resolve_impact(np.eye(6), normals, came, order=saltus.ImpactOrder.symmetric)
print(f"both at once: cue {both.v[0]:.6f}, targets", both.v[2:4].round(6).tolist())

line = np.eye(5)[1:] - np.eye(5)[:-1]
print("five in a line:", saltus.classify_impact(np.eye(5), line))
