"""A newcomer's first ten minutes, on the command line: run, look, edit, err, save, load, sweep."""

from __future__ import annotations

import shutil

import numpy as np
import pytest
from helpers import run_cli

import saltus


@pytest.fixture
def cradle(tmp_path):
    """Return a copy of the file that the README begins with, to be changed."""
    return shutil.copy(saltus.urdf_dir() / "newtons_cradle_3.urdf", tmp_path / "mine.urdf")


def test_run_and_look(cradle, tmp_path):
    page, picture = tmp_path / "cradle.html", tmp_path / "cradle.png"
    told = run_cli("simulate", cradle, "--set", "swing_0=0.3", "--plot", picture).stdout
    assert "ball_0 ~ ball_1" in told
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert run_cli("view", cradle, "--html", page).returncode == 0
    assert page.read_text(encoding="utf-8").startswith("<!doctype html>")


def test_edit_the_file(cradle):
    text = cradle.read_text(encoding="utf-8")
    before = saltus.load_urdf(cradle)
    cradle.write_text(text.replace('<mass value="1"/>', '<mass value="2"/>', 1), encoding="utf-8")
    assert saltus.load_urdf(cradle).links[2].mass == 2 * before.links[2].mass
    # a heavy ball goes on after it hit a light one: (2 - 1) / (2 + 1) of its speed, and so on
    run = saltus.simulate(saltus.load_urdf(cradle), {"swing_0": 0.3}, duration=0.51, h=0.001)
    assert run.column("swing_0", "v")[-1] < -0.1


def test_make_a_mistake(cradle):
    text = cradle.read_text(encoding="utf-8")
    cradle.write_text(text.replace('<child link="ball_1"/>', '<child link="bal_1"/>'))
    said = run_cli("info", cradle)
    assert (said.returncode, said.stdout) == (2, "")
    (line,) = said.stderr.splitlines()
    assert "mine.urdf:" in line
    assert "bal_1" in line
    assert "ball_1" in line  # what there is
    said = run_cli("simulate", saltus.urdf_dir() / "newtons_cradle_3.urdf", "--set", "swing=0.3")
    assert said.returncode == 2
    assert "swing_0" in said.stderr


def test_save_load_and_sweep(cradle, tmp_path):
    file = tmp_path / "run.h5"
    assert (
        "trajectory: " in run_cli("simulate", cradle, "--set", "swing_0=0.3", "--out", file).stdout
    )
    run = saltus.load(file)
    assert run.impacts["t"][0] == pytest.approx(0.5046, abs=1e-4)
    angles = np.linspace(0.05, 0.4, 8)
    batch = saltus.simulate_batch(run.model, {"swing_0": angles}, duration=1.0)
    first = [each.impacts["t"][0] for each in batch]
    assert (np.diff(first) > 0).all()  # a pendulum is slower from higher up
