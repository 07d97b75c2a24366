"""Pages of other runs in a real browser: names, many bodies, small screens, forces."""

from __future__ import annotations

import numpy as np
import pytest
from browser import POSE, assert_poses, poses, quiet, until
from scenes import beads, cradle_run, two_bodies
from test_python_rooms import PACKAGE

import saltus

NASTY = ["</script><script>alert(1)</script>", "\"quoted\" & 'single'", "<!-- ünï -->"]


def test_names_of_any_kind_are_safe(open_page):
    builder = saltus.ModelBuilder("</title></script>&\"'").set_gravity((0, 0, 0))
    for i, name in enumerate(NASTY):
        builder.add_body(name, saltus.Sphere(0.05), mass=1.0, X=saltus.Pose((0.2 * i, 0, 0)),
                         joint="prismatic", joint_name=f"x_{i}", axis=(1, 0, 0))  # fmt: skip
    run = saltus.simulate(builder.build(), v={"x_0": 1.0}, duration=0.5)
    tab = open_page(run)
    assert list(poses(tab)) == NASTY
    assert tab.run("document.getElementById('title').textContent") == "</title></script>&\"'"
    tab.run("document.getElementById('show-names').click()")
    tab.png()
    shown = tab.run("[...document.querySelectorAll('#names span')].map((e) => e.textContent)")
    assert sorted(shown) == sorted(NASTY)
    assert tab.run("document.querySelectorAll('script').length") == 1
    quiet(tab)


