"""Joints that move as they are told: against reference values, closed forms, and their work."""

from __future__ import annotations

import math
import pickle
from itertools import pairwise

import numpy as np
import pytest
from tests.python.test_forces import GOLDEN, H, assert_rows

import saltus
from saltus import BodyInertia, JointType, ModelBuilder, ModelError

SHAKE, RATE = 0.3, 4.0


def shaken(t: float) -> tuple[float, float]:
    return SHAKE * math.sin(RATE * t), SHAKE * RATE * math.cos(RATE * t)


def pivot() -> saltus.Model:
    """Return a pendulum on a massless slide along x that is shaken."""
    builder = ModelBuilder("pivot").set_gravity((0, -9.81, 0))
    builder.add_link("slide")
    builder.add_link("bob", BodyInertia(1, (0, -1, 0), np.zeros((3, 3))))
    builder.add_joint("slide", JointType.prismatic, parent="world", child="slide", axis=(1, 0, 0))
    builder.add_joint("swing", JointType.revolute, parent="slide", child="bob", axis=(0, 0, 1))
    return builder.set_prescribed("slide", function=shaken).build()


def test_a_pendulum_on_a_shaken_pivot_is_the_reference() -> None:
    model = pivot()
    state = saltus.close_loops(model, q=[0, 0.5], v=[1.2, 0.0], keep=["swing"])
    rows = GOLDEN["pivot"]["rows"]
    run = saltus.simulate(model, state=state, duration=rows[-1]["t"], h=H)
    assert_rows(run, rows)


def test_a_shaken_pivot_is_of_second_order() -> None:
    model = pivot()
    state = saltus.close_loops(model, q=[0, 0.5], keep=["swing"])
    exact = next(row for row in GOLDEN["pivot"]["continuum"] if row["t"] == 1.0)
    errors = []
    for h in (0.01, 0.005, 0.0025):
        run = saltus.simulate(model, state=state, duration=1.0, h=h)
        errors.append(abs(run.q[-1, 1] - exact["q"][1]))
    for coarse, fine in pairwise(errors):
        assert 3.8 < coarse / fine < 4.2


def test_the_work_of_the_motion_balances_the_energy() -> None:
    model = pivot()
    state = saltus.close_loops(model, q=[0, 0.5], keep=["swing"])
    errors = [
        saltus.simulate(model, state=state, duration=2.0, h=h).energy_error for h in (0.01, 0.005)
    ]
    assert errors[0] < 1e-3
    assert 3.5 < errors[0] / errors[1] < 4.5


def test_a_ball_on_a_racket_is_exact() -> None:
    """Between impacts a parabola, at impacts u+ = -0.8 u-: the racket is infinitely heavy."""
    builder = ModelBuilder("racket")
    for name, mass in (("racket", 0.2), ("ball", 1.0)):
        builder.add_link(name, BodyInertia(mass, (0, 0, 0), 0.01 * np.eye(3)))
        builder.add_joint(name, JointType.prismatic, parent="world", child=name, axis=(0, 0, 1))
    builder.add_shape("racket", saltus.Sphere(0.5)).add_shape("ball", saltus.Sphere(0.5))
    builder.set_default_contact(restitution=0.8)
    model = builder.set_prescribed("racket", function=shaken).build()
    state = saltus.close_loops(model, q={"ball": 1.2}, keep=["ball"])
    h = 0.01
    run = saltus.simulate(model, state=state, duration=1.0, h=h)
    assert len(run.impacts) >= 2
    # Between impacts a parabola. An arc ends where the racket is then.
    z, v, t = 1.2, 0.0, 0.0
    for k, impact in enumerate(run.impacts["t"][:2]):
        tau = impact - t
        z, v, t = z + v * tau - 9.81 * tau**2 / 2, v - 9.81 * tau, impact
        at, rate = shaken(impact)
        assert z - 1 == pytest.approx(at, abs=1e-12)
        assert run.impulses["lambda"][k] == pytest.approx(1.8 * (rate - v), rel=1e-11)
        v = rate - 0.8 * (v - rate)


def test_a_spline_is_followed_and_survives_a_file(tmp_path) -> None:
    builder = ModelBuilder("lift").set_gravity((0, 0, -10))
    builder.add_link("car", BodyInertia(2, (0, 0, 0), np.eye(3)))
    builder.add_joint("lift", JointType.prismatic, parent="world", child="car", axis=(0, 0, 1))
    model = builder.set_prescribed("lift", [0, 1, 2, 3], [0, 1, 4, 9]).build()
    run = saltus.simulate(model, state=saltus.close_loops(model), duration=4.0, h=0.01)
    for t, x in ((1, 1), (2, 4), (3, 9)):
        # 1e-12: a step adds the secant of its own
        assert run.q[round(100 * t), 0] == pytest.approx(x, abs=1e-12)
    # beyond its ends a line: no force but the weight
    assert run.v[-1, 0] == pytest.approx(run.v[310, 0], abs=1e-12)
    stepper = saltus.Stepper(model, 0.01)
    stepper.advance(run.state(-1))
    assert stepper.report.loops["lift prescribed"][0] / 0.01 == pytest.approx(20, rel=1e-9)
    run.save(tmp_path / "run.h5")
    again = saltus.load(tmp_path / "run.h5").model
    assert again.loop_names == ["lift prescribed"]
    ends = [
        saltus.simulate(m, state=run.state(50), duration=1.0).q
        for m in (again, pickle.loads(pickle.dumps(model)), model)
    ]
    np.testing.assert_array_equal(ends[0], ends[2])
    np.testing.assert_array_equal(ends[1], ends[2])


def test_functions_are_not_kept(tmp_path) -> None:
    model = pivot()
    with pytest.raises(TypeError, match="its prescribed motion of 'slide' is a function"):
        pickle.dumps(model)
    state = saltus.close_loops(model, q=[0, 0.5], keep=["swing"])
    run = saltus.simulate(model, state=state, duration=0.1)
    run.save(tmp_path / "run.h5")
    assert saltus.load(tmp_path / "run.h5").model is None
    np.testing.assert_array_equal(saltus.load(tmp_path / "run.h5", model=model).q, run.q)


@pytest.mark.parametrize(
    ("told", "message"),
    [
        ({"times": [0, 1]}, "has 2 times and 0 values; it has equally many"),
        ({"times": [0, 0], "values": [0, 1]}, "has time 1 that is not after"),
        ({"times": [0, 1], "values": [0, math.nan]}, "value 1 that is not finite"),
        ({}, "takes times and values, or a function"),
        ({"times": [0, 1], "values": [0, 1], "function": shaken}, "takes times and values, or a"),
    ],
)
def test_what_is_no_motion_is_named(told, message) -> None:
    builder = ModelBuilder().add_body("b", saltus.Sphere(0.1), mass=1.0, joint="prismatic")
    with pytest.raises(ModelError, match=message):
        builder.set_prescribed("b", **told)


def test_a_function_that_returns_nonsense_is_named() -> None:
    def model_of(function: object) -> saltus.Model:
        builder = ModelBuilder().add_body("b", saltus.Sphere(0.1), mass=1.0, joint="prismatic")
        return builder.set_prescribed("b", function=function).build()

    with pytest.raises(ModelError, match=r'joint "b" returned \(1\) at t = 0'):
        saltus.close_loops(model_of(lambda t: 1.0))
    with pytest.raises(ZeroDivisionError):
        saltus.close_loops(model_of(lambda t: 1 / 0))
    with pytest.raises(ModelError, match='loop "b prescribed" is open by 1'):
        saltus.simulate(model_of(lambda t: (1.0, 0.0)), duration=0.1)
