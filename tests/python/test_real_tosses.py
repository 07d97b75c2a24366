"""The benchmark of recorded tosses: measures, loader, calibration, search, and a run of it all.

The recorded tosses are no part of the project, so tosses made by saltus or by hand stand for them.
"""

from __future__ import annotations

import importlib
import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from tests.bench.tosses import data, fit, flight, measures, parameters, report, rotations
from tests.bench.tosses.engines import saltus as saltus_engine
from toss_helpers import MATERIAL, RNG, poses_at, random_start, recorded_rows, save

ROOT = Path(__file__).parents[2]
# Measures


def test_errors_of_known_displacements():
    recorded = poses_at(np.zeros((3, 3)), RNG.normal(size=(3, 3)))
    found = recorded.copy()
    found[:, 0, 3] = data.EDGE * np.array([0.5, 1.0, 0.0])
    turns = np.radians(180.0) * np.array([[1e-8, 0, 0], [0, 30 / 180, 0], [0, 0.6, 0.8]])
    found[:, :3, :3] = rotations.from_turns(turns) @ recorded[:, :3, :3]
    distances, angles = measures.row_errors(found, recorded)
    np.testing.assert_allclose(distances, [0.5, 1.0, 0.0], atol=1e-15)
    # Two matrices of rounding 1e-16 differ by that; sin is flat at 90 degrees, so 180 to its root.
    np.testing.assert_allclose(angles[:2], [180e-8, 30], rtol=1e-7)
    assert angles[2] == pytest.approx(180, abs=1e-5)
    assert measures.toss_errors(found, recorded) == (distances.mean(), angles.mean())


def test_errors_of_unlike_lengths_are_refused():
    with pytest.raises(ValueError, match=re.escape("(2, 4, 4); the recorded ones (3, 4, 4)")):
        measures.row_errors(np.zeros((2, 4, 4)), np.zeros((3, 4, 4)))


def test_a_failed_toss_counts_in_the_median_and_is_told():
    ran = [(0.1, 10.0), (0.2, 40.0)]
    one = measures.summary([*ran, None])
    assert (one.tosses, one.failed) == (3, 1)
    assert (one.position_mean, one.angle_mean) == pytest.approx((0.15, 25))
    assert (one.position_median, one.angle_median) == (0.2, 40)  # the middle of 0.1, 0.2, inf
    assert measures.summary([None]).position_median == np.inf


def test_the_score_bounds_what_a_toss_counts():
    usual = tuple(fit.USUAL)
    assert fit.score([(0.0, 0.0)]) == 0
    assert fit.score([usual]) == pytest.approx(0.5)
    assert fit.score([(1e9, 1e9)]) == pytest.approx(1)
    assert fit.score([usual, "StepError: no"]) == pytest.approx(0.75)


# The loader


def test_tosses_are_read_as_they_were_written(tmp_path):
    lengths = (4, 7)
    pieces = [np.zeros((n, 13)) for n in lengths]
    for piece in pieces:
        piece[:, 3] = 1
    pieces[1][:, :3] = [1, 2, 3]
    pieces[1][:, 3:7] = np.sqrt([0.5, 0, 0, 0.5])  # a quarter turn about z, w first
    pieces[1][:, 7:] = [4, 5, 6, 1, 0, 0]  # spin about the body's x, which is the world's y
    save(tmp_path, pieces)
    tosses = data.load(tmp_path)
    assert [len(toss.poses) for toss in tosses] == [4, 7]
    assert [toss.number for toss in tosses] == [100, 101]
    second = tosses[1]
    assert second.velocities.shape == second.spins.shape == (7, 3)
    np.testing.assert_allclose(
        second.poses[3], [[0, -1, 0, 1], [1, 0, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]], atol=1e-7
    )
    np.testing.assert_allclose(second.velocities[3], [4, 5, 6])
    np.testing.assert_allclose(second.spins[3], [0, 1, 0], atol=1e-7)
    assert data.halves(tosses * 2) == ([0, 2], [1, 3])


