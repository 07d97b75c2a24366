"""A program that uses all public names, under mypy --strict, through the package's own types."""

from __future__ import annotations

import re
import runpy
import subprocess
import sys
from importlib.util import find_spec

import pytest
from tests.conftest import ROOT

import saltus

PROGRAM = ROOT / "tests" / "data" / "whole_api.py"


def test_it_uses_every_public_name():
    text = PROGRAM.read_text(encoding="utf-8")
    used = set(re.findall(r"\bsaltus\.(\w+)", text))
    assert set(saltus.__all__) - used == set()


def test_it_runs(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    runpy.run_path(str(PROGRAM), run_name="__main__")
    assert capsys.readouterr().out.splitlines()[-1] == "done"


@pytest.mark.skipif(not find_spec("mypy"), reason="needs mypy: sh examples/setup.sh lint")
def test_types_are_right_in_the_strict_sense(tmp_path):
    # Beside no sources, so that mypy sees what is installed, as a user's mypy does.
    command = [sys.executable, "-m", "mypy", "--strict", "--config-file=", PROGRAM]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    wrong = tmp_path / "wrong.py"
    wrong.write_text("import saltus\n\nsaltus.Sphere('big')\nsaltus.load_urdf('x').n_q.imag_()\n")
    done = subprocess.run([*command[:-1], wrong], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert done.stdout.count("error:") == 2  # it does see types
