"""What live pages are told of impacts, held contacts and gaps: the numbers of a run."""

from __future__ import annotations

import json

import numpy as np
import pytest
from scenes import beads
from test_view_wishes import ask

import saltus
from saltus.view.frames import Frame
from saltus.view.live import Live


def dropped(shape: object, height: float, **contact: float) -> Live:
    """Return a live ball or box over a floor."""
    builder = saltus.ModelBuilder("drop").add_floor().set_default_contact(**contact)
    builder.add_body("b", shape, mass=1.0, X=saltus.Pose((0, 0, height)))
    model = builder.build()
    return Live(model, model.state(), h=0.01)


def frame_of(live: Live) -> dict:
    live.tell()
    return json.loads(live.frame.since(Frame(number=1)))  # of a page that saw no impact


class Slow:
    """A page whose connection takes each frame only after many steps; the third breaks it."""

    def __init__(self, live: Live) -> None:
        self.live, self.frames = live, []

    def write(self, data: bytes) -> None:
        self.frames.append(json.loads(data.removeprefix(b"data: ")))
        if len(self.frames) == 4:
            raise BrokenPipeError
        if len(self.frames) == 3:
            ask(self.live, do="reset")
        for _ in range(60):
            ask(self.live, do="step")

    def flush(self) -> None:
        pass


def test_frames_tell_impulses_with_normals_as_a_run_does():
    live = dropped(saltus.Box((0.1,) * 3), 0.2, restitution=0.0, friction=0.3)
    run = saltus.simulate(live.model, duration=0.2, h=0.01, record_contacts=True, progress=False)
    for _ in range(20):
        ask(live, do="step")
    told = frame_of(live)
    assert [impact["number"] for impact in told["impacts"]] == list(range(1, len(run.impacts) + 1))
    for impact, true in zip(told["impacts"], run.impacts, strict=True):
        assert impact["t"] == true["t"]
    first, true = told["impacts"][0], run.impact(0)
    assert [pair for pair, _ in first["impulses"]] == true.pairs
    vectors = true.lambdas[:, None] * true.normals + true.tangentials
    for name, column in (("points", 1), ("normals", 3)):
        np.testing.assert_array_equal([a[column] for a in first["arrows"]], getattr(true, name))
    np.testing.assert_array_equal([a[2] for a in first["arrows"]], vectors)
    assert first["closed"] == [0]
    assert live.events.pairs == ["b ~ floor"]
    held = run.recorded_contacts[run.recorded_contacts["row"] == 20]
    force = held["lambda"][:, None] * held["normal"] + held["tangential"]
    np.testing.assert_allclose([f[2] for f in told["forces"]], force / 0.01, atol=1e-9)
    assert told["gap"]["phi"] == pytest.approx(0, abs=1e-12)


def test_a_slow_page_misses_frames_but_no_impacts():
    live = dropped(saltus.Sphere(0.1), 0.11, restitution=0.5, friction=0.0)
    live.tell()
    page = Slow(live)
    live.stream(page)
    first, second, third, after = (
        [impact["number"] for impact in frame["impacts"]] for frame in page.frames
    )
    assert first == third == []  # it rests
    assert second == after == list(range(1, len(second) + 1))
    assert len(second) > 3
    times = [impact["t"] for impact in page.frames[1]["impacts"]]
    assert times[0] == pytest.approx(np.sqrt(2 * 0.01 / 9.81), abs=1e-6)
    later = Slow(live)  # another page, that is opened now
    later.write = lambda data: page.frames.append(json.loads(data[6:])) or 1 / 0
    with pytest.raises(ZeroDivisionError):
        live.stream(later)
    assert [impact["number"] for impact in page.frames[-1]["impacts"]] == second[-1:]


def test_a_reset_forgets_impacts_and_forces():
    live = dropped(saltus.Sphere(0.1), 0.11, restitution=0.5, friction=0.0)
    while not live.events.count:
        ask(live, do="step")
    assert frame_of(live)["impacts"] == frame_of(live)["impacts"] != []
    ask(live, do="reset")
    assert frame_of(live)["impacts"] == []
    assert frame_of(live)["forces"] == []


def test_a_gap_is_chosen_among_the_nearest_pairs():
    model = beads(3).build()
    live = Live(model, model.state(), h=0.01)
    assert sorted(live.events.pairs[:2]) == ["x_0 ~ x_1", "x_1 ~ x_2"]  # they touch
    assert live.events.pairs[2] == "x_0 ~ x_2"
    assert live.scene["gaps"]["pairs"] == live.events.pairs
    ask(live, do="gap", pair=2)
    assert frame_of(live)["gap"] == {"pair": 2, "phi": pytest.approx(0.1, abs=1e-12)}
    with pytest.raises(saltus.ModelError, match="gap: no pair 3; there are 3"):
        ask(live, do="gap", pair=3)


def test_a_stop_of_a_joint_is_an_impact_without_a_gap():
    builder = saltus.ModelBuilder("stop").add_body(
        "b", saltus.Sphere(0.1), mass=1.0, joint="prismatic", joint_name="x", axis=(1, 0, 0)
    )
    model = builder.set_limit("x", -1.0, 0.005, restitution=1.0).build()
    live = Live(model, model.state(v={"x": 1.0}), h=0.01)
    ask(live, do="step")
    told = frame_of(live)
    (impact,) = told["impacts"]
    assert impact["impulses"] == [["x upper limit", pytest.approx(2.0)]]
    (arrow,) = impact["arrows"]
    assert arrow[0] == "x upper limit"
    # located to a thousandth of what touches
    np.testing.assert_allclose(arrow[1:], [[0.005, 0, 0], [-2, 0, 0], [-1, 0, 0]], atol=1e-12)
    assert impact["closed"] == []
    assert told["gap"] == {"pair": 0, "phi": None}
