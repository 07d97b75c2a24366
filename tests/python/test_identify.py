"""What a cube is made of, from windows of its tosses by gradients; tosses that saltus made."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from tests.bench.tosses import data, flight, identify
from tests.bench.tosses.engines import saltus as saltus_engine
from toss_helpers import MATERIAL, random_start, recorded_rows, save

ROOT = Path(__file__).parents[2]
TRUE = MATERIAL | {"inertia": 9.5e-4, "tilt_x": 0.0, "tilt_y": 0.0, "height": 0.0}
FIRST = {p.name: p.first for p in identify.FREE}


def thrown(seed: int) -> tuple[flight.Start, np.ndarray]:
    """Return how a cube of the true values starts, and its poses."""
    start = random_start(60, height=0.3, seed=seed)
    return start, saltus_engine.simulate(start, TRUE, saltus_engine.SETTINGS[0])


@pytest.fixture(scope="module")
def windows() -> list[identify.Window]:
    tosses = []
    for seed in range(8):
        start, poses = thrown(seed)
        velocities = np.tile(start.velocity, (60, 1))  # only the first row's is used
        tosses.append(data.Toss(seed, poses, velocities, np.tile(start.spin, (60, 1))))
    found = identify.windows(tosses, flight.Calibration(), after=8)
    assert len(found) == 8
    return found


def test_the_misfit_of_the_true_cube_is_zero(windows):
    value, slope = identify.misfit_and_slope(TRUE, windows)
    assert value < 1e-20  # the squares of 1e-12, what arcs are solved to, in usual errors
    assert max(abs(slope[p.name]) * (p.high - p.low) for p in identify.FREE) < 1e-8


@pytest.mark.parametrize("name", FIRST)
def test_its_slope_is_that_of_differences(windows, name):
    value, slope = identify.misfit_and_slope(FIRST, windows)
    assert value == pytest.approx(identify.misfit(FIRST, windows), rel=1e-12)
    h = 1e-4 * FIRST[name]  # truncation of second order 1e-7, rounding 1e-9 of the slope
    up, down = (identify.misfit(FIRST | {name: FIRST[name] + s * h}, windows) for s in (1, -1))
    assert slope[name] == pytest.approx((up - down) / (2 * h), rel=1e-5)


def test_gradients_find_the_cube_where_the_grid_is_least(windows):
    found = identify.identify(windows)
    for name in FIRST:
        assert found.values[name] == pytest.approx(TRUE[name], rel=1e-2)
    assert found.misfit < 1e-6
    cell = {"friction": 0.02, "restitution": 0.03}
    least = identify.grid(windows, found.values, cell, cells=4)
    for name, width in cell.items():
        assert abs(found.values[name] - least[name]) <= width
    assert found.misfit <= identify.misfit(least, windows)
    assert found.evaluations < 81 / 2  # the grid's 81, and a gradient costs as much as a run or two


def test_most_windows_are_smooth(windows):
    verdicts = identify.verdicts(FIRST, windows)
    assert sum(verdicts.values()) == 8
    assert verdicts["smooth"] >= 6


def test_short_tosses_have_no_window():
    start, poses = thrown(0)
    velocities = np.zeros((60, 3))
    n = flight.flight_rows(data.Toss(0, poses, velocities, velocities))
    toss = data.Toss(0, poses[: n + 7], velocities[: n + 7], velocities[: n + 7])
    assert identify.windows([toss], flight.Calibration(), after=7)
    assert identify.windows([toss], flight.Calibration(), after=8) == []
    assert start.rows == 60


def run(folder: Path) -> subprocess.CompletedProcess[str]:
    call = [sys.executable, "-m", "tests.bench.identify", folder, "--every", "1"]
    return subprocess.run(call, cwd=ROOT, capture_output=True, text=True)


def test_the_program_runs_from_end_to_end(tmp_path):
    pieces = []
    for seed in range(16):  # every other one is used
        start, poses = thrown(seed)
        pieces.append(recorded_rows(poses, start.velocity, start.spin))
    save(tmp_path, pieces)
    done = run(tmp_path)
    assert done.returncode == 0, done.stderr
    assert "8 windows, 8 rows after the flight of each" in done.stdout
    assert "gradient: friction 0.2" in done.stdout
    assert "grid of friction and restitution: friction 0.2" in done.stdout
    assert "whole tosses, not used: position mean 0.0" in done.stdout


def test_missing_data_are_said_plainly(tmp_path):
    done = run(tmp_path / "nowhere")
    assert done.returncode == 1
    assert "are no part of saltus" in done.stderr
    assert "Traceback" not in done.stderr
