"""Thousands of bodies: pairs without a list, met as they come near."""

from __future__ import annotations

import numpy as np
import pytest

import saltus


def gas(n: int) -> tuple[saltus.Model, np.ndarray, np.ndarray]:
    """Balls of radius 0.5, 1.5 m apart, each on a slide; their places and directions, (n, 3)."""
    axes = np.random.default_rng(0).normal(size=(n, 3))
    axes /= np.linalg.norm(axes, axis=1)[:, None]
    builder = saltus.ModelBuilder("gas").set_gravity((0, 0, 0))
    builder.set_adjacent_links(saltus.AdjacentLinks.watched)
    side = int(np.ceil(n ** (1 / 3)))
    places = 1.5 * np.array([(i % side, i // side % side, i // side**2) for i in range(n)])
    for i in range(n):
        builder.add_body(
            f"ball_{i}",
            saltus.Sphere(0.5),
            mass=1.0,
            joint=saltus.JointType.prismatic,
            joint_name=f"slide_{i}",
            X=saltus.Pose(places[i]),
            axis=axes[i],
        )
    return builder.build(), places, axes


@pytest.mark.slow
def test_a_gas_of_two_thousand_balls_keeps_its_energy():
    n = 2000
    model, places, axes = gas(n)
    assert model.n_pairs == n * (n - 1) // 2
    v = np.random.default_rng(1).normal(size=n)
    run = saltus.simulate(model, v=v, duration=0.6, progress=False)
    assert len(run.impacts) > 200
    assert len(run.pair_names) < 1000  # those that collided, of two million
    assert run.impact(0).pairs[0] in run.pair_names
    assert abs(run.total / run.total[0] - 1).max() < 1e-12  # rounding of 10^3 impulses
    centers = places + run.q[-1][:, None] * axes
    apart = np.linalg.norm(centers[:, None] - centers[None, :], axis=2) + 10 * np.eye(n)
    assert apart.min() > 1 - 1e-9  # no ball is in another: epsilon_phi is 5e-11
