"""The generated models."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scenes import cradle

import saltus


@pytest.mark.parametrize("balls", [3, 5])
def test_cradle_is_that_of_the_file(balls):
    file = saltus.load_urdf(saltus.urdf_dir() / f"newtons_cradle_{balls}.urdf")
    made = cradle(balls)
    assert made.coordinate_names == file.coordinate_names
    assert made.link_names == file.link_names
    assert made.pair_names == file.pair_names
    rng = np.random.default_rng(0)
    q, v = rng.uniform(-1, 1, (2, made.n_q))
    for partial in ("value", "L_q", "L_v", "L_qq", "L_vq", "L_vv"):
        ours, theirs = (getattr(m.lagrangian(q, v), partial) for m in (made, file))
        np.testing.assert_allclose(ours, theirs, rtol=1e-14, atol=1e-14)
    np.testing.assert_allclose(made.gaps(q).phi, file.gaps(q).phi, atol=1e-14)


def test_cradle_follows_its_numbers():
    model = saltus.load_urdf(saltus.scenes.cradle(2, 0.01, radius=0.1, mass=[1.0, 2.0], length=0.5))
    assert model.gaps(np.zeros(4)).phi == pytest.approx([0.01])
    inertia = 2 * 0.5**2 + 0.4 * 2 * 0.1**2
    assert model.mass_matrix(np.zeros(4))[2, 2] == pytest.approx(inertia)
    assert model.pose({"swing_0": math.pi / 6}, "ball_0").R[0, 2] == pytest.approx(0.5)


@pytest.mark.parametrize("balls", [2, 3, 4, 7, 10, 30])
def test_balls_at_rest_touch(balls):
    gaps = cradle(balls).gaps(np.zeros(2 * balls))
    neighbours = [gaps.names.index(f"ball_{i} ~ ball_{i + 1}") for i in range(balls - 1)]
    assert np.abs(gaps.phi[neighbours]).max() < 1e-15


def test_chain():
    model = saltus.load_urdf(saltus.scenes.chain(3, length=0.2, mass=0.5))
    assert model.coordinate_names == ["joint_0", "joint_1", "joint_2"]
    np.testing.assert_allclose(model.pose(np.zeros(3), "link_2").p, [0, 0, -0.4])
    assert sum(link.mass for link in model.links) == pytest.approx(1.5)
    energy = model.potential_energy(np.zeros(3))
    assert energy == pytest.approx(0.5 * 9.81 * -(0.1 + 0.3 + 0.5))
    assert model.shapes == []


@pytest.mark.parametrize(
    "make",
    [
        lambda: saltus.scenes.cradle(0),
        lambda: saltus.scenes.cradle(3, mass=[1.0, 2.0]),
        lambda: saltus.scenes.cradle(3, -0.01),
        lambda: saltus.scenes.chain(0),
    ],
)
def test_numbers_that_make_no_scene(make):
    with pytest.raises(saltus.ModelError):
        make()
