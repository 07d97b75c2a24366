"""What is drawn is what is simulated: silhouettes of all shapes, half-spaces, odd runs, frames."""

from __future__ import annotations

import html
import re
import webbrowser

import h5py
import numpy as np
import pytest
from browser import POSE, assert_poses, quiet, until
from helpers import run_cli
from scenes import cradle, cradle_run

import saltus
from saltus.records.recording import Recording

PAINT = np.array([0xFF, 0x00, 0xFF])  # nothing else on the page has this colour
WHITE = (1.0, 1.0, 1.0)

SHAPES = {
    "sphere": saltus.Sphere(0.2),
    "capsule": saltus.Capsule(0.1, 0.2),
    "box": saltus.Box((0.1, 0.2, 0.3)),
    "cylinder": saltus.Cylinder(0.15, 0.2),
    "ellipsoid": saltus.Ellipsoid((0.1, 0.2, 0.3)),
    "hull": saltus.Convex([(0, 0, 0), (0.4, 0, 0), (0, 0.3, 0), (0, 0, 0.5), (0.2, 0.2, 0.2)]),
}

# Draws one body in one plain colour, without light, shadows, arrows and grid.
PLAIN = """(() => {
  const { page } = saltus;
  page.ground.group.visible = page.arrows.group.visible = false;
  for (const { mesh, items, kind } of page.items.meshes) {
    mesh.visible = kind === 'collision';
    mesh.material = new mesh.material.constructor({ color: 0, emissive: 0xff00ff });
    for (const item of items) {
      item.whole ??= item.local.clone();
      item.local.copy(item.whole);
      if (item.name !== '%s') item.local.makeScale(0, 0, 0);
    }
  }
})()"""


def surface(shape: object, count: int = 4000) -> np.ndarray:
    """Return points of a shape's surface that lie furthest in many directions, shape (n, 3)."""
    d = np.random.default_rng(1).normal(size=(count, 3))
    d /= np.linalg.norm(d, axis=1, keepdims=True)
    match shape:
        case saltus.Sphere():
            return shape.radius * d
        case saltus.Ellipsoid():
            scaled = d * shape.radii
            return scaled * shape.radii / np.linalg.norm(scaled, axis=1, keepdims=True)
        case saltus.Box():
            return np.sign(d) * shape.half
        case saltus.Capsule():
            return shape.radius * d + np.sign(d[:, 2:]) * [0, 0, shape.half_length]
        case saltus.Cylinder():
            rim = d[:, :2] / np.linalg.norm(d[:, :2], axis=1, keepdims=True)
            return np.c_[shape.radius * rim, np.sign(d[:, 2]) * shape.half_length]
        case _:
            return shape.vertices[np.argmax(d @ shape.vertices.T, axis=1)]


POSE_OF_ALL = saltus.Pose.from_rpy(0.4, -0.7, 1.1, (1.0, 2.0, 3.0))


@pytest.fixture(scope="module")
def shapes_tab(browser, tmp_path_factory):
    """Return a page that has all shapes in one place, and its run."""
    builder = saltus.ModelBuilder("shapes").set_gravity((0, 0, 0))
    for name, shape in SHAPES.items():
        builder.add_body(name, shape, mass=1.0, joint="floating")
    start = dict.fromkeys(SHAPES, POSE_OF_ALL)
    run = saltus.simulate(builder.build().without_collisions(), q=start, duration=0.01)
    path = tmp_path_factory.mktemp("shapes") / "shapes.html"
    run.html(path)
    tab = browser.open(path.as_uri(), (800, 560)).ready()
    yield tab, run
    quiet(tab)
    tab.close()