def test_missing_data_are_said_plainly(tmp_path):
    call = [sys.executable, "-m", "tests.bench.real_tosses", tmp_path / "nowhere"]
    done = subprocess.run(call, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 1
    assert "nowhere" in done.stderr
    assert "are no part of saltus" in done.stderr
    assert "Traceback" not in done.stderr


def test_wrong_data_are_refused_by_what_is_wrong(tmp_path):
    file = tmp_path / data.FILE
    np.savez(file, rows=np.zeros((3, 13)), start=[0, 3])
    with pytest.raises(ValueError, match="lacks toss; it has rows, start"):
        data.load(tmp_path)
    np.savez(file, rows=np.zeros((3, 12)), start=[0, 3], toss=[1])
    with pytest.raises(ValueError, match=re.escape("(3, 12); it must be (n, 13)")):
        data.load(tmp_path)
    np.savez(file, rows=np.zeros((3, 13)), start=[0, 2], toss=[1])
    with pytest.raises(ValueError, match="ends at 2 of 3 rows"):
        data.load(tmp_path)


# Rotations and the table


@pytest.mark.parametrize("angle", [0.0, 1e-9, 0.3, 2.0, 3.1415])
def test_turns_come_back(angle):
    axes = RNG.normal(size=(20, 3))
    turns = angle * axes / np.linalg.norm(axes, axis=1, keepdims=True)
    matrices = rotations.from_turns(turns)
    products = matrices @ matrices.transpose(0, 2, 1)
    np.testing.assert_allclose(products, np.tile(np.eye(3), (20, 1, 1)), atol=1e-15)
    np.testing.assert_allclose(rotations.to_turns(matrices), turns, atol=1e-12)


def test_the_table_rises_as_its_tilt_says():
    plane = parameters.table({"tilt_x": 0.1, "tilt_y": -0.2, "height": 0.3})
    for x, y in ((0, 0), (1, 0), (0, 1)):
        point = np.array([x, y, 0.3 + 0.1 * x - 0.2 * y])
        assert plane.normal @ point == pytest.approx(plane.offset, abs=1e-15)
    R = parameters.frame(plane)
    np.testing.assert_allclose(R.T @ R, np.eye(3), atol=1e-15)
    np.testing.assert_allclose(R[:, 2], plane.normal)
    assert np.linalg.det(R) == pytest.approx(1)


# Engines


@pytest.mark.parametrize("name", ["saltus", "mujoco", "drake", "pybullet"])
def test_engines_fly_as_closed_forms_say(name):
    pytest.importorskip({"drake": "pydrake"}.get(name, name))
    engine = importlib.import_module(f"tests.bench.tosses.engines.{name}")
    start = random_start(30, height=2.0, seed=1)
    t = data.ROW * np.arange(30)
    places = start.pose[:3, 3] + np.outer(t, start.velocity)
    places[:, 2] -= data.GRAVITY / 2 * t**2
    expected = poses_at(places, np.outer(t, start.spin))
    expected[:, :3, :3] = expected[:, :3, :3] @ start.pose[:3, :3]
    values = {parameter.name: parameter.first for parameter in engine.PARAMETERS}
    for setting in engine.SETTINGS:
        distances, angles = measures.row_errors(engine.simulate(start, values, setting), expected)
        assert distances.max() < 1e-6  # [widths]; a velocity half a step late would make 1e-2
        assert angles.max() < 0.05  # [deg] of 30 or more, steps are of second order


@pytest.mark.parametrize("name", ["saltus", "mujoco", "drake", "pybullet"])
def test_cubes_come_to_rest_on_the_tilted_table(name):
    pytest.importorskip({"drake": "pydrake"}.get(name, name))
    engine = importlib.import_module(f"tests.bench.tosses.engines.{name}")
    start = random_start(300, seed=2)
    values = {parameter.name: parameter.first for parameter in engine.PARAMETERS}
    values |= {"tilt_x": 0.02, "tilt_y": -0.01, "height": 0.003, "friction": 0.4}
    plane = parameters.table(values)
    for setting in engine.SETTINGS:
        last = engine.simulate(start, values, setting)[-1]
        height = plane.normal @ last[:3, 3] - plane.offset
        assert height == pytest.approx(data.EDGE / 2, abs=1e-3)  # soft contacts sink a little
        assert abs(last[:3, :3].T @ plane.normal).max() > 0.9995  # a face lies on the table


# All of it


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    """Return a folder of tosses that saltus made, of a material that it starts not from."""
    folder = tmp_path_factory.mktemp("tosses")
    pieces = []
    for seed in range(8):
        start = random_start(60, height=0.3, seed=seed)
        poses = saltus_engine.simulate(start, MATERIAL, saltus_engine.SETTINGS[0])
        pieces.append(recorded_rows(poses, start.velocity, start.spin))
    save(folder, pieces)
    return folder


def test_tosses_of_saltus_are_found_again_by_saltus(folder):
    """What is recorded is simulated from its first row: only float32 and chaos are between."""
    errors = []
    for toss in data.load(folder):
        start = flight.start(toss, flight.Calibration())
        found = saltus_engine.simulate(start, MATERIAL, saltus_engine.SETTINGS[0])
        errors.append(measures.toss_errors(found, toss.poses))
    one = measures.summary(errors)
    assert one.position_median < 1e-4
    assert one.angle_median < 1e-2


def test_the_benchmark_runs_from_end_to_end(folder, tmp_path):
    file, page = tmp_path / "numbers.json", tmp_path / "page.md"
    call = [sys.executable, "-m", "tests.bench.real_tosses", folder, "--engines", "saltus"]
    call += ["--budget", "60", "--json", file, "--page", page]
    done = subprocess.run(call, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    results = json.loads(file.read_text())
    assert results["tosses"] == {"fitted": 4, "reported": 4}
    (engine,) = results["engines"]
    for start in report.STARTS:
        assert engine["starts"][start]["on_report"]["failed"] == 0
    recorded = engine["starts"]["recorded"]
    assert recorded["fit"]["evaluations"] == 60
    # From the first material, which is not the true one, to nearer than its usual error.
    assert recorded["fit"]["score"] < first_score(folder)
    assert "| saltus |" in done.stdout
    assert page.with_suffix(".png").stat().st_size > 1000
    assert "{" not in page.read_text()


def first_score(folder: Path) -> float:
    values = {parameter.name: parameter.first for parameter in saltus_engine.PARAMETERS}
    errors = []
    for toss in data.load(folder)[::2]:
        start = flight.start(toss, flight.Calibration())
        found = saltus_engine.simulate(start, values, saltus_engine.SETTINGS[0])
        errors.append(measures.toss_errors(found, toss.poses))
    return fit.score(errors)


def test_engines_that_are_not_there_are_said(monkeypatch, tmp_path):
    from tests.bench.tosses import processes

    monkeypatch.setitem(processes.ENGINES, "mujoco", ("no_such_package", "pip install it"))
    assert processes.present(tmp_path, ["mujoco"]) == (
        [],
        ["mujoco: not installed, left out (pip install it)"],
    )
    with pytest.raises(ValueError, match="no engine 'mujuco'; engines are saltus, mujoco"):
        processes.present(tmp_path, ["mujuco"])


def test_the_page_is_that_of_the_template():
    page = (ROOT / "python" / "docs" / "real_tosses.md").read_text(encoding="utf-8")
    for prose in re.split(r"\{\w+\}", report.TEMPLATE.read_text(encoding="utf-8")):
        assert prose in page
