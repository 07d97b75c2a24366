"""The benchmarks run; their times are not judged here."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]


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
    rows = json.loads(file.read_text())["rows"]
    assert [row["model"] for row in rows] == ["chain 2", "cradle 3"]
    for row in rows:
        assert 0 < row["first"]["min"] <= row["first"]["median"]
        assert row["step"]["min"] > 0
        assert row["iterations"] <= 2
        assert row["residual"] < 1e-10
