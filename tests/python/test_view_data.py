"""The data of pages: instants at impacts, energies about them, arrays as text."""

from __future__ import annotations

import json

import numpy as np
import pytest
from scenes import cradle_run

import saltus
from saltus.view.arrays import LONG, packed, unpacked
from saltus.view.instants import RATE, instants_of
from saltus.view.scene import scene_of_run

TOUCH = 1e-12  # [m] gaps at impacts are rounding of positions of 1 m


def ball(**contact: float) -> saltus.Model:
    builder = saltus.ModelBuilder("ball").add_floor().set_default_contact(**contact)
    at = saltus.Pose((0, 0, 1.0))
    return builder.add_body("ball", saltus.Sphere(0.1), mass=2.0, X=at).build()


@pytest.mark.parametrize("record_every", [1, 5])
def test_bodies_touch_at_the_instants_of_impacts(record_every):
    run = saltus.simulate(
        ball(restitution=0.8, friction=0.0), duration=2.0, record_every=record_every
    )
    found = instants_of(run)
    assert len(run.impacts) == 3
    assert found.interpolated == 0
    np.testing.assert_array_equal(found.t[found.impact_at], run.impacts["t"])
    for q in found.q[found.impact_at]:
        assert abs(run.model.gaps(q).phi[0]) < TOUCH
    # A ball that rebounds with 0.8 of its speed keeps 0.64 of its kinetic energy.
    part = found.kinetic[found.impact_at] / found.kinetic_before
    np.testing.assert_allclose(part, 0.64, rtol=1e-9)


def test_rows_are_at_most_sixty_a_second():
    run = saltus.simulate(ball(restitution=1.0, friction=0.0), duration=1.0, h=0.001)
    found = instants_of(run)
    rows = found.recorded[found.recorded >= 0]
    assert len(rows) == RATE + 1
    assert (rows[0], rows[-1]) == (0, len(run) - 1)
    np.testing.assert_array_equal(found.q[found.recorded >= 0], run.q[rows])
    assert (np.diff(found.t) >= 0).all()


def test_forces_that_a_run_does_not_hold_are_said():
    push = {"ball": saltus.Wrench((2.0, 0, -6.0))}
    run = saltus.simulate(ball(restitution=0.8, friction=0.3), duration=1.0, forces=push)
    scene = scene_of_run(run)
    many = len(run.impacts)
    assert many > 1
    assert f"At {many} impacts the places of bodies are interpolated" in scene["notices"][0]
    assert unpacked(scene["t"])[unpacked(scene["impacts"]["instant"])] == pytest.approx(
        run.impacts["t"]
    )


def test_motors_drive_the_steps_to_impacts_too():
    builder = saltus.read_urdf(saltus.urdf_dir() / "pendulum_and_wall.urdf")
    model = builder.add_motor("push", joint="swing").build()
    run = saltus.simulate(model, {"swing": 0.3}, duration=2.0, control={"push": 0.7})
    found = instants_of(run)
    assert len(run.impacts) > 1
    assert found.interpolated == 0
    for q in found.q[found.impact_at]:
        assert abs(model.gaps(q).phi[0]) < TOUCH


@pytest.mark.parametrize("rows", [5, LONG // 12 + 1])  # in one piece, and where time counts
@pytest.mark.parametrize("kind", ["f4", "f8", "i4"])
def test_arrays_come_back_to_the_bit(kind, rows):
    numbers = np.random.default_rng(0).normal(size=(rows, 3)) * 100
    numbers = numbers.astype({"f4": "f4", "f8": "f8", "i4": "i4"}[kind])
    again = unpacked(json.loads(json.dumps(packed(numbers, kind))))
    assert again.dtype == numbers.dtype
    np.testing.assert_array_equal(again, numbers)
    assert unpacked(packed(np.zeros((0, 3)), kind)).shape == (0, 3)


def test_data_of_a_cradle_are_those_of_the_run():
    run = cradle_run()
    scene = scene_of_run(run)
    assert scene["bodies"] == [f"{link}_{i}" for i in range(3) for link in ("gimbal", "ball")]
    assert scene["impulses"]["pairs"] == ["ball_0 ~ ball_1", "ball_1 ~ ball_2"]
    np.testing.assert_allclose(
        unpacked(scene["impulses"]["lambda"]), run.impulses["lambda"], rtol=1e-6
    )
    poses, q = unpacked(scene["poses"]), instants_of(run).q
    for number, name in enumerate(scene["bodies"]):
        X = run.model.poses(q, name)
        np.testing.assert_allclose(poses[:, number, :3], X[:, :3, 3], atol=1e-6)
