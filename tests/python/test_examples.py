"""Every example runs in a folder of its own and prints the numbers that its docstring predicts."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from tests.conftest import ROOT

EXAMPLES = sorted((ROOT / "examples").glob("*.py"))

PREDICTED = {
    "bat_a_ball": [
        "misses: 1.0e+00, 4.1e-01, 1.9e-02, 5.6e-05, 4.0e-10, ",
        "below 1e-12 m after 5 steps: True",
        "the bat meets the ball at 0.1447 s, at first at 0.1547 s",
    ],
    "drive_a_cradle": [
        "the motor pulls with 2.6743 N m: miss below 1e-10: True",
        "the others rest, to 1e-10 rad/s: True",
        "step 60 has the impact: one_sided",
    ],
    "hopper": [
        "closed to 1e-10: True, a stride of 0.1950 m",
        "largest Floquet multiplier: 0.2919",
        "1 landing; the floor bears 88.290 N on average",
    ],
    "off_a_wall": [
        "converged: True, the cart meets the wall at 0.5000 s",
        "effort 192.30 N^2 s, of a force that varies freely 192",
        "back at rest to 1e-8: True",
    ],
    "swing_up": [
        "upside down, at rest: |x - x*| below 1e-8: True",
        "last decrements below 1e-4, 1e-8, 1e-15: True, quadratic: True",
    ],
    "balanced_lamp": [
        "pushed, it turns at 0.400 rad/s, and 4 s later at 0.400 rad/s",
        "on a spring of 0.1 m it is 1.21 rad away after 1 s",
    ],
    "billiard_break": [
        "1 impact, at 0.102870 s: 31 contacts",
        "momentum at the end 0.850000 kg m/s along, 0.000000 across",
        "energy at the end 2.125000 J",
    ],
    "bouncing_ball": ["11 impacts, the last at 9.481996 s"],
    "box_on_edge": ["first impact at 0.319275 s, contacts 2: box[+"],
    "compare_engines": [
        "default law, step 10 ms",
        "| 0.000, 0.000, 0.000, 1.000, 1.000",
        "| -0.172, 0.828, 0.828",
    ],
    "cradle_counts": [
        "3 balls, 1 up: 1 left, 2 still, 2 impulses",
        "3 balls, 2 up: 2 left, 1 still, 2 impulses",
        "5 balls, 1 up: 1 left, 4 still, 4 impulses",
        "5 balls, 2 up: 2 left, 3 still, 6 impulses",
        "5 balls, 3 up: 3 left, 2 still, 6 impulses",
    ],
    "cradle_of_thousand": ["at 0.5046 s 999 impulses of 0.9366 N s"],
    "derivative_of_an_impact": [
        "the struck ball ends at 1.200 m",
        "by x1, x2, v1, v2: [1. 0. 1. 0.]",
        "the same backwards: [1. 0. 1. 0.]",
    ],
    "derivatives": ["L_vv[1, 1] = 1.001 kg m^2"],
    "drop_a_box": [
        "meets the floor at 0.319275 s",
        "lies at a height of 0.100000 m, at rest: True",
    ],
    "fig3": ["the right ball reaches 0.9356 m/s"],
    "galton_board": [
        "1010 pairs: 5 balls with 200 pins and 2 walls each",
        "5 balls below the pins",
        "differs from 1 by less than 1e-11",
    ],
    "hello_cradle": ["first impact at 0.50460 s"],
    "hundred_pendulums": ["100 periods, greatest difference from theory 3e-06 s"],
    "identify_cube": [
        "friction 0.1800, restitution 0.1250",
        "fewer than 30 runs of each toss: True",
    ],
    "impulses_at_one_instant": [
        "leave as [-2.0, 0.0, 1.0, 1.0, 3.0], 7 impulses",
        "digits of pi: 3 31 314 3141",
    ],
    "incline": [
        "15 degrees, slope 0.268: stays",
        "25 degrees, slope 0.466: stays",
        "30 degrees, slope 0.577: slides 0.328573 m, speed 0.657145 m/s",
        "35 degrees, slope 0.700: slides 0.804422 m, speed 1.608844 m/s",
    ],
    "laws": [
        "nodal_energy: 99 impacts, error of H below 2e-06 J\n",
        "discrete_energy: 99 impacts, error of H above 1e-04 J\n",
        "shadow_energy: 99 impacts, error of H below 2e-06 J, the shadow energy is kept to 1e-9 J",
    ],
    "servo_step": [
        "after 0.3 s at 0.8009 of the way, exactly 0.800852",
        "energy is the work of the servo, to 1e-12 J: True",
    ],
    "held_arm": [
        "the shoulder bears 19.62 N m, the elbow 4.90 N m",
        "held by motors it drifts by 0.0e+00 rad",
        "held by friction it drifts by 0.0e+00 rad",
    ],
    "own_robot": [
        'names child link "wieght", which does not exist; links are shaft, weight',
        "height after 1 s: -4.905000 m",
    ],
    "pairs": ["27 pairs 0.4 m apart, to 1e-14 m"],
    "quadruped": ["contacts held: 8"],
    "reach": [
        "  to_upper (revolute about -y): upper, 4 kg",
        "elbow at 1.570796 rad",
        "held by 18.3447 N m at the shoulder and 2.6487 N m at the elbow",
        "less than 1e-12 rad/s^2: True",
    ],
    "slider_crank": [
        "impact at 0.3810 s",
        "the crank stands at 1.5281 rad, 0.2 s after it at 1.5281 rad",
    ],
    "stands_up": ["the trunk stands 0.42 m high", "the feet bear 137.34 N"],
    "tippe_top": [
        "its axis points up by 1.00 at first, by -0.95 after 2 s",
        "4.0 times less",
    ],
    "tower": [
        "the contacts of floor bear 39.240 N",
        "the contacts of box_3 bear 9.810 N",
        "energy lost: 0.125 J",
        "less than 1e-9 m/s: True",
    ],
    "which_outcome": [
        "order_dependent, at most 2 impulses cos = -0.2500",
        "one after the other: cue [-0.25, 0.433013]",
        "one after the other: cue [-0.25, -0.433013]",
        "both at once: cue -0.400000, targets [1.2, -0.69282]",
        "five in a line: unique, A4, at most 10 impulses",
    ],
    "where_it_stands": [
        "the cube slides 0.042 m",
        "the floor bears at the end at x = 0.114 m",
    ],
    "see_a_cradle": [
        "6 bodies, in a file of 0.2 MB",
        "first impact at 0.50460 s, 10 in all",
    ],
    "pendulum_and_wall": ["first impact at 0.5105 s", "then every 1.0210 s", "highest 0.5000 rad"],
}
ARGUMENTS = {"compare_engines": ["--quick"]}
SLOW = {"compare_engines", "pairs", "swing_up"}
WRITTEN = {
    "compare_engines": ["compare.png"],
    "fig3": ["fig3.png"],
    "pairs": ["pairs.png"],
    "see_a_cradle": ["cradle.html"],
}


def mark(example: Path) -> object:
    marks = [pytest.mark.slow] if example.stem in SLOW else []
    return pytest.param(example, id=example.stem, marks=marks)


# Runs an example as it is, then draws the last run that it made. Arguments are the path of the
# picture, the example, and its own.
DRAWN = """
import os, runpy, sys
picture, *sys.argv = sys.argv[1:]
sys.path[0] = os.path.dirname(sys.argv[0])
names = runpy.run_path(sys.argv[0], run_name="__main__")
import saltus
runs = [each for each in names.values() if isinstance(each, saltus.Trajectory)]
runs += [each[0] for each in names.values() if isinstance(each, saltus.BatchTrajectory)]
runs += [each.run() for each in names.values() if type(each).__name__ == "Plan"]
if runs:
    figure = runs[-1].plot()
    assert all(axes.lines or axes.collections for axes in figure.axes)
    figure.savefig(picture)
