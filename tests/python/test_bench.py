"""The benchmarks run, on models that are the same for all; their times are not judged here."""

from __future__ import annotations

import importlib
import json
import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest
from robot_files import robots_folder
from tests.bench import __main__ as bench
from tests.bench import flops, page, reduce, scenes, table

import saltus

ROOT = Path(__file__).parents[2]

TIME = {"min": 2.0, "median": 3.0}
RESULTS = {
    "machine": {"cpu": "a CPU", "logical": 2, "system": "an OS"},
    "peaks": {"fma_gflops": 10.0, "copy_gbs": 5.0, "triad_gbs": 5.0},
    "versions": ["saltus"],
    "absent": ["Drake: absent (pip install drake)"],
    "errors": [],
    "rows": [
        {"model": f"chain {n}", "kind": "chain", "n": n, "pairs": n * (n + 1) // 2}
        | dict.fromkeys(("first", "step", "mujoco_step"), TIME)
        | {"partials": {"min": float(n), "median": float(n)}, "iterations": 1.0, "allocations": 0}
        for n in (32, 256)
    ],
    "growth": [],
    "impacts": [
        {"model": "cradle 3", "h": 0.001, "smooth": 2.0, "impact": 5.0, "steps": 5}
        | {"impacts": 5, "contacts": 2, "impulses": 10, "arcs": 10}
    ],
    "batch": {},
    "emblem": [],
}


@pytest.mark.slow
def test_quick_benchmarks_run(tmp_path):
    file = tmp_path / "times.json"
    done = subprocess.run(
        [sys.executable, "-m", "tests.bench", "--quick", "--json", file],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert done.returncode == 0, done.stderr
    assert "| chain 2 | 2 |" in done.stdout
    results = json.loads(file.read_text())
    assert results["errors"] == []
    assert [row["model"] for row in results["rows"]] == ["chain 2", "cradle 3"]
    for row in results["rows"]:
        assert 0 < row["first"]["min"] <= row["first"]["median"]
        assert row["step"]["min"] > 0
        assert row["iterations"] <= 2
        assert row["residual"] < 1e-10
        assert row["allocations"] == 0
    for row in results["impacts"]:
        assert (row["impacts"], row["contacts"], row["impulses"], row["arcs"]) == (5, 2, 10, 10)
        assert row["impact"] > row["smooth"] > 0
    assert min(results["peaks"].values()) > 0


def test_the_page_is_made_of_the_numbers(tmp_path):
    results = {**RESULTS, "growth": flops.growth(RESULTS["rows"])}
    file = tmp_path / "speed.md"
    page.write(results, file)
    text = file.read_text()
    assert "| chain 32 | 32 | 32 |" in text
    assert "growth exponent of partials, chain n = 32 to 256: 1.00" in text
    assert "| cradle 3 | 0.001 | 2 | 5 | 2.5 | 2 | 2 | 2 |" in text
    assert "Drake: absent (pip install drake)" in text
    assert "/ Euler" in text
    assert "| / DART" not in text  # a column without numbers
    assert f"]({file.with_suffix('.png').name})" in text
    assert file.with_suffix(".png").stat().st_size > 1000


def test_of_several_rounds_the_least_times_count():
    def row(least: float, **more: object) -> dict:
        return {"n": 2, "step": {"min": least, "median": 9.0}, **more}

    merged = bench.least_of([row(2.0), row(1.0, drake_step=TIME), row(3.0)])
    assert merged == {"n": 2, "step": {"min": 1.0, "median": 9.0}, "drake_step": TIME}


def test_the_fraction_of_the_peak_counts_flops():
    row = {"n": 2, "pairs": 3, "partials": {"min": 1.0}}  # 1122 flops in 1 us
    assert table.fraction_of_peak(row, {"fma_gflops": 11.22}) == pytest.approx(0.1)


def test_pairs_of_ancestors_are_counted():
    assert scenes.ancestor_pairs(scenes.chain(4)) == 10
    assert scenes.ancestor_pairs(scenes.cradle(5)) == 15
    floating = scenes.Scene("", "", scenes.chain(2).urdf, 0.0, floating=True)
    assert scenes.ancestor_pairs(floating) == 21 + 7 + 8


def test_folded_fixed_joints_leave_the_mechanics():
    def inertial(mass: float) -> str:
        return (
            f'<inertial><origin xyz="0.1 0.2 {mass}" rpy="1 2 3"/><mass value="{mass}"/>'
            '<inertia ixx="0.2" iyy="0.3" izz="0.4" ixy="0.01" ixz="0" iyz="0.02"/></inertial>'
        )

    links = "".join(
        f'<link name="{name}">{inertial(i + 1)}</link>' for i, name in enumerate("abcd")
    )
    joints = "".join(
        f'<joint name="{parent}{child}" type="{kind}"><parent link="{parent}"/>'
        f'<child link="{child}"/><origin xyz="{i} 0.5 -1" rpy="{angles}"/><axis xyz="0 1 0"/>'
        "</joint>"
        for i, (parent, child, kind, angles) in enumerate(
            [
                ("w", "a", "continuous", "0.3 0.2 0.1"),
                ("a", "b", "fixed", "0.4 1.5707963267948966 0.5"),  # where roll and yaw are one
                ("b", "c", "fixed", "-1 0.5 2"),
                ("c", "d", "continuous", "0.3 -1.5707963267948966 0"),
            ]
        )
    )
    robot = ET.fromstring(f'<robot name="r"><link name="w"/>{links}{joints}</robot>')
    before = saltus.load_urdf(ET.tostring(robot, encoding="unicode"))
    reduce.without_fixed_joints(robot)
    after = saltus.load_urdf(ET.tostring(robot, encoding="unicode"))
    assert [e.get("name") for e in robot.iterfind("link")] == ["w", "a", "d"]
    q, v = np.array([0.3, -0.7]), np.array([0.5, 1.1])
    expected, found = before.lagrangian(q, v), after.lagrangian(q, v)
    for name in ("L_q", "L_v", "L_qq", "L_vq", "L_vv"):
        np.testing.assert_allclose(getattr(found, name), getattr(expected, name), atol=1e-12)


@pytest.mark.parametrize("engine", ["mujoco", "drake", "dart"])
def test_peers_step_the_same_motion(engine):
    pytest.importorskip({"mujoco": "mujoco", "drake": "pydrake", "dart": "dartpy"}[engine])
    module = importlib.import_module(f"tests.bench.engines.{engine}")
    for scene in (scenes.chain(8), scenes.cradle(3)):
        simulation = module.load(scene)
        simulation.reset()
        simulation.advance(100)
        model = saltus.load_urdf(scene.urdf)
        stepper = saltus.Stepper(model, h=1e-3, collisions=False)
        state = model.state(np.full(model.n_q, scene.angle))
        for _ in range(100):
            state = stepper.advance(state)
        moved = np.abs(state.q - scene.angle).max()
        assert np.abs(simulation.angles() - state.q).max() < 0.02 * moved  # they are of order one


def test_towers_stand_in_their_benchmark():
    call = [sys.executable, "-m", "tests.bench.pile", "--boxes", "2", "--duration", "0.1"]
    done = subprocess.run(call, cwd=ROOT, capture_output=True, text=True, check=True)
    cells = done.stdout.splitlines()[2].split("|")
    assert [cell.strip() for cell in cells[1:4]] == ["2", "saltus", "10"]
    assert float(cells[6]) < 1e-11  # [m] drift, rounding is 1e-14


def test_bodies_are_thrown_in_their_benchmark():
    call = [sys.executable, "-m", "tests.bench.throws", "--count", "3"]
    done = subprocess.run(call, cwd=ROOT, capture_output=True, text=True, check=True)
    rows = [line.split("|")[1:3] for line in done.stdout.splitlines()[2:7]]
    found = {what.split()[0]: int(number) for what, number in rows}
    found.pop("warn")
    assert found == {"runs": 3, "end": 0, "gain": 0, "sink": 0}


def test_dominoes_fall_in_the_benchmark_of_heaps():
    call = [sys.executable, "-m", "tests.bench.piles", "--scene", "dominoes", "--seconds", "0.1"]
    done = subprocess.run(call, cwd=ROOT, capture_output=True, text=True, check=True)
    cells = [cell.strip() for cell in done.stdout.splitlines()[2].split("|")[1:-1]]
    assert cells[:2] == ["dominoes", "0.1 s"]
    assert cells[3] == "20"


def test_the_quadruped_stands_in_its_benchmark():
    robots_folder()  # or skip
    call = [sys.executable, "-m", "tests.bench.standing", "--passes", "1", "--steps", "5"]
    done = subprocess.run(call, cwd=ROOT, capture_output=True, text=True, check=True)
    lines = [line.split("|")[1:-1] for line in done.stdout.splitlines()]
    cells = [cell.strip() for cell in lines[2]]
    assert cells[0] == "saltus"
    assert cells[3] == "4"  # feet on the floor
    assert float(cells[5]) < 1e-5  # [rad/s] seen is 2e-7: servos settle as exp(-t / tau)
    assert [line[0].strip() for line in lines[-3:]] == ["bare", "damping", "servos"]


def test_contact_solvers_settle_in_their_benchmark():
    pytest.importorskip("scipy")
    call = [sys.executable, "-m", "tests.bench.contact_solvers", "--count", "2", "--sizes", "4"]
    done = subprocess.run(call, cwd=ROOT, capture_output=True, text=True, check=True)
    head, _, *rows = [line.split("|")[1:-1] for line in done.stdout.splitlines()]
    column = [name.strip() for name in head].index("saltus")
    assert len(rows) == 8
    for row in rows:
        assert float(row[column].split("(")[1].split(")")[0]) < 1e-12
