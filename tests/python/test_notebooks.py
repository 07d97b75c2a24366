"""Notebooks of the manual: each runs from top to bottom and shows what its words predict."""

from __future__ import annotations

import json
import sys

import pytest
from tests.conftest import ROOT

sys.path.insert(0, str(ROOT / "python" / "docs"))
import notebooks

TUTORIALS = ROOT / "python" / "docs" / "tutorials"

PREDICTED = {
    "cradle": [
        "h = 0.005 s: first impact at 0.504614 s",  # 0.50460 and 4 h^2 / 10
        "the ball in the middle moves by less than 1e-12 rad: True",
        "2 of 5 came, these are up on the other side: [3, 4]",
        "the first impact has 6 impulses, 2 * (5 - 2)",
    ],
    "robot": [
        'joint "elbow" names child link "lover", which does not exist; links are post, upper',
        "shoulder lower limit, elbow lower limit",
        "shoulder 7.8480 N m, elbow 0.0000 N m",
        "the balance is kept to 1e-3 J: True",
    ],
    "throw": [
        "first bounce at 0.451524 s",
        "flights, each as a part of the one before: [0.8 0.8 0.8]",
        "speed at the end 2.500000 m/s",
        "it rolls: True",
        "the floor bears 29.430 N",
        "energy lost: 0.320 J",
    ],
    "impacts": [
        "1 impact, at 0.102870 s: 31 contacts",
        "momentum 0.850000 kg m/s, energy 2.125000 J",
        "order_dependent, at most 2 impulses",
        "cue: [-0.25     -0.433013]",
        "cue: [-0.4  0. ]",
        "unique, A4, at most 10 impulses",
        "1 outcome: [0. 0. 0. 1. 1.]",
    ],
    "own": [
        "a part of 0.0687 is left, 0.64 ** 6 = 0.0687",
        "its centre lies 0.115470 m high",
        "speed after 3 s 4.429432 m/s, exactly 4.429432",
    ],
    "many": [
        "16 first impacts, greatest difference from theory 4e-05 s",
        "the same to the last bit: True",
    ],
    "control": [
        "greatest difference from theory 0.005 N",  # 12 / 50^2, of constants in place of a line
        "misses by 0.1000 m, with feedback by 0.0000 m",
        "misses: 1e+00, 4e-01, 2e-02, 6e-05, 4e-10, ",
        "the bat meets the ball at 0.1447 s, at first at 0.1547 s",
    ],
}
PAGES = {"cradle": 1, "robot": 2, "throw": 3, "impacts": 1, "own": 1, "many": 1, "control": 1}
PLOTS = {"cradle": 2, "robot": 1, "throw": 1, "impacts": 0, "own": 1, "many": 1, "control": 1}


def test_each_notebook_has_its_predictions():
    assert {path.stem for path in TUTORIALS.iterdir()} == PREDICTED.keys()


@pytest.mark.parametrize("name", PREDICTED)
def test_it_shows_what_it_predicts(name):
    path = TUTORIALS / f"{name}.ipynb"
    cells = notebooks.cells_of(path.read_text(encoding="utf-8"))
    outputs = [each for shown in notebooks.run_cells(cells, path.name) for each in shown]
    text = "\n".join(each.data for each in outputs if each.kind == "text")
    for line in PREDICTED[name]:
        assert line in text
    html = [each.data for each in outputs if each.kind == "html"]
    assert sum(data.startswith("<iframe srcdoc=") for data in html) == PAGES[name]
    assert sum(data.startswith("<img src=") for data in html) == PLOTS[name]


@pytest.mark.parametrize("name", PREDICTED)
def test_it_is_stored_as_jupyter_wants_it_and_without_outputs(name):
    stored = json.loads((TUTORIALS / f"{name}.ipynb").read_text(encoding="utf-8"))
    assert (stored["nbformat"], stored["nbformat_minor"]) == (4, 5)
    assert stored["metadata"]["kernelspec"]["name"] == "python3"
    cells = stored["cells"]
    assert len({cell["id"] for cell in cells}) == len(cells)
    for cell in cells:
        keys = {"cell_type", "id", "metadata", "source"}
        if cell["cell_type"] == "code":
            assert cell["outputs"] == []
            assert cell["execution_count"] is None
            keys |= {"outputs", "execution_count"}
        assert cell.keys() == keys
    assert cells[0]["source"][0].startswith("# ")  # the title of its page


def notebook(*sources: str) -> str:
    cells = [{"cell_type": "code", "source": [source]} for source in sources]
    title = {"cell_type": "markdown", "source": ["# Title"]}
    return json.dumps({"cells": [title, *cells]})


def test_a_cell_shows_what_jupyter_shows():
    text = notebook("x = 1\nprint('a')\nx + 1", "x + 2;", "None", "print('```')", "y = 3")
    page = notebooks.page_of(text, "x.ipynb")
    assert page.startswith("# Title\n\n*This page is a notebook")
    assert "```text\na\n```\n\n```text\n2\n```\n\n```python\nx + 2;\n```\n\n" in page
    assert "```python\nNone\n```\n\n````python\nprint('```')\n````\n\n````text\n```\n````" in page


def test_a_cell_that_fails_is_named():
    with pytest.raises(ZeroDivisionError) as failed:
        notebooks.page_of(notebook("x = 1", "1 / 0"), "x.ipynb")
    assert any("x.ipynb, cell 3" in str(entry.path) for entry in failed.traceback)
