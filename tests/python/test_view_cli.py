"""`saltus view`: what it simulates, what it writes, what it refuses."""

from __future__ import annotations

import pytest
from browser import quiet, until

import saltus
from saltus.cli.main import main

URDF = saltus.urdf_dir()


def test_a_cradle_at_rest_is_started_and_its_page_plays(tmp_path, capsys, open_page_of):
    page = tmp_path / "cradle.html"
    assert main(["view", str(URDF / "newtons_cradle_3.urdf"), "--html", str(page)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "at rest as it stands; started with swing_0 = 0.3"
    assert lines[-1] == f"page: {page}"
    tab = open_page_of(page)
    assert tab.run("saltus.page.clock.end") == 10.0
    assert tab.run("saltus.page.data.autoplay")
    until(lambda: tab.run("saltus.time") > 0)
    quiet(tab)


def test_bodies_that_overlap_are_moved_apart(tmp_path, capsys):
    page = tmp_path / "ball.html"
    file = str(URDF / "bouncing_ball.urdf")
    assert main(["view", file, "--duration", "1", "--html", str(page)]) == 0
    assert "bodies overlap as it stands; moved apart: height = 0.1" in capsys.readouterr().out
    assert page.exists()


def test_a_recorded_run_is_shown_as_it_is(tmp_path, capsys):
    file, run, page = (tmp_path / name for name in ("c.urdf", "run.h5", "run.html"))
    file.write_text(saltus.scenes.cradle(2))
    start = ["--set", "swing_0=0.2", "--duration", "1"]
    assert main(["simulate", str(file), *start, "--out", str(run)]) == 0
    assert main(["view", str(run), "--html", str(page)]) == 0
    assert f"page: {page}" in capsys.readouterr().out
    assert main(["view", str(run), *start[:2], "--floor", "--html", str(page)]) == 2
    assert "is a recorded run; --set, --floor can be given with a URDF file" in (
        capsys.readouterr().err
    )


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["no.h5", "--html", "x.html"], "no.h5: there is no such file"),
        (["no.urdf", "--html", "x.html"], "no.urdf"),
        (["cradle", "--html", "no/x.html"], "there is no folder no"),
        (["cradle", "--live", "--html", "x.html"], "--html writes a recorded run"),
        (["cradle", "--video", "x.mp4", "--duration", "0.1"], "their names end with .webm"),
    ],
)
def test_errors_are_one_line(arguments, words, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    own = [str(URDF / "newtons_cradle_3.urdf") if a == "cradle" else a for a in arguments]
    assert main(["view", *own]) == 2
    said = capsys.readouterr().err
    assert words in said
    assert len(said.splitlines()) == 1
    assert not list(tmp_path.iterdir())


def test_the_file_that_is_read_is_kept(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    file, run = tmp_path / "c.urdf", tmp_path / "run.h5"
    file.write_text(saltus.scenes.cradle(2))
    saltus.simulate(saltus.load_urdf(file), duration=0.1).save(run)
    (tmp_path / "link.html").symlink_to(run)
    before = file.read_bytes(), run.read_bytes()
    for words in (
        ["view", "c.urdf", "--html", str(file)],
        ["view", "run.h5", "--html", "./run.h5"],
        ["view", "run.h5", "--html", "link.html"],
        ["simulate", "c.urdf", "--duration", "0.1", "--out", "c.urdf"],
        ["simulate", "c.urdf", "--duration", "0.1", "--plot", "c.urdf"],
    ):
        assert main(words) == 2
        said = capsys.readouterr().err
        assert "is the file that is read; name another to be written" in said
        assert len(said.splitlines()) == 1
    assert (file.read_bytes(), run.read_bytes()) == before


def test_what_a_file_draws_is_on_the_page(tmp_path, monkeypatch):
    seen = []
    monkeypatch.setattr(saltus.Trajectory, "html", lambda run, *_, **__: seen.append(run))
    page = str(tmp_path / "page.html")
    assert main(["view", str(URDF / "arm.urdf"), "--duration", "0.01", "--html", page]) == 0
    assert seen[0].model.visuals
