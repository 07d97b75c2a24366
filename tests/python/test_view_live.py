"""Live pages: frames, sliders, pulling, pause, steps, reset; the program ends with its page."""

from __future__ import annotations

import json
import math
import subprocess
import sys
import time
import urllib.error
from contextlib import contextmanager

import numpy as np
import pytest
from browser import fetch, until
from scenes import BALL
from tests.conftest import ROOT

import saltus
from saltus.view.live import Live
from saltus.view.pull import FIRM, PULL, Pull, force_of
from saltus.view.sliders import sliders_of

URDF = ROOT / "urdf"
WAIT = 60


@contextmanager
def program(*arguments: object):
    """Run `saltus view --live`, and give the process and the address of its page."""
    command = [sys.executable, "-m", "saltus", "view", "--live", "--no-browser", *arguments]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            line = process.stdout.readline()
            while line and not line.startswith("page: "):
                line = process.stdout.readline()
            yield process, line.removeprefix("page: ").strip()
        finally:
            process.kill()


@pytest.fixture
def live_tab(browser):
    with program(URDF / "double_pendulum.urdf", "--set", "shoulder=0.5") as (process, url):
        tab = browser.open(url).ready()
        yield process, tab
        assert tab.problems == []
        assert all(request.startswith(url) for request in tab.requests)


def at_rest(tab) -> float:
    """Pause, and return the time that stays."""
    tab.run("saltus.page.live.wish({ do: 'pause' })")
    until(lambda: not tab.run("saltus.page.clock.playing"))
    return tab.run("saltus.time")


def test_frames_come_at_once_and_the_program_ends_with_the_page(live_tab):
    process, tab = live_tab
    until(lambda: tab.run("saltus.page.live.frames") >= 60)
    until(lambda: tab.run("saltus.page.live.lags.length") >= 5)  # slow pages show a part of them
    # The best of those that were shown: others wait for what else this machine does.
    assert tab.run("Math.min(...saltus.page.live.lags)") < 200
    assert tab.run("saltus.time") > 0
    energies = np.array(tab.run("saltus.page.energies.total"))
    assert np.ptp(energies) < 1e-3 * abs(energies).max()
    tab.run("window.stop()")
    tab.ask("Page.navigate", url="about:blank")
    assert process.wait(WAIT) == 0


def test_pause_steps_reset_and_sliders(live_tab):
    _, tab = live_tab
    until(lambda: tab.run("saltus.time") > 0)
    time = at_rest(tab)
    tab.click("#single")
    until(lambda: tab.run("saltus.time") > time)
    assert tab.run("saltus.time") == pytest.approx(time + 1 / 120, abs=1e-12)
    tab.run("document.getElementById('reset').click()")
    until(lambda: tab.run("saltus.time") == 0)
    names = tab.run("saltus.page.data.sliders.map((s) => s.name)")
    assert names == ["shoulder", "elbow"]
    tab.run("""(() => { const s = document.getElementById('slider-1');
        s.value = 1; s.dispatchEvent(new Event('input')); })()""")
    until(lambda: "1.000 rad" in tab.run("document.getElementById('sliders').textContent"))
    tab.click("#play")
    until(lambda: tab.run("saltus.time") > 0)


def test_a_body_is_pulled_with_the_mouse(browser, tmp_path):
    box = tmp_path / "box.urdf"
    box.write_text("""<robot name="box"><link name="box"><inertial><mass value="1"/>
        <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
        <collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link></robot>""")
    options = ("--floating", "--floor", "--contact", "0,0.5", "--set", "root_z=0.1")
    with program(box, *options) as (_, url):
        tab = browser.open(url).ready()
        until(lambda: tab.run("saltus.page.live.frames") > 5)
        x, y, _ = tab.run("saltus.project([0, 0, 0.1])")
        tab.mouse("mousePressed", x, y, buttons=1)
        tab.mouse("mouseMoved", x, y - 280, buttons=1)
        height = "saltus.poses()[0][1][2]"
        until(lambda: tab.run(height) > 0.12)  # it hangs on the point
        until(lambda: tab.run("saltus.page.live.pull.thread.visible"))
        tab.mouse("mouseReleased", x, y - 280)
        until(lambda: tab.run(height) < 0.105)  # it lies on the floor again
        until(lambda: any(a["kind"] == "force" for a in tab.run("saltus.arrows()")))
        assert tab.problems == []
        tab.close()


