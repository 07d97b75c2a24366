"""Dice that fall on each other in a narrow cup overlap nowhere, as whole shapes.

Gaps of parts cannot tell: edges that are deep in each other face each other no more. Arcs that many
contacts hold had ends that were known to 1e-10 m only, and edges that closed from a touch had no
root on the chord: dice passed through each other, and nobody was told.
"""

from __future__ import annotations

import numpy as np
import pytest
from tests.bench.piles import lowest_gap, on_floor

import saltus


def dice(seed: int, count: int = 6) -> saltus.Model:
    rng = np.random.default_rng(seed)
    builder = on_floor(0.3, 0.4)
    for angle in np.arange(8) * np.pi / 4:
        wall = f"wall_{round(4 * angle / np.pi)}"
        builder.add_half_space(wall, (np.cos(angle), np.sin(angle), 0), -0.02)
    for i in range(count):
        R, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        place = [*rng.uniform(-0.004, 0.004, 2), 0.016 + 0.028 * i]
        X = saltus.Pose(place, R if np.linalg.det(R) > 0 else -R)
        builder.add_body(f"die_{i}", saltus.Box((0.008,) * 3), mass=0.004, X=X)
    return builder.build()


# where one cure or the other was missing two dice passed through each other soon before this step
@pytest.mark.parametrize(
    ("seed", "steps"),
    [(1, 32), (2, 22), (3, 34), (6, 36), (7, 41), (8, 25), (10, 47), (50, 51)],
)
def test_dice_overlap_nowhere(seed, steps):
    model = dice(seed)
    stepper = saltus.Stepper(model, h=0.005)
    state = model.state()
    for _ in range(steps):
        state = stepper.advance(state)
    # a hundred touches of 8e-13 m: arcs that are held by 30 contacts end no sharper
    assert lowest_gap(model, state.q) > -1e-10
