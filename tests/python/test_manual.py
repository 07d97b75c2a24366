"""The manual as HTML: it builds without a warning, and its reference has everything by topic."""

from __future__ import annotations

import re
import subprocess
import sys
from collections import Counter
from importlib.util import find_spec

import pytest
from tests.conftest import ROOT

import saltus

DOCS = ROOT / "python" / "docs"


@pytest.mark.slow
@pytest.mark.skipif(
    not all(map(find_spec, ("sphinx", "myst_parser", "furo"))),
    reason="needs Sphinx, MyST and furo: sh examples/setup.sh docs",
)
def test_it_builds_without_a_warning(tmp_path):
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", DOCS, tmp_path]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert not done.stderr
    readme = (tmp_path / "readme.html").read_text(encoding="utf-8")
    assert "animation.webp" in readme  # the README is in it, with its pictures
    assert 'href="concepts.html#friction"' in readme
    assert "saltus.Model.jacobian" in (tmp_path / "reference.html").read_text(encoding="utf-8")


def test_the_reference_has_each_name_once():
    text = (DOCS / "reference.rst").read_text(encoding="utf-8")
    listed = Counter(re.findall(r"^\.\. auto\w+:: saltus\.(\w+)$", text, re.MULTILINE))
    public = set(saltus.__all__) - {"__version__"}
    assert public - listed.keys() == set(), "give them a topic in python/docs/reference.rst"
    assert listed.keys() - public == {"plots"}
    assert set(listed.values()) == {1}


def test_each_page_is_in_the_contents():
    text = (DOCS / "index.md").read_text(encoding="utf-8")
    for page in sorted(DOCS.glob("*.md")):
        if page.stem not in ("index", "readme"):
            assert f"]({page.name})" in text, page.name
            assert f"\n   {page.stem}\n" in text, f"{page.name} is in no toctree"
