"""Sphinx: the manual as HTML. Needs saltus to be installed, for the reference."""

import saltus

project = "saltus"
author = "The saltus authors"
version = release = saltus.__version__
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
html_theme = "furo"
suppress_warnings = ["myst.xref_missing"]  # README, outside these pages
