"""The library's instructions stay within their budget; counted, not timed, so that it is exact."""

from __future__ import annotations

import json
import shutil

import pytest
from tests.bench import instructions


@pytest.mark.slow
def test_instructions_stay_within_the_budget():
    if shutil.which("valgrind") is None:
        pytest.skip(instructions.VALGRIND)
    counted = instructions.measure()
    budget = json.loads(instructions.BUDGET.read_text())
    assert counted["instructions"].keys() == budget["instructions"].keys()
    if counted["platform"] != budget["platform"]:
        pytest.skip(f"the budget is of {budget['platform']}, this is {counted['platform']}")
    over = instructions.excesses(counted, budget)
    assert not over, "\n".join(over)


def test_what_is_above_the_budget_is_named():
    budget = {"instructions": {"step": 1000, "partials": 1000}}
    assert instructions.excesses({"instructions": {"step": 1090, "partials": 500}}, budget) == []
    over = instructions.excesses({"instructions": {"step": 1200, "new": 1}}, budget)
    assert over[0] == "step: 1200 instructions, 20 % above 1000"
    assert over[1] == "new: 1 instructions, no budget"
    assert "--update" in over[2]
