"""Impulses at one instant, without any model: only masses, normals and velocities.

Equal balls in line leave with their velocities sorted. And a heavy block of mass 100^k that pushes
a small one against a wall makes as many impulses as pi has digits: 3, 31, 314, 3141 (G. Galperin,
Playing pool with pi, 2003).
"""

import numpy as np

import saltus

# Rows are the gradients of the gaps between neighbours, x[i + 1] - x[i].
line = np.diff(np.eye(5), axis=0)
came = [3.0, 1.0, 0.0, -2.0, 1.0]
left = saltus.resolve_impact(np.eye(5), line, came)
print(f"{came} leave as {(left.v + 0.0).round(12).tolist()}, {len(left.impulses)} impulses")

wall_and_block = [[1.0, 0.0], [-1.0, 1.0]]  # wall | small | heavy
digits = [
    len(saltus.resolve_impact(np.diag([1.0, 100.0**k]), wall_and_block, [0.0, -1.0]).impulses)
    for k in range(4)
]
print("digits of pi:", *digits)
