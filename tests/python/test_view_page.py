"""The page of a cradle in a real browser: poses, time, impacts, arrows, keys, plots, labels."""

from __future__ import annotations

import numpy as np
import pytest
from browser import POSE, assert_poses, poses, quiet, true_poses
from scenes import cradle_run

import saltus


@pytest.fixture(scope="module")
def cradle_tab(browser, tmp_path_factory):
    path = tmp_path_factory.mktemp("cradle") / "cradle.html"
    cradle_run().html(path)
    tab = browser.open(path.as_uri()).ready()
    yield tab
    quiet(tab)
    tab.close()


NEAREST = "saltus.page.data.t.findLast((t) => t <= saltus.time)"


def test_poses_are_those_of_the_run(cradle_tab):
    run = cradle_run()
    for row in (0, 50, 101, 200):
        cradle_tab.seek(run.t[row])
        shown = cradle_tab.run("saltus.time")
        assert shown == run.t[row]
        nearest = int(np.argmin(np.abs(run.t - cradle_tab.run(NEAREST))))
        cradle_tab.seek(run.t[nearest])
        assert_poses(cradle_tab, run, run.q[nearest])


def test_between_rows_poses_follow_the_motion(cradle_tab):
    # A step to a time between rows: cubic positions and even turns of 1/60 s are true to 1e-5.
    run = cradle_run()
    state = saltus.Stepper(run.model, h=0.0043).advance(run.state(30))
    cradle_tab.seek(state.t)
    for name, X in true_poses(run, state.q).items():
        np.testing.assert_allclose(poses(cradle_tab)[name][:3], X[:3, 3], atol=1e-5)


def test_jumps_to_impacts_are_exact(cradle_tab):
    run = cradle_run()
    cradle_tab.run("saltus.seek(0)")
    for t in run.impacts["t"]:
        cradle_tab.click("#next")
        assert cradle_tab.run("saltus.time") == pytest.approx(t, abs=1e-9)
    cradle_tab.click("#next")
    assert cradle_tab.run("document.getElementById('status').textContent").startswith("No impact")
    cradle_tab.click("#previous")
    assert cradle_tab.run("saltus.time") == pytest.approx(run.impacts["t"][-2], abs=1e-9)
    cradle_tab.settle()
    assert cradle_tab.run("document.getElementById('impact-title').textContent") == (
        f"Impact {len(run.impacts) - 1} of {len(run.impacts)}"
    )


def test_bodies_touch_at_the_impact(cradle_tab):
    run = cradle_run()
    cradle_tab.seek(run.impacts["t"][0])
    shown = poses(cradle_tab)
    for a, b in (("ball_0", "ball_1"), ("ball_1", "ball_2")):
        assert np.linalg.norm(shown[a][:3] - shown[b][:3]) == pytest.approx(0.1, abs=POSE)


def test_arrows_are_at_the_impact_and_nowhere_else(cradle_tab):
    run = cradle_run()
    t = float(run.impacts["t"][0])
    before, at, after = (
        cradle_tab.run(f"saltus.seek({time!r}), saltus.arrows()") for time in (t - 0.01, t, t + 0.3)
    )
    assert before == after == []
    impact = run.impact(0)
    assert [arrow["pair"] for arrow in at] == impact.pairs
    vectors = impact.lambdas[:, None] * impact.normals
    np.testing.assert_allclose([arrow["point"] for arrow in at], impact.points, atol=POSE)
    np.testing.assert_allclose([arrow["vector"] for arrow in at], vectors, atol=POSE)


def test_pixels_of_the_arrow_are_where_the_contact_is(cradle_tab):
    impact = cradle_run().impact(0)
    cradle_tab.seek(impact.t)
    picture = cradle_tab.picture()
    red = np.argwhere(np.abs(picture - [0xE8, 0x48, 0x1C]).max(axis=2) < 40)
    ends = [cradle_tab.run(f"saltus.project({point.tolist()})") for point in impact.points]
    for x, y, _ in ends:
        assert np.abs(red - [y, x]).sum(axis=1).min() < 6
    cradle_tab.seek(impact.t - 0.02)
    without = cradle_tab.picture()
    assert (np.abs(without - [0xE8, 0x48, 0x1C]).max(axis=2) < 40).sum() < 0.1 * len(red)


def test_it_plays_by_the_clock(cradle_tab):
    cradle_tab.run("saltus.seek(0), saltus.page.clock.setSpeed(0.5)")
    first = cradle_tab.picture()
    cradle_tab.key(" ")
    # Of the page's own clock: from one frame to a later one, model time is half of the wall's.
    passed = cradle_tab.run("""new Promise((done) => {
        const { clock } = saltus.page;
        let start = null;
        const look = () => {
          if (clock.last !== null) {
            start ??= [clock.last, clock.time];
            if (clock.last > start[0] + 300) {
              return done([clock.last - start[0], clock.time - start[1]]);
            }
          }
          requestAnimationFrame(look);
        };
        look();
      })""")
    assert passed[1] == pytest.approx(0.5e-3 * passed[0], rel=1e-9)
    cradle_tab.key(" ")
    time = cradle_tab.run("saltus.time")
    assert not cradle_tab.run("saltus.page.clock.playing")
    assert (cradle_tab.picture() != first).any()
    assert cradle_tab.run("saltus.time") == time > 0
    cradle_tab.run("saltus.page.clock.setSpeed(1)")


