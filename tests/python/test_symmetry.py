"""Scenes that are their own mirror image stay so under `ImpactOrder.symmetric`."""

from __future__ import annotations

import numpy as np
import pytest

import saltus

SYMMETRIC = saltus.ImpactOrder.symmetric
ORDERS = (saltus.ImpactOrder.fastest, saltus.ImpactOrder.index, SYMMETRIC)


def mirrored(points):
    """Return the points at y -> -y, each set in the order of its own x and |y|."""
    return np.array([points[:, 0], -points[:, 1]]).T


def defect(points):
    """Return how far the image of each point in the x axis is from the nearest point."""
    distances = np.linalg.norm(points[:, None] - mirrored(points)[None], axis=2)
    return distances.min(axis=1).max()


def discs(centers):
    """Return billiard balls of radius .5 and mass 1 at these places, and no gravity."""
    builder = saltus.ModelBuilder("discs").set_gravity((0, 0, 0))
    for i, (x, y) in enumerate(centers):
        builder.add_link(f"slide_{i}")
        prismatic = saltus.JointType.prismatic
        builder.add_joint(f"x_{i}", prismatic, parent="world", child=f"slide_{i}", axis=(1, 0, 0),
                          X_PJ=saltus.Pose((x, y, 0)))  # fmt: skip
        builder.add_body(f"disc_{i}", saltus.Sphere(0.5), mass=1.0, joint=prismatic,
                         joint_name=f"y_{i}", parent=f"slide_{i}", axis=(0, 1, 0))  # fmt: skip
    return builder


def test_a_billiard_break_keeps_its_mirror_symmetry():
    model = saltus.load_urdf(saltus.scenes.billiard(), gravity=(0, 0, 0))
    run = saltus.simulate(model, v={"x_0": 5.0}, duration=1.0, order=SYMMETRIC)
    places = run.q[-1].reshape(-1, 2)
    start = np.array([model.poses(np.zeros((1, model.n_q)), f"ball_{i}")[0, :2, 3]
                      for i in range(16)])  # fmt: skip
    assert defect(start + places) < 1e-12
    assert defect(run.v[-1].reshape(-1, 2)) < 1e-12
    assert run.energy_error < 1e-12
    assert run.p[-1, ::2].sum() == pytest.approx(0.85, abs=1e-12)
    lopsided = saltus.simulate(model, v={"x_0": 5.0}, duration=1.0)
    assert defect(lopsided.v[-1].reshape(-1, 2)) > 0.1  # the measure can tell


def test_bernoullis_problem():
    centers = [(-2, 0), (0, 0.5), (0, -0.5)]
    model = discs(centers).build()
    run = saltus.simulate(model, v={"x_0": 2.0}, duration=2.0, order=SYMMETRIC, certify=True)
    expected = [-0.4, 0, 1.2, 0.6928203230275509, 1.2, -0.6928203230275509]
    np.testing.assert_allclose(run.v[-1], expected, atol=1e-12)
    assert run.certificates == ("order_dependent",)  # the two targets touch each other too
    assert "order_dependent" in str(run.impact(0))
    one_by_one = saltus.simulate(model, v={"x_0": 2.0}, duration=2.0)
    # one of the two mirror images
    np.testing.assert_allclose(np.abs(one_by_one.v[-1, :2]), [0.25, 0.4330127018922193], atol=1e-9)


def test_a_ball_into_a_corner_comes_back_the_way_it_came():
    builder = discs([(0, 0)])
    builder.add_half_space("right", (-1, 1, 0), -2).add_half_space("left", (-1, -1, 0), -2)
    model = builder.build()
    run = saltus.simulate(model, v={"x_0": 1.0}, duration=4.0, order=SYMMETRIC)
    np.testing.assert_allclose(run.v[-1], [-1, 0], atol=1e-12)
    np.testing.assert_allclose(run.q[:, 1], 0, atol=1e-12)
    assert len(run.impacts) == 1


@pytest.mark.parametrize("shape", [saltus.Box((0.5, 0.5, 0.5)), saltus.Box((0.1, 0.2, 0.05))])
@pytest.mark.parametrize("speed", [0, 2])
def test_what_falls_flat_with_friction_does_not_turn_aside(shape, speed):
    """Its four corners hit together; one after the other they would make it spin."""
    builder = saltus.ModelBuilder().add_floor()
    builder.set_default_contact(restitution=0.5, friction=0.5)
    model = builder.add_body("box", shape, mass=1, joint_name="free").build()
    run = saltus.simulate(
        model, q={"free_z": 3}, v={"free_vx": speed}, duration=3, order=SYMMETRIC, progress=False
    )
    assert len(run.impacts) > 3
    # the plane y = 0 is a mirror of scene and motion: no roll, no yaw, no way aside, but for the
    # rounding of 1e-16 that corners which hit at last one by one let grow
    np.testing.assert_allclose(run.q[:, [1, 3, 5]], 0, atol=1e-4)
    if speed == 0:
        np.testing.assert_allclose(run.q[:, [0, 4]], 0, atol=1e-4)
        lopsided = saltus.simulate(model, q={"free_z": 3}, duration=3, progress=False)
        assert np.abs(lopsided.q[:, 3:6]).max() > 0.01  # the measure can tell
    assert (np.diff(run.total) <= 1e-6 * run.total[0]).all()


def test_one_contact_with_friction_is_as_in_every_order():
    builder = saltus.ModelBuilder().add_floor()
    builder.set_default_contact(restitution=0.7, friction=0.3)
    model = builder.add_body("ball", saltus.Sphere(0.1), mass=1, joint_name="free").build()
    start = {"q": {"free_z": 1}, "v": {"free_vx": 2}, "duration": 1.5}
    runs = [saltus.simulate(model, **start, order=each, progress=False) for each in ORDERS]
    for other in runs[1:]:
        np.testing.assert_array_equal(runs[0].q, other.q)
