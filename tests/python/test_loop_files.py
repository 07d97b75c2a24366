"""Loops on the command line: info lists them, and a run starts with them closed."""

from __future__ import annotations

import numpy as np
import pytest
from tests.python.test_loop_contacts import four_bar_text

import saltus
from saltus.cli.main import main


@pytest.fixture
def four_bar_file(tmp_path):
    path = tmp_path / "four_bar.urdf"
    path.write_text(four_bar_text())
    return path


def test_info_lists_loops(four_bar_file, capsys):
    assert main(["info", str(four_bar_file)]) == 0
    assert "\nloops\n" in capsys.readouterr().out


def test_a_run_starts_with_its_loops_closed(four_bar_file, tmp_path, capsys):
    out = tmp_path / "run.h5"
    start = ["--set", "crank=1", "--set", "coupler=-0.5", "--set", "rocker=-2"]
    assert main(["simulate", str(four_bar_file), *start, "--duration", "0.1"]) == 2
    assert 'loop "pin" stays open' in capsys.readouterr().err  # all three are kept
    one = ["--set", "crank=1", "--duration", "0.1", "--out", str(out)]
    assert main(["simulate", str(four_bar_file), *one]) == 0
    run = saltus.load(out)
    assert run.q[0, 0] == 1.0
    assert np.abs(run.model.loop_gaps(run.q[0])["pin"]).max() < 1e-12