def test_scrubbing_sets_the_time(cradle_tab):
    cradle_tab.run("saltus.seek(0)")
    cradle_tab.click("#time")  # its middle
    assert cradle_tab.run("saltus.time") == pytest.approx(1.0, abs=0.01)
    cradle_tab.click("#energies")  # time axis from 46 px to 8 px before the end
    wide = cradle_tab.run("document.getElementById('energies').clientWidth")
    part = (wide / 2 - 46) / (wide - 54)
    assert cradle_tab.run("saltus.time") == pytest.approx(2.0 * part, abs=0.02)


def test_keys_do_what_the_panel_says(cradle_tab):
    cradle_tab.run("saltus.seek(0.3), saltus.page.clock.setSpeed(1)")
    cradle_tab.key("ArrowRight")
    assert cradle_tab.run("saltus.time") == pytest.approx(0.3 + 1 / 60, abs=1e-12)
    cradle_tab.key("ArrowRight", shift=True)
    assert cradle_tab.run("saltus.time") == pytest.approx(0.50464, abs=1e-4)
    cradle_tab.key("End")
    assert cradle_tab.run("saltus.time") == 2.0
    cradle_tab.key("Home")
    assert cradle_tab.run("saltus.time") == 0.0
    cradle_tab.key("[")
    assert cradle_tab.run("saltus.page.clock.speed") == 0.5
    cradle_tab.key("]")
    cradle_tab.key("4")
    down = "saltus.page.stage.camera.getWorldDirection(saltus.page.up.clone()).z"
    assert cradle_tab.run(down) == pytest.approx(-1, abs=1e-3)
    cradle_tab.key("1")
    theme = cradle_tab.run("document.documentElement.dataset.theme")
    cradle_tab.key("t")
    assert cradle_tab.run("document.documentElement.dataset.theme") != theme
    cradle_tab.key("t")


def test_energies_and_gap_are_those_of_the_run(cradle_tab):
    run = cradle_run()
    row = 100
    cradle_tab.seek(run.t[row])
    words = cradle_tab.run("document.getElementById('energy-line').textContent")
    assert f"{run.total[row]:.4g} J" in words
    cradle_tab.seek(run.impacts["t"][0])
    phi = cradle_tab.run("saltus.page.panel.gap.phi[saltus.page.data.impacts.instant[0]]")
    assert abs(phi) < 1e-9
    assert cradle_tab.run("document.getElementById('pair').selectedOptions[0].text") == (
        "ball_0 ~ ball_1"
    )


def test_a_followed_body_stays_in_its_place(cradle_tab):
    cradle_tab.run("saltus.seek(0), saltus.page.look('front'), saltus.page.follow(1)")
    body = cradle_tab.run("saltus.page.data.bodies[1]")
    at = cradle_tab.run("saltus.page.views.at.toArray()")
    cradle_tab.run("saltus.seek(0.5)")
    run = cradle_run()
    moved = run.model.pose(run.q[50], body).p - run.model.pose(run.q[0], body).p
    now = cradle_tab.run("saltus.page.views.at.toArray()")
    np.testing.assert_allclose(np.subtract(now, at), moved, atol=POSE)
    cradle_tab.run("saltus.page.follow(null), saltus.page.look('corner')")


def test_the_picture_is_named_for_those_who_do_not_see_it(cradle_tab):
    nameless = cradle_tab.run("""[...document.querySelectorAll('button, input, select, canvas')]
        .filter((e) => e.getAttribute('aria-hidden') !== 'true')
        .filter((e) => !(e.getAttribute('aria-label') || e.textContent.trim()
                         || e.labels?.length && [...e.labels].some((l) => l.textContent.trim())))
        .map((e) => e.id || e.outerHTML)""")
    assert nameless == []
    label = cradle_tab.run("document.getElementById('view').getAttribute('aria-label')")
    assert label.startswith("Picture of cradle_3, 6 bodies")
    cradle_tab.run("saltus.seek(1.25)")
    told = cradle_tab.run("document.getElementById('time').getAttribute('aria-valuetext')")
    assert told == "1.2500 s"
    assert cradle_tab.run("document.getElementById('status').getAttribute('role')") == "status"
    tree = cradle_tab.ask("Accessibility.getFullAXTree")["nodes"]
    names = {node.get("name", {}).get("value") for node in tree}
    assert {"Play", "Next impact", "Time", "Speed"} <= names


def test_a_cradle_has_threads(cradle_tab):
    assert cradle_tab.run("saltus.page.items.all.filter((i) => i.kind === 'thread').length") == 3
