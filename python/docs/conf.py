"""Sphinx: the manual as HTML. Needs saltus to be installed, for the reference."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

from docutils import nodes
from sphinx import addnodes

import saltus

sys.path.insert(0, str(Path(__file__).parent))
import notebooks  # beside this file

project = "saltus"
author = "The saltus authors"
version = release = saltus.__version__
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
HAS_DOXYGEN = bool(shutil.which("doxygen"))  # without it the C++ reference is one sentence
if HAS_DOXYGEN:
    extensions.append("breathe")
breathe_default_project = "saltus"
source_suffix = {".rst": "restructuredtext", ".md": "markdown", ".ipynb": "markdown"}
html_theme = "furo"
html_title = f"saltus {release}"
exclude_patterns = ["pictures/*.py"]
myst_heading_anchors = 3  # links to sections of pages are checked
nitpicky = False
napoleon_use_ivar = True  # attributes that a docstring lists; those of the class come besides
autodoc_member_order = "groupwise"
# Names such as `impulses` belong to several classes, and each header opens the namespace again.
suppress_warnings = ["ref.python", "duplicate_declaration.cpp"]


def _join_names(app, what, name, thing, options, lines: list[str]) -> None:
    """Join names of parameters that go over several lines, which numpydoc wants in one."""
    for i in range(len(lines) - 2, -1, -1):
        if re.fullmatch(r"[\w, ]+,", lines[i]) and re.fullmatch(r"\w[\w, ]*", lines[i + 1]):
            lines[i : i + 2] = [f"{lines[i]} {lines[i + 1]}"]


def _keep_bars(app, what, name, thing, options, lines: list[str]) -> None:
    """Escape |x|, which docstrings mean as it stands and reST as a substitution."""
    lines[:] = [line.replace("|", r"\|") for line in lines]


def _notebook(app, name: str, source: list[str]) -> None:
    """Run a notebook, and put what its cells show on its page."""
    path = Path(app.env.doc2path(name))
    if path.suffix == ".ipynb":
        source[0] = notebooks.page_of(source[0], path.name)


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


def _read_headers(app) -> None:
    """Run Doxygen over the C++ headers; raise RuntimeError with what it misses."""
    if not HAS_DOXYGEN:
        return
    folder = Path(app.doctreedir).absolute() / "doxygen"
    folder.mkdir(parents=True, exist_ok=True)
    cpp = Path(app.srcdir).parents[1] / "cpp"
    settings = (cpp / "Doxyfile").read_text(encoding="utf-8")
    done = subprocess.run(
        ["doxygen", "-"],
        input=f"{settings}\nOUTPUT_DIRECTORY = \"{folder}\"\n",
        cwd=cpp, capture_output=True, text=True, check=False,
    )  # fmt: skip
    if done.returncode or done.stderr:
        raise RuntimeError(f"doxygen: {done.stderr}")
    app.config.breathe_projects = {"saltus": str(folder / "xml")}


def _cpp_page(app, name: str, source: list[str]) -> None:
    """Say in words what is missing where there is no Doxygen."""
    if name.startswith("cpp/") and not HAS_DOXYGEN:
        head = source[0].partition("\n\n")[0]
        source[0] = f"{head}\n\nThis manual was built without Doxygen, which makes this page.\n"


def _without_namespace(app, tree) -> None:
    """Leave out the namespace about the names of each header, and headers about each class."""
    for namespace in list(tree.findall(addnodes.desc)):
        if namespace[0].astext().strip() == "namespace saltus":
            _, *names = namespace[1]  # but what is said of the namespace
            namespace.replace_self(names)
    for words in list(tree.findall(nodes.emphasis)):
        if words.astext().startswith("#include <"):
            words.parent.remove(words)


def setup(app) -> None:
    """Connect what changes docstrings and pages on their way into the manual."""
    app.connect("builder-inited", _read_headers, priority=1)  # before breathe's
    app.connect("source-read", _cpp_page)
    app.connect("doctree-read", _without_namespace, priority=100)  # before contents are made
    app.connect("autodoc-process-docstring", _join_names, priority=400)  # before numpydoc's
    app.connect("autodoc-process-docstring", _keep_bars)
    app.connect("source-read", _notebook)
    app.connect("source-read", _readme)
