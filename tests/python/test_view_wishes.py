"""What live pages ask for, without a browser: sliders, pulls, controls; what is refused."""

from __future__ import annotations

import json
import time

import numpy as np
import pytest
from tests.conftest import ROOT

import saltus
from saltus.view.live import Live
from saltus.view.pull import FIRM, PULL, Pull, force_of
from saltus.view.sliders import sliders_of

URDF = ROOT / "urdf"


def model_of(name: str) -> saltus.Model:
    return saltus.load_urdf(URDF / f"{name}.urdf")


def test_sliders_have_the_limits_of_their_joints():
    sliders = {s.name: s for s in sliders_of(model_of("arm"), reach=2.0)}
    assert (sliders["elbow"].lower, sliders["elbow"].upper) == (-2.6, 2.6)
    assert (sliders["grip"].lower, sliders["grip"].upper) == (0, 0.03)
    assert "grip_mirror" not in sliders
    free = saltus.ModelBuilder().add_body("b", saltus.Sphere(0.1), mass=1.0).build()
    ball = {s.name: s for s in sliders_of(free, reach=2.0)}
    assert list(ball) == ["b_x", "b_y", "b_z", "b roll", "b pitch", "b yaw"]
    assert (ball["b_x"].lower, ball["b_x"].upper) == (-2, 2)
    q = ball["b yaw"].set(free.neutral(), 0.7)
    assert ball["b yaw"].get(q) == pytest.approx(0.7, abs=1e-12)
    np.testing.assert_allclose(saltus.Pose.from_quaternion(q[3:]).rpy, [0, 0, 0.7], atol=1e-12)


def ask(live: Live, **what: object) -> None:
    live.do(json.dumps(what).encode())


def test_what_cannot_be_is_refused_in_words_and_changes_nothing():
    model = saltus.load_urdf(URDF / "bouncing_ball.urdf")
    live = Live(model, model.state({"height": 1.0}), h=0.01)
    before = live.state
    with pytest.raises(saltus.ModelError, match="overlap"):
        ask(live, do="set", slider=0, value=0.0)  # the ball would be in the floor
    with pytest.raises(saltus.ModelError, match="it is from"):
        ask(live, do="set", slider=0, value=1e9)
    for number in (7, -1, 0.0, None, "0"):
        with pytest.raises(saltus.ModelError, match=f"set: no slider {number!r}; there are 1"):
            ask(live, do="set", slider=number, value=0.5)
    with pytest.raises(saltus.ModelError, match="pull: no body -1; there are 1"):
        ask(live, do="pull", body=-1, at=[0, 0, 0], to=[0, 0, 0])
    with pytest.raises(saltus.ModelError, match="set: KeyError"):
        ask(live, do="set", slider=0)
    with pytest.raises(saltus.ModelError, match="two points"):
        ask(live, do="pull", body=0, at=[0, 0], to=[0, 0, 0])
    assert live.state == before
    ask(live, do="set", slider=0, value=0.5)
    assert live.state.q[0] == 0.5


def test_a_pull_is_a_spring_as_stiff_as_the_body_is_heavy():
    # Of one free ball the force is known: f = m w^2 x.
    builder = saltus.ModelBuilder().set_gravity((0, 0, 0))
    model = builder.add_body("b", saltus.Sphere(0.1), mass=2.0).build()
    state = model.state()
    pull = Pull(1, np.zeros(3), np.array([0.1, 0, 0]))
    force = force_of(model, state, pull).force
    np.testing.assert_allclose(force, [2.0 / (1 + FIRM) * PULL**2 * 0.1, 0, 0], atol=1e-12)
    stepper = saltus.Stepper(model, 0.01)
    for _ in range(300):
        state = stepper.advance(state, forces={"b": force_of(model, state, pull)})
    np.testing.assert_allclose(model.pose(state.q, "b").p, [0.1, 0, 0], atol=1e-6)


def test_controls_are_told_to_actuators():
    builder = saltus.read_urdf(URDF / "double_pendulum.urdf").set_gravity((0, 0, 0))
    model = builder.add_motor("push", joint="elbow", effort=3.0).build()
    live = Live(model, model.state(), h=0.01)
    assert [c["name"] for c in live.scene["controls"]] == ["push"]
    ask(live, do="control", actuator=0, value=1.0)
    ask(live, do="step")
    assert live.state.p[1] == pytest.approx(0.01, rel=1e-3)  # the torque for one step
    with pytest.raises(saltus.ModelError, match="control: no actuator 1; there are 1"):
        ask(live, do="control", actuator=1, value=1.0)
    ask(live, do="reset")
    assert json.loads(live.frame.text)["control"] == [0.0]


def test_a_step_that_fails_pauses_and_says_why(monkeypatch):
    model = model_of("double_pendulum")
    live = Live(model, model.state({"shoulder": 0.5}), h=0.01)

    def fails(_: saltus.State, **__: object) -> saltus.State:
        raise saltus.StepError("no step")

    class Broken:
        advance = staticmethod(fails)
        report = live.stepper.report

    live.stepper = Broken()
    before = live.state
    ask(live, do="step")
    assert not live.playing
    assert json.loads(live.frame.text)["problem"] == "stopped: no step"
    assert live.state == before


def test_a_speed_that_is_no_number_is_refused():
    live = Live(model_of("double_pendulum"), model_of("double_pendulum").state(), h=0.01)
    with pytest.raises(saltus.ModelError, match="speed = nan"):
        ask(live, do="speed", value=float("nan"))
    assert live.speed == 1.0


def test_steps_longer_than_what_is_made_up_for_are_made():
    model = saltus.ModelBuilder().add_body("b", saltus.Sphere(0.1), mass=1.0).build()
    live = Live(model, model.state(v={"b_vx": 1.0}), h=0.3)
    ends = time.monotonic() + 5.0
    live.run(lambda: live.state.t > 0.5 or time.monotonic() > ends)
    assert live.state.t == pytest.approx(0.6)
