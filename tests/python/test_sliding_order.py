"""What slides and spins converges with order two: friction points along the arc's own slip."""

from __future__ import annotations

import numpy as np
import pytest

import saltus

POINT = [(0.02, 0, 0.02), (-0.02, 0.01, 0.02), (-0.02, -0.01, 0.02), (0, 0, -0.02)]
SHAPES = {"balls": saltus.Sphere(0.02), "points": saltus.Convex(POINT)}


def tripod(feet: str, table: bool) -> saltus.Model:
    """Return a disc on three feet, so that each foot's load is known, on a floor or a wide box."""
    builder = saltus.ModelBuilder().set_default_contact(restitution=0, friction=0.3)
    if table:
        builder.add_shape("world", saltus.Box((5, 5, 1)), saltus.Pose((0, 0, -1)))
    else:
        builder.add_floor()
    builder.add_link("disc", saltus.solid_cylinder(1, 0.2, 0.05))
    for angle in 2 * np.pi * np.arange(3) / 3:
        foot = saltus.Pose((0.2 * np.cos(angle), 0.2 * np.sin(angle), -0.05))
        builder.add_shape("disc", SHAPES[feet], foot)
    X = saltus.Pose((0, 0, 0.07))
    builder.add_joint("free", saltus.JointType.floating, parent="world", child="disc", X_PJ=X)
    return builder.build()


@pytest.mark.parametrize("feet", SHAPES)
@pytest.mark.parametrize("table", [False, True])
def test_a_disc_that_slides_and_spins(feet, table):
    model = tripod(feet, table)
    start = {"v": [2, 0, 0, 0, 0, 8], "duration": 0.2, "progress": False}
    best = saltus.simulate(model, **start, h=0.01 / 64)
    off = []
    for h in (0.01, 0.005, 0.0025):
        run = saltus.simulate(model, **start, h=h)
        assert len(run.fallbacks) == 0
        off.append([np.abs(run.q[-1] - best.q[-1]).max(), np.abs(run.v[-1] - best.v[-1]).max()])
        assert (np.diff(run.total) < 0).all()
    orders = np.log2(np.array(off)[:-1] / np.array(off)[1:])
    np.testing.assert_allclose(orders, 2, atol=0.1)


def test_a_block_that_slides_straight_stops_where_it_should():
    """Friction takes mu g t of its speed: exact but in the step that it stops in."""
    builder = saltus.ModelBuilder().add_floor()
    builder.set_default_contact(restitution=0, friction=0.4)
    model = builder.add_body(
        "block", saltus.Box((0.2, 0.1, 0.05)), mass=2, joint_name="free"
    ).build()
    start = {"q": {"free_z": 0.05}, "v": {"free_vx": 1.0}}
    way = 1 / (2 * 0.4 * 9.81)
    off = []
    for h in (0.02, 0.01, 0.005):
        run = saltus.simulate(model, **start, duration=0.4, h=h, progress=False)
        slides = run.t < 1 / (0.4 * 9.81) - h
        np.testing.assert_allclose(run.v[slides, 0], 1 - 0.4 * 9.81 * run.t[slides], atol=1e-10)
        np.testing.assert_allclose(run.v[-1], 0, atol=1e-12)
        off.append(abs(run.q[-1, 0] - way))
    assert (np.array(off) < 0.4 * 9.81 * np.array([0.02, 0.01, 0.005]) ** 2).all()
