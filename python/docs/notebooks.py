"""Runs notebooks from top to bottom, without Jupyter, and makes pages of the manual from them.

A cell shows what Jupyter shows of it: what it prints, the value of its last expression unless a
semicolon ends it, and the figures that it drew. Magics are not known; our notebooks have none.
"""

from __future__ import annotations

import ast
import base64
import io
import json
import sys
import warnings
from contextlib import redirect_stdout
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any


@dataclass(frozen=True)
class Output:
    """What a cell shows.

    Attributes
    ----------
    kind : {"text", "html"}
    data : str
    """

    kind: str
    data: str


def cells_of(text: str) -> list[tuple[str, str]]:
    """Return the cells of a notebook's JSON: "markdown" or "code", and the source of each."""
    cells = json.loads(text)["cells"]
    return [(cell["cell_type"], "".join(cell["source"])) for cell in cells]


def run_cells(cells: list[tuple[str, str]], name: str) -> list[list[Output]]:
    """Run the cells of code in one namespace, and return what each cell shows.

    Parameters
    ----------
    cells : list of (kind, source)
    name : str
        Of the notebook, for the traceback of a cell that fails.

    Returns
    -------
    list of lists of Output
        None of cells of words.
    """
    import matplotlib

    matplotlib.use("agg")
    space: dict[str, Any] = {"__name__": "__main__"}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return [
            _run(source, f"{name}, cell {number}", space) if kind == "code" else []
            for number, (kind, source) in enumerate(cells, start=1)
        ]


def page_of(text: str, name: str) -> str:
    """Return a notebook as a page in MyST Markdown, with what its cells show."""
    cells = cells_of(text)
    parts = []
    for (kind, source), outputs in zip(cells, run_cells(cells, name), strict=True):
        parts.append(source if kind == "markdown" else _fenced("python", source))
        for output in outputs:
            form = "{raw} html" if output.kind == "html" else "text"
            parts.append(_fenced(form, output.data))
    note = f"*This page is a notebook: {{download}}`{name} <{name}>` runs in Jupyter.*"
    return "\n\n".join([parts[0], note, *parts[1:]]) + "\n"


def _run(source: str, place: str, space: dict[str, Any]) -> list[Output]:
    tree = ast.parse(source, place)
    last = tree.body[-1] if tree.body else None
    shows = isinstance(last, ast.Expr) and not source.rstrip().endswith(";")
    printed, value = io.StringIO(), None
    with redirect_stdout(printed):
        body = tree.body[:-1] if shows else tree.body
        exec(compile(ast.Module(body, []), place, "exec"), space)
        if shows and isinstance(last, ast.Expr):
            value = eval(compile(ast.Expression(last.value), place, "eval"), space)
    outputs = [Output("text", printed.getvalue())] if printed.getvalue() else []
    if value is not None:
        outputs.append(_shown(value))
    return outputs + _figures()


def _shown(value: object) -> Output:
    html = getattr(value, "_repr_html_", lambda: None)()
    return Output("text", repr(value)) if html is None else Output("html", html)


def _figures() -> list[Output]:
    """Return the figures that pyplot holds, as pictures, and close them."""
    if "matplotlib.pyplot" not in sys.modules:
        return []
    from matplotlib import pyplot

    pictures = []
    for number in pyplot.get_fignums():
        data = io.BytesIO()
        pyplot.figure(number).savefig(data, format="png", dpi=100)
        text = base64.b64encode(data.getvalue()).decode()
        pictures.append(Output("html", f'<img src="data:image/png;base64,{text}" alt="plot">'))
    pyplot.close("all")
    return pictures


def _fenced(form: str, text: str) -> str:
    ticks = "`" * max(3, 1 + max((len(run) for run in _runs_of_ticks(text)), default=0))
    return f"{ticks}{form}\n{text.rstrip()}\n{ticks}"


def _runs_of_ticks(text: str) -> list[str]:
    import re

    return re.findall("`+", text)


def main(paths: list[str]) -> None:
    """Run notebooks, and print what their cells show."""
    for path in map(Path, paths):
        cells = cells_of(path.read_text(encoding="utf-8"))
        for outputs in run_cells(cells, path.name):
            for output in outputs:
                html = f"({len(output.data)} characters of HTML)"
                print(output.data.rstrip() if output.kind == "text" else escape(html))


if __name__ == "__main__":
    main(sys.argv[1:])