def test_a_thousand_bodies_are_few_calls(open_page):
    builder = saltus.ModelBuilder("many").set_gravity((0, 0, 0))
    for i in range(1000):
        x, y = 0.2 * (i % 40), 0.2 * (i // 40)
        builder.add_body(f"b{i}", saltus.Sphere(0.05) if i % 2 else saltus.Box((0.04,) * 3),
                         mass=1.0, X=saltus.Pose((x, y, 0)), joint="prismatic",
                         joint_name=f"x{i}", axis=(0, 0, 1))  # fmt: skip
    model = builder.build().without_collisions()
    run = saltus.simulate(model, v={f"x{i}": i / 1000 for i in range(1000)}, duration=0.2)
    tab = open_page(run)
    assert tab.run("saltus.seek(0.1), saltus.calls()") < 20
    assert len(poses(tab)) == 1000
    assert_poses(tab, run, run.q[10])
    quiet(tab)


def test_it_is_usable_at_360_pixels(open_page):
    tab = open_page(cradle_run(), (360, 640))
    assert tab.run("document.documentElement.scrollWidth") <= 360
    assert tab.run("document.body.classList.contains('closed')")
    outside = """[...document.querySelectorAll('button, select, input, output')]
        .map((e) => [e.id, e.getBoundingClientRect()])
        .filter(([, r]) => r.width && (r.left < 0 || r.right > 360)).map(([id]) => id)"""
    small = """[...document.querySelectorAll('#bar button, #corner button')]
        .filter((e) => { const r = e.getBoundingClientRect(); return r.width && r.height < 36; })
        .map((e) => e.id)"""
    assert tab.run(outside) == tab.run(small) == []
    tab.click("#menu")
    assert not tab.run("document.body.classList.contains('closed')")
    assert tab.run(outside) == []
    high = tab.run("document.getElementById('picture').getBoundingClientRect().height")
    assert high > 180  # the picture stays in sight beside the panel
    tab.click("#play")
    until(lambda: tab.run("saltus.time") > 0)


def test_dark_is_dark(open_page):
    tab = open_page(cradle_run(), dark=True)
    assert tab.picture()[:20].mean() < 60
    tab.click("#theme")
    assert tab.picture()[:20].mean() > 200


@pytest.mark.parametrize(
    ("without", "words"),
    [
        (
            "HTMLCanvasElement.prototype.getContext = () => null",
            "This browser cannot draw in 3-D (WebGL 2 is missing): ",
        ),
        ("delete window.DecompressionStream", "This page needs a browser of 2023 or newer: "),
    ],
)
def test_what_a_browser_lacks_is_said(without, words, browser, tmp_path):
    cradle_run().html(tmp_path / "page.html")
    tab = browser.open((tmp_path / "page.html").as_uri(), without=without)
    until(lambda: tab.run("document.body.innerText").startswith(words))
    assert tab.run("document.querySelectorAll('canvas').length") == 0
    tab.close()


def test_a_page_that_is_not_whole_says_so(browser, tmp_path):
    text = cradle_run().html()
    data = text.index('"data":"') + len('"data":"')
    for broken, words in (
        (text[: len(text) // 2], "One moment. If this stays, the file is not whole"),
        (text.replace('{"version"', '{"version', 1), "The data of this page are damaged: "),
        (f"{text[:data]}@@@@{text[data + 4 :]}", "The data of this page are damaged: "),
    ):
        (tmp_path / "page.html").write_text(broken, encoding="utf-8")
        tab = browser.open((tmp_path / "page.html").as_uri())
        until(lambda tab=tab, words=words: tab.run("document.body.innerText").startswith(words))
        tab.close()


def test_without_an_encoder_videos_are_not_offered(browser, tmp_path):
    cradle_run().html(tmp_path / "page.html")
    page = (tmp_path / "page.html").as_uri()
    tab = browser.open(page, without="delete window.VideoEncoder").ready()
    button = "document.getElementById('save-video')"
    assert tab.run(f"{button}.disabled")
    assert tab.run(f"{button}.title") == "This browser has no video encoder."
    words = tab.run("saltus.video({ rate: 30, slow: 1 }).then(() => '', (error) => error.message)")
    assert words == "This browser has no video encoder (WebCodecs); Chromium has one."
    quiet(tab)
    tab.close()


def test_shadows_are_drawn_where_they_are_asked_for(open_page):
    builder = saltus.ModelBuilder("ball").add_floor().set_default_contact(restitution=1, friction=0)
    builder.add_body("ball", saltus.Sphere(0.1), mass=1.0, X=saltus.Pose((0, 0, 0.3)))
    tab = open_page(saltus.simulate(builder.build(), duration=0.1))
    assert not tab.run("document.getElementById('show-shadow').checked")  # no card draws here
    without = tab.picture()
    tab.click("#show-shadow")
    darker = (without - tab.picture()).mean(axis=2)
    assert (darker > 20).sum() > 500  # the shadow of the ball
    assert abs(darker[:50]).max() < 5  # the sky has none
    quiet(tab)


def test_held_forces_are_drawn_where_they_act(open_page):
    model = saltus.ModelBuilder().add_body("box", saltus.Box((0.1,) * 3), mass=2.0,
                                           X=saltus.Pose((0, 0, 0.1))).add_floor()  # fmt: skip
    model.set_default_contact(restitution=0.0, friction=0.5)
    run = saltus.simulate(model.build(), duration=0.2, record_contacts=True)
    tab = open_page(run)
    arrows = tab.run("saltus.seek(0.1), saltus.arrows()")
    assert {arrow["kind"] for arrow in arrows} == {"force"}
    total = np.sum([arrow["vector"] for arrow in arrows], axis=0)
    np.testing.assert_allclose(total, [0, 0, 2 * 9.81], atol=1e-4)
    assert all(abs(arrow["point"][2]) < POSE for arrow in arrows)
    words = tab.run("document.getElementById('legend').textContent")
    assert "contact force" in words


def test_no_source_of_the_page_is_long():
    for path in (PACKAGE / "view" / "page" / "src").iterdir():
        assert len(path.read_text(encoding="utf-8").splitlines()) <= 300, path.name


def test_a_gap_is_chosen_by_name():
    run = saltus.simulate(beads(3).build(), v={"x_0": 1.0}, duration=0.1)
    assert "x_0 ~ x_2" in run.html(pairs=["x_0 ~ x_2"])
    with pytest.raises(saltus.ModelError, match=r'no pair "x_0 ~ x_9".*x_0, x_1, x_2'):
        run.html(pairs=["x_0 ~ x_9"])


def test_free_bodies_turn(open_page):
    model = two_bodies(a=saltus.Box((0.1, 0.2, 0.3)), b=saltus.Capsule(0.1, 0.2)).build()
    start = {"a": saltus.Pose((1, 0, 0)), "b": saltus.Pose((-1, 0, 0))}
    run = saltus.simulate(model, q=start, v={"a": ((0, 0, 0), (1, 2, 3))}, duration=1.0)
    tab = open_page(run)
    tab.run("saltus.seek(1.0)")
    assert_poses(tab, run, run.q[-1])
