"""The scenes hit as they should: what is predicted in closed form, on every one of them."""

from __future__ import annotations

import functools
import math

import numpy as np
import pytest

import saltus

G = 9.81


@functools.cache
def billiard_run() -> saltus.Trajectory:
    model = saltus.load_urdf(saltus.scenes.billiard(), gravity=(0, 0, 0))
    return saltus.simulate(model, v={"x_0": 5.0}, duration=1.0, progress=False)


def test_a_billiard_break_keeps_momentum_and_energy():
    run = billiard_run()
    assert len(run.model.shapes) == 16
    assert run.model.n_pairs == 16 * 15 // 2
    assert run.impacts["t"][0] == pytest.approx(18 * 0.028575 / 5, rel=1e-12)
    x = run.p[:, 0::2].sum(axis=1)
    y = run.p[:, 1::2].sum(axis=1)
    # sums of 16 momenta, each impulse rounded to 1e-16 of 0.85: far below 1e-12
    np.testing.assert_allclose(x, 0.17 * 5, rtol=1e-12)
    np.testing.assert_allclose(y, 0, atol=1e-12)
    np.testing.assert_allclose(run.total, 0.17 * 25 / 2, rtol=1e-12)


def test_a_billiard_break_moves_apart():
    run = billiard_run()
    gaps = run.model.gaps(run.q[-1])
    assert gaps.phi.min() > -1e-12  # some balls stay, and touch on
    rates = gaps.phi_q @ run.v[-1]
    assert rates[gaps.phi < 0.02].min() > -1e-9  # neighbours do not come back to each other


@pytest.mark.parametrize("tilt", [0.05, 0.3, 1.2])
def test_a_box_falls_on_its_edge(tilt):
    model = saltus.load_urdf(saltus.urdf_dir() / "box_on_edge.urdf")
    below = 0.2 * math.sin(tilt) + 0.1 * math.cos(tilt)
    run = saltus.simulate(
        model, q={"slide_z": below + 0.5, "turn": tilt}, duration=3.0, progress=False
    )
    first = run.impact(0)
    # free fall is exact; the root of the gap is found to rounding
    assert first.t == pytest.approx(math.sqrt(2 * 0.5 / G), rel=1e-12)
    assert first.contacts == 2
    assert set(first.pairs) <= {"box[++-] ~ floor", "box[+--] ~ floor"}
    # both corners of the edge act as one: the impulse of a rod in a plane
    arm = 0.2 * math.cos(tilt) - 0.1 * math.sin(tilt)
    impulse = 2 * math.sqrt(2 * G * 0.5) / (1 / 3 + arm**2 / 0.05)
    assert sum(first.lambdas) == pytest.approx(impulse, rel=1e-10)
    # between impacts gravity and inertia are constant, so that midpoint steps are exact
    assert run.energy_error < 1e-11
    assert min(model.gaps(q).phi.min() for q in run.q) > -1e-9


def test_balls_leave_a_galton_board_as_fast_as_they_fall():
    balls = 3
    model = saltus.load_urdf(saltus.scenes.galton(balls=balls))
    assert len(model.shapes) == 200 + balls + 2
    assert model.n_pairs == balls * (200 + 2)  # no pin with a pin, no ball with a ball
    run = saltus.simulate(model, duration=60.0, progress=False)
    z, v = run.q[-1][1::2], run.v[-1].reshape(balls, 2)
    assert z.max() < -21 * 0.05
    # every impact rounds a velocity by 1e-16 of itself; hundreds of them stay below 1e-12
    np.testing.assert_allclose((v**2).sum(axis=1), -2 * G * z, rtol=1e-11)
    assert np.abs(run.q[:, 0::2]).max() < 0.25 + 0.05  # between the walls


def test_a_cradle_of_plane_pendulums_swings_as_one_of_spherical_ones():
    plane = saltus.load_urdf(saltus.scenes.cradle(5, sways=False))
    both = saltus.load_urdf(saltus.scenes.cradle(5))
    assert plane.coordinate_names == [f"swing_{i}" for i in range(5)]
    start = {"swing_0": 0.3}
    a = saltus.simulate(plane, q=start, duration=2.0, progress=False)
    b = saltus.simulate(both, q=start, duration=2.0, progress=False)
    np.testing.assert_allclose(a.q, b.q[:, 0::2], atol=1e-9)  # rounding, twice through an impact


def test_a_blow_goes_through_a_thousand_balls():
    model = saltus.load_urdf(saltus.scenes.cradle(1000, sways=False))
    run = saltus.simulate(model, q={"swing_0": 0.3}, duration=0.6, progress=False)
    hit = run.impact(0)
    assert hit.pairs == [f"ball_{i} ~ ball_{i + 1}" for i in range(999)]
    np.testing.assert_allclose(hit.lambdas, hit.lambdas[0], rtol=1e-10)
    speed = math.sqrt(2 * G * (1 - math.cos(0.3)) / 1.001)  # of the first ball, at its lowest
    assert hit.lambdas[0] == pytest.approx(1.001 * speed, rel=1e-4)  # the step's error, O(h^2)
    assert np.abs(run.q[-1][:-1]).max() < 1e-9  # all but the last hang still
    assert run.q[-1][-1] < -0.05  # and that one rises


def test_a_quadruped_stands_and_carries_a_parcel():
    model = saltus.load_urdf(saltus.urdf_dir() / "quadruped.urdf")
    assert (model.n_q, model.n_v) == (14, 12)
    assert sum(link.mass for link in model.links) == pytest.approx(8 + 4 * 1 + 2)
    start = state = model.state()
    stepper = saltus.Stepper(model, h=0.01)
    for _ in range(200):
        state = stepper.advance(state)
        assert not stepper.report.impacts
    assert np.abs(state.q - start.q).max() < 1e-9
    touching = model.gaps(state.q)
    names = {touching.names[i] for i in np.flatnonzero(np.abs(touching.phi) < 1e-9)}
    feet = {f"{leg}_shin[-] ~ floor" for leg in
            ("front_left", "front_right", "back_left", "back_right")}  # fmt: skip
    assert feet <= names
    assert len(names - feet) >= 4  # corners of the cube on the trunk


@pytest.mark.parametrize(
    "make",
    [
        lambda: saltus.scenes.billiard(0),
        lambda: saltus.scenes.galton(0),
        lambda: saltus.scenes.galton(balls=0),
        lambda: saltus.scenes.cradle(0, sways=False),
    ],
)
def test_numbers_that_make_no_scene(make):
    with pytest.raises(saltus.ModelError):
        make()