@pytest.mark.parametrize("name", SHAPES)
def test_silhouettes_are_those_of_the_shapes(name, shapes_tab):
    tab, run = shapes_tab
    X = run.model.shape_poses(run.q[:1], name)[0]
    points = surface(SHAPES[name]) @ X[:3, :3].T + X[:3, 3]
    tab.run(PLAIN % name)
    low, high = points.min(axis=0).tolist(), points.max(axis=0).tolist()
    box = "saltus.page.bounds.box"
    tab.run(f"{box}.min.fromArray({low}), {box}.max.fromArray({high})")
    tab.run("saltus.page.look('corner')")  # as if it were alone
    painted = np.argwhere(np.abs(tab.picture() - PAINT).max(axis=2) < 60)[:, ::-1] + 0.5
    true = np.array(tab.run(f"{points.tolist()}.map((p) => saltus.project(p).slice(0, 2))"))
    # In every direction of the picture both reach equally far, to a pixel of the rim and the
    # facets of round shapes: 48 around, 0.2 % of the radius.
    size = np.ptp(true, axis=0).max()
    assert size > 100
    for angle in np.linspace(0, 2 * np.pi, 24, endpoint=False):
        direction = np.array([np.cos(angle), np.sin(angle)])
        reach = [(each @ direction).max() for each in (painted, true)]
        assert reach[0] == pytest.approx(reach[1], abs=1.5 + 0.005 * size)


HALF_SPACES = {
    "floors[0]": ((0, 0, 1), -0.3),
    "floors[1]": ((0.5, 0, 0.8), 0.2),
    "walls[0].face": ((-1, 0, 0.1), -0.9),
}


@pytest.mark.parametrize("shown", [tuple(HALF_SPACES), ("walls[0].face",)])
def test_half_spaces_have_their_offset_and_tilt(shown, open_page):
    builder = saltus.ModelBuilder("planes")
    for name in shown:
        builder.add_half_space(name, *HALF_SPACES[name])
    builder.add_body("b", saltus.Sphere(0.1), mass=1.0, X=saltus.Pose((0, 0, 1)))
    builder.set_default_contact(restitution=1.0, friction=0.0)
    tab = open_page(saltus.simulate(builder.build(), duration=0.1))
    floors = sum(name.startswith("floors") for name in shown)
    # Below a wall alone there is the floor of the grid.
    assert tab.run("saltus.page.ground.floors.length") == max(floors, 1)
    assert tab.run("saltus.page.ground.walls.length") == 1
    for name in shown:
        normal, offset = HALF_SPACES[name]
        n, p = tab.run(f"""(() => {{
          const mesh = saltus.page.ground.{name};
          mesh.updateMatrixWorld();
          const e = mesh.matrixWorld.elements;
          return [e.slice(8, 11), e.slice(12, 15)];
        }})()""")
        unit = np.array(normal) / np.linalg.norm(normal)
        np.testing.assert_allclose(n, unit, atol=POSE)
        assert np.dot(p, normal) == pytest.approx(offset, abs=POSE)
    quiet(tab)


def test_a_notebook_shows_the_page_in_a_frame(browser, tmp_path):
    text = cradle_run()._repr_html_()
    assert text.startswith("<iframe srcdoc=")
    page = tmp_path / "notebook.html"
    page.write_text(f"<!doctype html><h1>notebook</h1>{text}", encoding="utf-8")
    tab = browser.open(page.as_uri())
    inner = "document.querySelector('iframe').contentWindow"
    until(lambda: tab.run(f"{inner}.saltus?.poses !== undefined"))
    assert len(tab.run(f"{inner}.saltus.poses()")) == 3
    assert tab.run(f"{inner}.document.body.classList.contains('closed')") is False
    assert tab.problems == []
    tab.close()


def test_a_run_that_stopped_says_so(open_page):
    def fails(problem: saltus.ImpactProblem) -> np.ndarray:
        raise RuntimeError("no law")

    with pytest.raises(RuntimeError) as stopped:
        saltus.simulate(cradle(), {"swing_0": 0.3}, duration=2.0, law=fails, progress=False)
    run = stopped.value.trajectory
    tab = open_page(run)
    words = tab.run("document.getElementById('notices').textContent")
    assert words == f"This run stopped before its end, at t = {run.t[-1]:g} s."
    tab.seek(run.t[-1])
    assert_poses(tab, run, run.q[-1])
    quiet(tab)


def test_a_run_of_one_row_is_a_picture(open_page):
    def stop(_: float) -> None:
        raise KeyError("at once")

    run = cradle_run()
    values = {name: getattr(run, name) for name in Recording.__dataclass_fields__}
    for name in ("t", "q", "v", "p", "kinetic", "potential", "total", "shadow"):
        values[name] = values[name][:1]
    for name in ("impacts", "impulses", "settlings", "fallbacks"):
        values[name] = values[name][:0]
    one = saltus.Trajectory(**(values | {"certificates": ()}))
    tab = open_page(one)
    assert "one row" in tab.run("document.getElementById('notices').textContent")
    assert tab.run("document.getElementById('play').disabled")
    assert_poses(tab, run, run.q[0])
    quiet(tab)


