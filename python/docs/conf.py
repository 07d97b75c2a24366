"""Sphinx: the manual as HTML. Needs saltus to be installed, for the reference."""

import re

import saltus

project = "saltus"
author = "The saltus authors"
version = release = saltus.__version__
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
html_theme = "furo"
html_title = f"saltus {release}"
exclude_patterns = ["pictures/*.py"]
myst_heading_anchors = 3  # links to sections of pages are checked
nitpicky = False
napoleon_use_ivar = True  # attributes that a docstring lists; those of the class come besides
autodoc_member_order = "groupwise"
# Names such as `impulses` belong to several classes.
suppress_warnings = ["ref.python"]


def _join_names(app, what, name, thing, options, lines: list[str]) -> None:
    """Join names of parameters that go over several lines, which numpydoc wants in one."""
    for i in range(len(lines) - 2, -1, -1):
        if re.fullmatch(r"[\w, ]+,", lines[i]) and re.fullmatch(r"\w[\w, ]*", lines[i + 1]):
            lines[i : i + 2] = [f"{lines[i]} {lines[i + 1]}"]


def _keep_bars(app, what, name, thing, options, lines: list[str]) -> None:
    """Escape |x|, which docstrings mean as it stands and reST as a substitution."""
    lines[:] = [line.replace("|", r"\|") for line in lines]


def _readme(app, name: str, source: list[str]) -> None:
    """Put the README, which is outside these pages, on its page, and point links there."""
    if name != "readme":
        source[0] = source[0].replace("](../../README.md", "](readme.md")
        return
    text = (app.srcdir.parents[1] / "README.md").read_text(encoding="utf-8")
    text = text.replace("](python/docs/", "](").replace(
        "[CHANGELOG.md](CHANGELOG.md)", "CHANGELOG.md"
    )
    source[0] = re.sub(r"\]\((examples/|tests/|LICENSE|CITATION)", r"](../../\1", text)


def setup(app) -> None:
    """Connect what changes docstrings and pages on their way into the manual."""
    app.connect("autodoc-process-docstring", _join_names, priority=400)  # before numpydoc's
    app.connect("autodoc-process-docstring", _keep_bars)
    app.connect("source-read", _readme)
