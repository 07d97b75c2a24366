"""What the certificate of an impact with friction says: whether another order was possible."""

from __future__ import annotations

import numpy as np
import pytest

import saltus

RADIUS = 0.1
BALL = saltus.Sphere(RADIUS)


def world(places, *, restitution=0.5, friction=0.3, shape=BALL):
    """Return bodies at these places above a floor."""
    builder = saltus.ModelBuilder("bodies").add_floor(restitution=restitution, friction=friction)
    builder.set_default_contact(restitution=restitution, friction=friction)
    for i, place in enumerate(places):
        builder.add_body(f"body_{i}", shape, mass=1.0, X=saltus.Pose(place))
    return builder.build()


def first_certificate(model, v=None, duration=0.2):
    run = saltus.simulate(model, v=v, duration=duration, h=0.01, certify=True)
    return run.certificates[0]


def test_balls_that_land_side_by_side_have_no_order():
    assert first_certificate(world([(0, 0, 0.2), (1, 0, 0.2)])) == "unique"


def test_a_ball_that_lands_far_from_one_that_rests_is_a_single_contact():
    assert first_certificate(world([(0, 0, 0.2), (1, 0, RADIUS)])) == ""


def test_one_contact_that_approaches_beside_others_that_rest_has_no_order():
    model = world([(0, 0, RADIUS), (0.3, 0, RADIUS)])
    assert first_certificate(model, v={"body_0_vx": 2.0}) == "unique"


def test_a_ball_into_two_at_once_is_a_matter_of_order():
    side = RADIUS * (1 + 1e-13)
    model = world([(0, 0, RADIUS), (0.4, side, RADIUS), (0.4, -side, RADIUS)])
    assert first_certificate(model, v={"body_0_vx": 4.0}) == "order_dependent"


@pytest.mark.parametrize(
    ("restitution", "certificate"), [(0.5, "order_dependent"), (0.0, "unique, plastic")]
)
def test_a_box_that_lands_flat(restitution, certificate):
    box = saltus.Box((0.1, 0.1, 0.1))
    model = world([(0, 0, 0.2)], restitution=restitution, shape=box)
    assert first_certificate(model) == certificate


def test_the_order_matters_where_the_certificate_says_so():
    side = RADIUS * (1 + 1e-13)
    places = np.array([(0, 0, RADIUS), (0.4, side, RADIUS), (0.4, -side, RADIUS)])
    ends = []
    for image in (places, places * (1, -1, 1)):  # the second: numbers of the two exchanged
        run = saltus.simulate(world(image), v={"body_0_vx": 4.0}, duration=0.2, order="index")
        ends.append(run.column("body_0_vy", of="v")[-1])
    assert ends[0] == pytest.approx(-ends[1])
    assert abs(ends[0]) > 0.1
