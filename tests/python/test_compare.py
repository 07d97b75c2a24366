"""The comparison beside other engines: that like is compared with like, and what is made of it."""

from __future__ import annotations

import dataclasses
import importlib.util
import json
import re
import subprocess
import sys

import numpy as np
import pytest
from tests.conftest import ROOT

import saltus

EXAMPLES = ROOT / "examples"
sys.path.append(str(EXAMPLES))

from compare import measure, processes, report, scenes  # noqa: E402
from compare.scene import Rows  # noqa: E402

SWING = """
import importlib, json, sys
from compare.scene import Scene, record
engine = importlib.import_module("compare.engines." + sys.argv[1])
scene = Scene(**json.load(sys.stdin))
simulation = engine.load(scene)
rows = record(simulation, scene)
print("\\n" + json.dumps([simulation.step, rows.q.tolist(), rows.v.tolist()]))
"""


def swing(engine: str, scene) -> tuple[float, np.ndarray, np.ndarray]:
    """Return the step of an engine, and coordinates and velocities over a scene."""
    done = subprocess.run(
        [sys.executable, "-c", SWING, engine],
        cwd=EXAMPLES,
        input=scene.json(),
        capture_output=True,
        text=True,
        check=True,
    )
    step, q, v = json.loads(done.stdout.splitlines()[-1])
    return step, np.array(q), np.array(v)


@pytest.mark.parametrize("engine", ["mujoco", "pymunk", "dart", "pybullet"])
@pytest.mark.parametrize("balls", [3, 5])
def test_engines_swing_as_saltus_until_the_impact(engine, balls):
    if importlib.util.find_spec(processes.ENGINES[engine]) is None:
        pytest.skip(f"{engine} is not installed")
    scene = scenes.cradle(balls, 1, seconds=0.5)  # the impact is at 0.5046 s
    model = saltus.load_urdf(scene.urdf)
    run = saltus.simulate(model, q=scene.q, duration=0.5, h=0.001, record_every=10)
    step, q, v = swing(engine, scene)
    # Their steps are of first order: velocities are half a step early or late.
    tolerance = 0.5 * step * np.abs(run.v).max() + 1e-4
    np.testing.assert_allclose(q, run.q, atol=tolerance)
    np.testing.assert_allclose(v, run.v, atol=9.81 * 0.3 * 0.5 * step + 3e-4)


def test_saltus_has_the_exact_answers():
    chosen = scenes.all_scenes(quick=True)
    result = processes.run_engine("saltus", chosen)
    assert "error" not in result
    assert result["version"] == saltus.__version__
    assert list(result["scenes"]) == [scene.name for scene in chosen]
    for name, exact in report.EXACT.items():
        np.testing.assert_allclose(result["scenes"][name]["exits"], exact, atol=1e-5)
    assert result["scenes"]["cradle of 5, 2 up"]["resting"] < 1e-12
    assert abs(result["scenes"]["billiard break"]["energy"]) < 1e-12


def test_an_engine_that_fails_says_why():
    result = processes.run_engine("nonsense", scenes.all_scenes(quick=True))
    assert result["scenes"] == {}
    assert "No module named 'compare.engines.nonsense'" in result["error"]
    assert "nonsense failed: ModuleNotFoundError" in report.settings([result], ["x: absent"])
    assert "- x: absent" in report.settings([result], ["x: absent"])


def test_absent_engines_are_named(monkeypatch):
    monkeypatch.setattr(processes, "ENGINES", {"ghost": "no_such_package"})
    assert processes.absent() == [
        "no_such_package: not installed, left out (pip install no_such_package)"
    ]
    assert processes.run_engines([]) == []


def test_first_impact_is_where_theory_has_it():
    assert measure.swing_time(scenes.cradle(3, 1, 1.0)) == pytest.approx(0.504604, abs=1e-6)


def test_mirror_error_is_that_of_partners():
    scene = scenes.billiard()
    start = np.array([scene.v])
    symmetric = np.zeros((1, 32))
    symmetric[0, 4:8] = [1, 2, 1, -2]  # balls 2 and 3 lie opposite
    still = np.zeros((2, 32))
    rows = Rows(np.arange(2.0), still, np.concatenate([start, symmetric]))
    measured = measure.measures(scene, rows)
    assert measured["mirror"] == 0
    assert measured["energy"] == pytest.approx(10 / 25 - 1)
    symmetric[0, 7] = 3
    rows = dataclasses.replace(rows, v=np.concatenate([start, symmetric]))
    assert measure.measures(scene, rows)["mirror"] == pytest.approx(1.0)  # 5 of 5 m/s


def test_page_is_that_of_the_template():
    page = (ROOT / "python" / "docs" / "compare.md").read_text(encoding="utf-8")
    for numbers in report.EXACT.values():
        assert f"| exact    | {report.velocities(numbers)}" in page
    template = (EXAMPLES / "compare" / "page.md").read_text(encoding="utf-8")
    for prose in re.split(r"\{\w+\}", template):
        assert prose in page