"""
NUMBERS_ALONE = {  # no motion: they ask for derivatives, outcomes, forces or a pose
    "derivative_of_an_impact",
    "derivatives",
    "drive_a_cradle",
    "identify_cube",
    "impulses_at_one_instant",
    "quadruped",
    "reach",
    "which_outcome",
}


@pytest.mark.parametrize("example", [*map(mark, EXAMPLES)])
def test_example_prints_what_it_predicts_and_makes_its_picture(example, tmp_path):
    folder, picture = tmp_path / "empty", tmp_path / "picture.png"
    folder.mkdir()
    done = subprocess.run(
        [sys.executable, "-c", DRAWN, picture, example, *ARGUMENTS.get(example.stem, [])],
        capture_output=True,
        text=True,
        check=True,
        cwd=folder,
        env={**os.environ, "MPLBACKEND": "Agg"},
    )
    assert done.stderr == ""
    for line in PREDICTED[example.stem]:
        assert line in done.stdout
    written = WRITTEN.get(example.stem, [])
    assert sorted(p.name for p in folder.iterdir()) == written
    pictures = [picture] if picture.exists() else [folder / name for name in written]
    assert bool(pictures) != (example.stem in NUMBERS_ALONE)
    assert all(each.stat().st_size > 10_000 for each in pictures), "an empty picture"


def test_differences_of_the_partials_are_small(tmp_path):
    command = [sys.executable, ROOT / "examples" / "derivatives.py"]
    printed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    errors = [float(line.rpartition(" ")[2]) for line in printed.splitlines() if "differs" in line]
    assert len(errors) == 5
    assert max(errors) < 1e-8  # step 1e-5: 1e-10 by truncation, 1e-10 by rounding


def test_examples_are_short():
    for example in EXAMPLES:
        assert len(example.read_text().splitlines()) <= 40, example.name
