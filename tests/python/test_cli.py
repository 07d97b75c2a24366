"""The command line, through a process of its own."""

from __future__ import annotations

import os
import re
import subprocess
import sys

import pytest
from helpers import run_cli
from scenes import chain_on_a_body

import saltus

CRADLE = saltus.urdf_dir() / "newtons_cradle_3.urdf"
CERTIFIED = "2 impulses on 2 contacts; unique, A2, at most 3 impulses"


def assert_one_line(done: subprocess.CompletedProcess[str], code: int, *parts: str) -> None:
    assert done.returncode == code, done.stderr
    assert len(done.stderr.splitlines()) == 1, done.stderr
    for part in parts:
        assert part in done.stderr
    assert "Traceback" not in done.stderr


def test_simulate_does_what_the_manual_shows(tmp_path):
    out, picture = tmp_path / "run.h5", tmp_path / "cradle.png"
    done = run_cli(
        "simulate", CRADLE, "--set", "swing_0=0.3", "--duration", "10", "--h", "0.01",
        "--law", "nodal_energy", "--out", out, "--plot", picture,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    lines = done.stdout.splitlines()
    assert lines[0].split()[:2] == ["t", "[s]"]
    assert lines[1].startswith("  0.5046")
    assert "ball_0 ~ ball_1 (" in lines[1]
    assert "ball_1 ~ ball_2 (" in lines[1]
    assert "energy error" in done.stdout
    assert picture.stat().st_size > 10_000
    run = saltus.load(out)
    assert len(run) == 1001
    assert f"{len(run.impacts)} impacts" in done.stdout


def test_long_tables_are_cut_and_can_be_had():
    arguments = ("simulate", CRADLE, "--set", "swing_0=0.3", "--duration", "20")
    short = run_cli(*arguments).stdout
    everything = run_cli(*arguments, "--all-impacts").stdout
    assert "more impacts (--all-impacts prints them)" in short
    assert len(short.splitlines()) < len(everything.splitlines())
    assert "more impacts" not in everything


def test_impacts_on_several_contacts_are_summed_up_and_drawn(tmp_path):
    picture = tmp_path / "impacts.png"
    done = run_cli(
        "simulate", CRADLE, "--set", "swing_0=0.3", "--duration", "2", "--plot-impacts", picture
    )
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    sums = [line for line in lines if line.strip() == CERTIFIED]
    assert len(sums) == 2
    assert lines[2] == sums[0]  # below its impact
    assert lines[-1] == f"picture of impacts: {picture}"
    assert picture.stat().st_size > 5_000
    wall = saltus.urdf_dir() / "pendulum_and_wall.urdf"  # one contact: nothing to sum up
    assert "contact" not in run_cli("simulate", wall, "--set", "swing=0.5").stdout


def test_other_options_of_simulate(tmp_path):
    out, model = tmp_path / "run.h5", tmp_path / "chain.urdf"
    model.write_text(chain_on_a_body(3))
    done = run_cli(
        "simulate", model, "--set", "joint_0=0.3", "--set", "joint_2=-0.3", "--set-velocity",
        "joint_1=0.5", "--duration", "1", "--h", "0.005", "--law", "discrete_energy",
        "--record-every", "10", "--no-collisions", "--floating", "--out", out,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    run = saltus.load(out)
    assert len(run) == 21
    assert run.options.law is saltus.ImpactLaw.discrete_energy
    assert run.options.collisions is False
    assert (run.model.n_q, run.model.n_v) == (10, 9)
    assert run.column("joint_2")[0] == -0.3
    assert run.column("joint_1", "v")[0] == pytest.approx(0.5)


def test_info(tmp_path):
    done = run_cli("info", CRADLE)
    assert done.returncode == 0, done.stderr
    head = (
        "newtons_cradle_3: 7 links, 6 joints, 6 coordinates, 6 velocities, 3 shapes, 3 gaps, 3 kg"
    )
    assert head in done.stdout
    assert "Sphere(0.05)" in done.stdout
    kinds = [line.split() for line in done.stdout.splitlines() if "sphere ~ sphere" in line]
    assert kinds == [["sphere", "~", "sphere", "3"]]
    assert "ball_0 ~ ball_2" not in done.stdout
    assert "ball_0 ~ ball_2" in run_cli("info", CRADLE, "--pairs").stdout
    chain = tmp_path / "chain.urdf"
    chain.write_text(chain_on_a_body())
    assert "shapes: none" in run_cli("info", chain).stdout
    assert "root_x" in run_cli("info", chain, "--floating").stdout


def lone_ball() -> str:
    """Return a ball of radius 0.1 that nothing holds, as URDF text."""
    joint_to_end = r'  <joint name="swing_0".*?</joint>\n'
    text = re.sub(joint_to_end, "", saltus.scenes.cradle(1, sways=False, radius=0.1), flags=re.S)
    return text.replace('  <link name="frame"/>\n', "").replace('xyz="0 0 -1"', 'xyz="0 0 0"')


def test_a_robot_is_dropped_on_a_floor_in_one_line(tmp_path):
    path, out = tmp_path / "ball.urdf", tmp_path / "run.h5"
    path.write_text(lone_ball())
    drop = ("--floating", "--floor", "--set", "root_z=0.6")
    done = run_cli("simulate", path, *drop, "--contact", "0,0.5", "--duration", "1", "--out", out)
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    run = saltus.load(out)
    assert run.column("root_z")[-1] == pytest.approx(0.1, abs=1e-9)
    assert run.model.default_contact == saltus.ContactProperties(restitution=0, friction=0.5)
    assert run.model.pair_names == ["ball_0 ~ floor"]
    info = run_cli("info", path, "--floor", "--floating", "--contact", "0.3,0.5")
    assert info.stderr == ""
    assert "default contact: restitution 0.3, friction 0.5" in info.stdout
    assert_one_line(run_cli("simulate", path, *drop), 0, "ModelWarning", "--contact 0,0.5")


def test_info_tells_pairs_of_shapes_from_the_gaps_of_their_parts():
    box = saltus.urdf_dir() / "box_on_edge.urdf"
    plain = run_cli("info", box).stdout
    assert "2 shapes, 8 gaps, 3 kg" in plain
    pairs = run_cli("info", box, "--pairs").stdout.split("\npairs\n")[1].splitlines()
    assert [line.split("  ") for line in pairs[1:]] == [
        ["", "box ~ floor", "box ~ half_space", "8"]
    ]
    gaps = run_cli("info", box, "--gaps").stdout.split("\ngaps\n")[1].split("\n  ")
    assert "box[+-+] ~ floor" in gaps
    assert len(gaps) == 1 + 8


def test_warnings_of_a_model_are_one_line_each(tmp_path):
    path = tmp_path / "m.urdf"
    path.write_text(saltus.scenes.chain(1).replace("<robot ", "<robot frobnicate='1' "))
    done = run_cli("info", path)
    assert_one_line(done, 0, "ModelWarning", "frobnicate")


def test_cmake_dir_and_version():
    assert run_cli("cmake-dir").stdout.strip() == str(saltus.cmake_dir())
    assert run_cli("--version").stdout.strip() == f"saltus {saltus.__version__}"
    assert "simulate" in run_cli("--help").stdout


SIMULATE = ("simulate", CRADLE, "--duration", "1")


@pytest.mark.parametrize(
    ("arguments", "parts"),
    [
        (("info", "nowhere.urdf"), ["nowhere.urdf"]),
        (("simulate", "nowhere.urdf"), ["nowhere.urdf"]),
        ((*SIMULATE, "--set", "elbow=1"), ['no coordinate "elbow"', "swing_0"]),
        ((*SIMULATE, "--set-velocity", "elbow=1"), ['no velocity "elbow"']),
        ((*SIMULATE, "--set", "swing_0=much"), ["'much' in 'swing_0=much' is no number"]),
        ((*SIMULATE, "--set", "swing_0"), ["not of the form NAME=VALUE"]),
        ((*SIMULATE, "--set", "swing_0=nan"), ['q["swing_0"] = nan is not finite']),
        ((*SIMULATE, "--set-velocity", "sway_1=inf"), ['v["sway_1"] = inf is not finite']),
        ((*SIMULATE, "--set", "swing_0=-0.05"), ["ball_0 ~ ball_1"]),
        ((*SIMULATE, "--h", "0"), ["h"]),
        ((*SIMULATE, "--h", "x"), ["--h", "'x'"]),
        (("simulate", CRADLE, "--duration", "-1"), ["duration"]),
        ((*SIMULATE, "--law", "newton"), ["newton", "nodal_energy", "discrete_energy"]),
        ((*SIMULATE, "--out", "/nowhere/run.h5"), ["/nowhere/run.h5", "no folder"]),
        ((*SIMULATE, "--plot", "/nowhere/run.png"), ["/nowhere/run.png"]),
        ((*SIMULATE, "--plot", "run.nonsense"), ["run.nonsense"]),
        ((*SIMULATE, "--plot-impacts", "/nowhere/run.png"), ["/nowhere/run.png"]),
        ((*SIMULATE, "--plot-impacts", "run.nonsense"), ["run.nonsense"]),
        ((*SIMULATE, "--contact", "0.5"), ["'0.5' is not of the form E,MU", "0,0.5"]),
        ((*SIMULATE, "--contact", "0,much"), ["'0,much' is not two numbers"]),
        ((*SIMULATE, "--contact", "1.5,0"), ["'1.5,0'", "restitution 1.5; it is in [0, 1]"]),
        ((*SIMULATE, "--contact", "0,-1"), ["friction -1"]),
        (("fly",), ["fly"]),
        ((), ["COMMAND"]),
    ],
)
def test_errors_of_the_user_are_one_line(arguments, parts):
    assert_one_line(run_cli(*arguments), 2, *parts)


def test_a_wrong_ending_is_told_before_the_run():
    done = run_cli(*SIMULATE, "--plot", "run.png.x")
    assert_one_line(done, 2, 'run.png.x: no format "x"; there are', "png")
    assert done.stdout == ""


def test_a_bad_file_is_named_with_its_line(tmp_path):
    path = tmp_path / "bad.urdf"
    path.write_text(saltus.scenes.chain(1).replace('value="0.2"', 'value="-0.2"'))
    assert_one_line(run_cli("info", path), 2, "bad.urdf:", "mass")
    path.write_text("<robot")
    assert_one_line(run_cli("info", path), 2, "bad.urdf:")
    path.write_bytes(bytes(range(256)))
    assert_one_line(run_cli("info", path), 2, "bad.urdf")


def test_a_step_that_fails_is_one_line(tmp_path):
    path = tmp_path / "chain.urdf"
    path.write_text(saltus.scenes.chain(40))
    fast = [part for i in range(40) for part in ("--set-velocity", f"joint_{i}={(-1) ** i * 50}")]
    done = run_cli("simulate", path, "--h", "5", "--duration", "50", *fast)
    assert_one_line(done, 1, "t = ")


def test_a_closed_pipe_is_no_error():
    command = f"{sys.executable} -m saltus info --pairs {CRADLE} | head -c 1"
    done = subprocess.run(command, shell=True, capture_output=True, text=True, check=True)
    assert done.stderr == ""


INTERRUPTED = """
import os, signal, sys, threading
from saltus.__main__ import main
threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT)).start()
sys.exit(main())
"""


@pytest.mark.skipif(os.name != "posix", reason="signals")
def test_ctrl_c_writes_what_is_done(tmp_path):
    out = tmp_path / "run.h5"
    command = [sys.executable, "-c", INTERRUPTED, "simulate", CRADLE, "--set", "swing_0=0.3"]
    command += ["--duration", "1e6", "--record-every", "100", "--out", out]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.returncode == 130, done.stderr
    assert "stopped after" in done.stderr
    run = saltus.load(out)
    assert not run.complete
    assert len(run) > 1
