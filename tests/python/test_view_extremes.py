"""Pages of scenes that are tiny, huge, far away or late, and of names that are very long."""

from __future__ import annotations

import numpy as np
import pytest
from browser import POSE, assert_poses, quiet

import saltus
from saltus.view.live import Live


def dropped(radius: float, height: float, x: float = 0.0) -> saltus.Model:
    """Return a ball above a floor."""
    builder = saltus.ModelBuilder("drop").add_floor()
    builder.set_default_contact(restitution=0.8, friction=0.3)
    at = saltus.Pose((x, 0, height))
    return builder.add_body("ball", saltus.Sphere(radius), mass=1.0, X=at).build()


@pytest.mark.parametrize(("size", "h"), [(1e-6, 1e-5), (1e6, 10.0)])
def test_a_scene_of_any_size_fills_the_picture(size, h, open_page):
    model = dropped(size, 3 * size)
    run = saltus.simulate(model, duration=100 * h, h=h)
    assert len(run.impacts) > 0
    tab = open_page(run)
    (x, y, _), (side, _, _) = tab.run(
        f"[[0, 0, {3 * size}], [{size}, 0, {3 * size}]].map((p) => saltus.project(p))"
    )
    wide, high = tab.run(
        "[saltus.page.stage.canvas.clientWidth, saltus.page.stage.canvas.clientHeight]"
    )
    assert 0 < x < wide
    assert 0 < y < high
    assert side - x > 50  # its radius on the picture
    squares = tab.run("saltus.page.ground.width")
    assert 0.1 * size < squares < 5 * size
    assert np.ptp(tab.picture()[int(y), int(x) :], axis=0).max() > 30  # the ball, then the floor
    quiet(tab)


def test_far_from_the_origin_it_looks_as_it_does_there(open_page):
    far = 1e6  # m; single precision has 0.06 m there
    near, run = (saltus.simulate(dropped(0.1, 1.0, x), duration=1.0) for x in (0.0, far))
    pictures = []
    for each, x in ((near, 0.0), (run, far)):
        tab = open_page(each)
        assert tab.run("saltus.page.data.origin") == ([far, 0, 1] if x else [0, 0, 0])
        tab.seek(each.t[30])
        at = tab.run("saltus.page.data.t.findLast((t) => t <= saltus.time)")
        row = int(np.argmin(np.abs(each.t - at)))
        tab.seek(each.t[row])
        assert_poses(tab, each, each.q[row])
        tab.seek(each.impacts["t"][0])
        (arrow,) = tab.run("saltus.arrows()")
        np.testing.assert_allclose(arrow["point"], each.impact(0).points[0], atol=POSE)
        tab.run("saltus.page.arrows.group.visible = false")
        pictures.append(tab.picture())
        quiet(tab)
    # The same picture but for rounding along edges of the ball and lines of the grid.
    assert (np.abs(pictures[0] - pictures[1]).max(axis=2) > 20).mean() < 0.01


def test_a_body_far_away_is_pulled_to_where_the_mouse_is():
    model = dropped(0.1, 1.0, 1e6)
    live = Live(model, model.state(), h=0.01)
    live.do(b'{"do": "pull", "body": 0, "at": [0, 0, 0], "to": [0.5, 0, 0]}')
    np.testing.assert_allclose(live.pull.to, [1e6 + 0.5, 0, 1])
    assert live.scene["sliders"][0]["upper"] >= 1e6


def test_late_times_are_told_apart(open_page):
    model = dropped(0.1, 1.0)
    late = 1e9  # s: times differ by 1e-7 at least
    run = saltus.simulate(model, state=model.state(t=late), duration=1.0)
    tab = open_page(run)
    hit = run.impacts["t"][0]
    for t, seen in ((late, 0), (hit - 0.01, 0), (hit, 1), (hit + 0.3, 0)):
        assert len(tab.run(f"saltus.seek({float(t)!r}), saltus.arrows()")) == seen, t - late
    texts = tab.run("""(() => {
      const found = [];
      const { prototype } = OffscreenCanvasRenderingContext2D;
      const own = prototype.fillText;
      prototype.fillText = function (text, ...at) {
        found.push(text);
        own.call(this, text, ...at);
      };
      saltus.page.panel.energyPlot.redraw(saltus.page.theme);
      prototype.fillText = own;
      return found;
    })()""")
    assert texts[-4:-1] == ["1e9", "+0.5", "+1"]
    quiet(tab)


def test_long_names_leave_the_picture_free(open_page):
    builder = saltus.ModelBuilder("long " * 300).set_gravity((0, 0, 0))
    builder.set_default_contact(restitution=1, friction=0)
    for i, name in enumerate(("a" * 300, "b c" * 100)):
        builder.add_body(name, saltus.Sphere(0.05), mass=1.0, X=saltus.Pose((0.2 * i, 0, 0)),
                         joint="prismatic", joint_name=f"x_{i}", axis=(1, 0, 0))  # fmt: skip
    run = saltus.simulate(builder.build(), v={"x_0": 1.0}, duration=0.2)
    tab = open_page(run)
    tab.run("document.getElementById('show-names').click()")
    tab.seek(run.impacts["t"][0])
    for size in ((1100, 700), (360, 640)):
        tab.resize(size)
        assert tab.run("document.getElementById('panel').clientWidth") > 0
        tab.settle()
        sizes = "(e) => [e.getBoundingClientRect().width, e.getBoundingClientRect().height]"
        (title,) = tab.run(f"[document.getElementById('title')].map({sizes})")
        assert title[1] < 60
        for wide, high in tab.run(f"[...document.querySelectorAll('#names span')].map({sizes})"):
            assert (wide < 320, high < 30) == (True, True)
        (table,) = tab.run(f"[document.getElementById('impact-table')].map({sizes})")
        assert table[1] < 80
        assert tab.run("document.documentElement.scrollWidth") <= size[0]
        assert tab.run("document.getElementById('panel').scrollWidth") <= tab.run(
            "document.getElementById('panel').clientWidth"
        )
    quiet(tab)
