"""saltus: a box and a half-space; impacts are found and resolved within the steps."""

from __future__ import annotations

import numpy as np

import saltus
from tests.bench.tosses.data import EDGE, GRAVITY, MASS, ROW
from tests.bench.tosses.flight import Start
from tests.bench.tosses.parameters import CUBE, FRICTION, RESTITUTION, TABLE, table

NAME, VERSION = "saltus", saltus.__version__
STEPS = {"2 steps a row": 2, "1 step a row": 1}
SETTINGS = tuple(STEPS)
PARAMETERS = (FRICTION, RESTITUTION, *CUBE, *TABLE)
LINK = "cube"
MOST_IMPACTS = 100  # a step: a cube on its table has a few


def build(values: dict[str, float]) -> saltus.Model:
    """Return the cube and its table."""
    plane = table(values)
    return (
        saltus.ModelBuilder("toss")
        .set_gravity((0, 0, -GRAVITY))
        .add_half_space("table", plane.normal, plane.offset)
        .set_default_contact(restitution=values["restitution"], friction=values["friction"])
        .add_link(LINK, saltus.BodyInertia(MASS, I_J=values["inertia"] * np.eye(3)))
        .add_shape(LINK, saltus.Box((EDGE / 2,) * 3))
        .add_joint(LINK, saltus.JointType.floating, parent="world", child=LINK)
        .build()
    )


def simulate(start: Start, values: dict[str, float], setting: str) -> np.ndarray:
    model, steps = build(values), STEPS[setting]
    run = saltus.simulate(
        model,
        q={LINK: saltus.Pose(start.pose[:3, 3], start.pose[:3, :3])},
        v=np.concatenate([start.velocity, start.spin]),
        duration=(start.rows - 1) * ROW,
        h=ROW / steps,
        record_every=steps,
        progress=False,
        max_impacts=MOST_IMPACTS,
    )
    return run.poses(LINK)