def test_impacts_gap_normals_and_forces_are_those_of_a_run(browser, tmp_path):
    file = tmp_path / "ball.urdf"
    file.write_text(BALL)
    dropped = ("--floating", "--floor", "--contact", "0.5,0.3", "--set", "root_z=0.5")
    with program(file, *dropped) as (_, url):
        tab = browser.open(url).ready()
        assert tab.run("[...document.getElementById('pair').options].map((o) => o.text)") == [
            "ball ~ floor"
        ]
        told = "saltus.page.live.told"
        until(lambda: tab.run("saltus.page.live.frames") > 1)
        at_rest(tab)
        tab.run("document.getElementById('reset').click()")  # it fell while the page was opened
        until(lambda: tab.run("saltus.time") == 0)
        tab.click("#play")
        until(lambda: tab.run(told) >= 1)
        # The gap is 0 at the instant of an impact, which lies between two frames.
        first = tab.run("saltus.page.gap.x[saltus.page.gap.phi.indexOf(0)]")
        assert first == pytest.approx(math.sqrt(2 * 0.4 / 9.81), abs=1e-3)
        until(lambda: any(a["kind"] == "force" for a in tab.run("saltus.arrows()")))  # it lies
        (force,) = (a for a in tab.run("saltus.arrows()") if a["kind"] == "force")
        np.testing.assert_allclose(force["vector"], [0, 0, 9.81], atol=1e-6)
        np.testing.assert_allclose(force["point"], [0, 0, 0], atol=1e-6)
        words = tab.run("document.getElementById('impact-table').textContent")
        assert "ball ~ floor" in words
        assert tab.run("document.getElementById('impact-title').textContent") == (
            f"Last impact, number {tab.run(told)}"
        )
        legend = tab.run("document.getElementById('legend').textContent")
        assert "impulse, longest" in legend
        assert "contact force, longest 9.81 N" in legend
        assert "contact normal" in legend
        assert tab.run("document.getElementById('gap-line').textContent").startswith("φ ")
        assert tab.problems == []
        tab.close()


def test_what_leaves_the_picture_is_taken_in_again(browser):
    with program(URDF / "double_pendulum.urdf", "--set", "shoulder=3.1") as (_, url):
        tab = browser.open(url).ready()
        until(lambda: tab.run("saltus.page.live.frames") > 1)
        inside = """(() => {
          const { clientWidth: w, clientHeight: h } = saltus.page.stage.canvas;
          return saltus.page.motion.now.length > 0 && saltus.page.data.bodies.every((_, body) => {
            const [x, y] = saltus.project(saltus.page.motion.now.slice(7 * body, 7 * body + 3));
            return x > 0 && x < w && y > 0 && y < h;
          });
        })()"""
        before = tab.run("saltus.page.bounds.box.min.z")
        tab.run("saltus.page.live.wish({ do: 'speed', value: 5 })")
        until(lambda: tab.run("saltus.page.bounds.box.min.z") < before - 0.3)  # it has fallen
        until(lambda: tab.run("saltus.page.views.goal === null") and tab.run(inside))
        assert tab.problems == []
        tab.close()


def test_a_program_that_ended_is_said_for_good(browser):
    with program(URDF / "double_pendulum.urdf", "--set", "shoulder=0.5") as (process, url):
        tab = browser.open(url).ready()
        until(lambda: tab.run("saltus.page.clock.playing"))
        process.kill()
        words = "document.getElementById('status').textContent"
        until(lambda: tab.run(words) == "The program that simulates this page has ended.")
        assert not tab.run("saltus.page.clock.playing")
        for name in ("play", "single", "reset", "slider-0"):
            assert tab.run(f"document.getElementById('{name}').disabled"), name
        tab.key(" ")  # asks the program, in vain
        until(lambda: tab.run("1") and any("Failed to load" in each for each in tab.problems))
        assert tab.run(words) == "The program that simulates this page has ended."
        assert tab.run("saltus.page.silence === null")  # other words go after 4 s
        tab.close()


def test_requests_of_others_are_refused():
    with program(URDF / "double_pendulum.urdf") as (_, url):
        root = url.rsplit("/", 2)[0]
        for path, body in (("/", None), ("/guess/", None), ("/guess/do", b'{"do": "reset"}')):
            with pytest.raises(urllib.error.HTTPError, match="404"):
                fetch(root + path, body)
        with pytest.raises(urllib.error.HTTPError) as refused:
            fetch(url + "do", b'{"do": "explode"}')
        assert refused.value.code == 400
        assert "play, pause, step, reset" in refused.value.read().decode()
        assert b"saltus-data" in fetch(url)


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
