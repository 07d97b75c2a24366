"""Whole robots thrown into the air for ten seconds, their bases tumbling through every attitude."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from test_robots import load

import saltus

UP, DURATION = 50.0, 10.0  # it comes back to about where it was thrown from


def biped() -> saltus.Model:
    """Build a trunk on two legs like Cassie's: balls for hips; hinges for knees and ankles."""
    builder = saltus.ModelBuilder("biped")
    builder.add_body("trunk", saltus.Box((0.1, 0.15, 0.25)), mass=20, X=saltus.Pose((0, 0, 1)))
    bone = saltus.solid_box(4, (0.04, 0.04, 0.17)).seen_from(saltus.Pose((0, 0, -0.2)))
    foot = saltus.solid_box(1, (0.1, 0.04, 0.02)).seen_from(saltus.Pose((0.04, 0, -0.03)))
    for side, y in (("l", 0.1), ("r", -0.1)):
        parent, at = "trunk", (0, y, -0.25)
        for part, inertia in (("thigh", bone), ("shank", bone), ("foot", foot)):
            name = f"{side}_{part}"
            hip = part == "thigh"
            builder.add_link(name, inertia)
            builder.add_joint(
                name,
                saltus.JointType.spherical if hip else saltus.JointType.revolute,
                parent=parent,
                child=name,
                axis=(0, 1, 0),  # a ball has none: not read
                X_PJ=saltus.Pose(at),
            )
            parent, at = name, (0, 0, -0.4)
    return builder.build()


def model_of(name: str) -> saltus.Model:
    return biped() if name == "biped" else load(name)


def throw(name: str, h: float) -> saltus.Trajectory:
    """Fling the robot up, turning at 1 rev/s about its y axis, its joints free: no limits."""
    model = model_of(name)
    v = 0.5 * np.cos(np.arange(model.n_v))
    v[2], v[3:6] = UP, (0.2, 6.0, 0.3)
    return saltus.simulate(model, v=v, duration=DURATION, h=h, collisions=False, progress=False)


@pytest.mark.parametrize("name", ["anymal", "talos", "biped"])
def test_thrown_robot_tumbles_for_ten_seconds(name):
    """Energy within O(h^2); the three momenta that gravity leaves alone, and p_z = p_0 - m g t."""
    coarse, fine = (throw(name, h) for h in (1e-3, 5e-4))
    assert coarse.complete
    lowest = Rotation.from_quat(coarse.q[:, 3:7]).apply((0, 0, 1))[:, 2].min()
    assert lowest < -0.9, "it was to turn upside down"

    # 1e-5 of the greatest kinetic energy: seen are 4e-6 (Talos, light wrists that whirl) and less.
    # The error at two steps is that of two motions: after ten seconds a tree's are no longer one.
    assert fine.energy_error < coarse.energy_error < 1e-5

    linear = coarse.p[:, :3]
    # p of the base's turning is about its origin, along the world's axes.
    about_z = np.cross(coarse.q[:, :3], linear)[:, 2] + coarse.p[:, 5]
    mass = model_of(name).mass_matrix(coarse.q[0])[0, 0]
    fall = 9.81 * mass * coarse.t
    # A step's residual is rounding of p; 10^4 of them add up to less than 10^4 times as much.
    size = np.abs(linear).max()
    np.testing.assert_allclose(
        linear[:, :2], linear[:1, :2].repeat(len(linear), 0), rtol=0, atol=1e-10 * size
    )
    np.testing.assert_allclose(linear[:, 2] + fall, linear[0, 2], rtol=0, atol=1e-10 * size)
    np.testing.assert_allclose(
        about_z, about_z[0], rtol=0, atol=1e-10 * size * np.abs(coarse.q[:, :3]).max()
    )