def test_a_model_without_shapes_is_drawn_by_its_joints(open_page):
    model = saltus.load_urdf(saltus.scenes.chain(4))
    run = saltus.simulate(model, {"joint_0": 0.5}, duration=0.5)
    tab = open_page(run)
    assert "no shapes" in tab.run("document.getElementById('notices').textContent")
    # from each pivot to the next, and from the last to the middle of its link
    threads = tab.run("saltus.page.items.all.filter((i) => i.kind === 'thread').length")
    assert threads == 4
    assert tab.run("document.getElementById('show-frame').checked")
    assert_seen(tab, run)
    quiet(tab)


def assert_seen(tab, run: saltus.Trajectory) -> None:
    """Assert that the last body's centre of mass is in the picture and clear of its words."""
    link = run.model.links[-1]
    head, wide, high = tab.run(
        "[document.getElementById('head').getBoundingClientRect().bottom,"
        " saltus.page.stage.canvas.clientWidth, saltus.page.stage.canvas.clientHeight]"
    )
    for row in (0, -1):
        tab.seek(run.t[row])
        pose = run.model.pose(run.q[row], link.name)
        for p in (pose.p, pose * link.inertia.c_J):
            x, y, _ = tab.run(f"saltus.project({p.tolist()})")
            assert 0 < x < wide
            assert head < y < high


def test_a_mass_without_a_shape_hangs_on_a_thread(open_page):
    builder = saltus.ModelBuilder("pendulum").add_link("bob", saltus.BodyInertia(1, (0, 0, -3)))
    builder.add_joint("swing", "revolute", parent="world", child="bob", axis=(0, 1, 0))
    run = saltus.simulate(builder.build(), {"swing": 3.0}, duration=2.0)
    tab = open_page(run)
    assert_seen(tab, run)
    tab.resize((360, 640))
    tab.run("saltus.page.openPanel(false)")
    tab.settle()
    assert_seen(tab, run)
    drawn = tab.picture()
    tab.run("document.getElementById('show-thread').click()")
    assert (np.abs(drawn - tab.picture()).max(axis=2) > 30).sum() > 100  # px of the thread
    quiet(tab)


def test_a_file_without_a_model_says_what_to_do(tmp_path):
    builder = saltus.ModelBuilder().add_body("b", saltus.Sphere(0.1), mass=1.0)
    model = builder.add_force("calm", lambda now: np.zeros(6)).build()
    saltus.simulate(model, duration=0.1).save(tmp_path / "run.h5")
    run = saltus.load(tmp_path / "run.h5")
    with pytest.raises(saltus.ModelError, match=r"saltus\.load\(path, model=model\)"):
        run.html(tmp_path / "x.html")
    assert run._repr_html_() == f"<pre>{html.escape(repr(run))}</pre>"
    done = run_cli("view", tmp_path / "run.h5", "--html", tmp_path / "x.html")
    assert (done.returncode, done.stdout.count("page:")) == (2, 0)
    assert "this trajectory has no model" in done.stderr
    assert not (tmp_path / "x.html").exists()
    with h5py.File(tmp_path / "run.h5"):
        pass


def test_show_opens_a_browser_and_says_where(monkeypatch, capsys):
    opened = []
    monkeypatch.setattr(webbrowser, "open", lambda url: opened.append(url) or True)
    path = cradle_run().show()
    assert opened == [path.as_uri()]
    assert capsys.readouterr().out == f"page: {path}\n"
    assert re.search(r"<title>cradle_3 · saltus</title>", path.read_text(encoding="utf-8"))
    path.unlink()
    path.parent.rmdir()


def test_show_without_a_browser_says_so(monkeypatch, capsys, tmp_path):
    monkeypatch.setattr(webbrowser, "open", lambda url: False)
    cradle_run().show(tmp_path / "x.html")
    assert "no browser was found: open it by hand" in capsys.readouterr().out
