"""Two failures of other engines' derivatives through impacts, which are public, as tests here."""

from __future__ import annotations

import numpy as np
import pytest

import saltus
from saltus import ModelBuilder, Pose


@pytest.mark.parametrize("h", [1.0, 0.1, 0.01])
def test_two_equal_balls_exchange_their_velocities(h):
    # x_f of the struck ball is x1 + v1 T + 2 r whatever the rest: (1, 0, T, 0), T = 1 s
    builder = ModelBuilder().set_gravity((0, 0, 0))
    for name, x in (("cue", 0.0), ("struck", 0.5)):
        X = Pose((x, 0, 0))
        builder.add_body(name, saltus.Sphere(0.1), mass=1.0, X=X, joint="prismatic")
    model = builder.build()
    stepper = saltus.Stepper(model, h=h, record=True)
    state, A = model.state(v={"cue": 1.0}), np.eye(4)
    for _ in range(round(1 / h)):
        state = stepper.advance(state)
        A = stepper.derivative().A @ A
    assert 0.5 + state.q[1] == pytest.approx(1.2, abs=1e-12)
    assert np.allclose(A[1], [1, 0, 1, 0], atol=1e-12)
    assert np.allclose(A[0], [0, 1, 0, 1], atol=1e-12)


def test_height_after_a_bounce_is_continuous_in_the_drop_height():
    # From a height z the ball meets the floor at sqrt(2 z/g) and rises to e^2 z. The height at a
    # fixed time is sampled so finely that the impact passes the ends of some steps.
    g, e, h, steps = 9.81, 0.8, 0.01, 60
    builder = ModelBuilder().add_half_space("floor", (0, 0, 1))
    X = Pose((0, 0, 0.1))
    builder.add_body("ball", saltus.Sphere(0.1), mass=1.0, X=X, joint="prismatic", axis=(0, 0, 1))
    model = builder.set_default_contact(restitution=e).build()
    stepper = saltus.Stepper(model, h=h, record=True)
    drops = np.linspace(0.80, 0.90, 401)
    heights, slopes = [], []
    for z in drops:
        state, dx = model.state(q=[z]), np.array([1.0, 0.0])
        for _ in range(steps):
            state = stepper.advance(state)
            dx = np.concatenate(stepper.jvp(dx[:1], dx[1:]))
        heights.append(state.q[0])
        slopes.append(dx[0])
    T = steps * h
    fall = np.sqrt(2 * drops / g)
    exact = e * g * fall * (T - fall) - g * (T - fall) ** 2 / 2
    # the midpoint rule has parabolas exactly, and what an impact changes of them
    assert np.abs(heights - exact).max() < 1e-13
    # a jump of the height or a kink would be seen in differences of neighbours: the rule of
    # trapezoids is off by dz^2/12 of the third derivative, 1.6e-8
    by, mean = np.diff(heights) / np.diff(drops), np.add(slopes[1:], slopes[:-1]) / 2
    assert np.abs(by - mean).max() < 1e-7
