"""Sphinx: the manual as HTML. Needs saltus to be installed, for the reference."""

import saltus

project = "saltus"
author = "The saltus authors"
version = release = saltus.__version__
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
html_theme = "furo"
# README is outside these pages; names such as `impulses` belong to several classes.
suppress_warnings = ["myst.xref_missing", "ref.python"]


def _keep_bars(app, what, name, thing, options, lines: list[str]) -> None:
    """Escape |x|, which docstrings mean as it stands and reST as a substitution."""
    lines[:] = [line.replace("|", r"\|") for line in lines]


def setup(app) -> None:
    """Connect what changes docstrings on their way into the reference."""
    app.connect("autodoc-process-docstring", _keep_bars)
