"""The manual as HTML: it builds without a warning, and its reference has everything by topic."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from collections import Counter
from importlib.util import find_spec

import pytest
from tests.conftest import ROOT

import saltus

DOCS = ROOT / "python" / "docs"
HEADERS = ROOT / "cpp" / "include"
needs_doxygen = pytest.mark.skipif(
    not shutil.which("doxygen"), reason="doxygen is not installed: apt-get install doxygen"
)


@pytest.mark.slow
@pytest.mark.skipif(
    not all(map(find_spec, ("sphinx", "myst_parser", "furo", "breathe"))),
    reason="needs Sphinx, MyST, furo and Breathe: sh examples/setup.sh docs",
)
@needs_doxygen
def test_it_builds_without_a_warning(tmp_path):
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", DOCS, tmp_path]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert not done.stderr
    readme = (tmp_path / "readme.html").read_text(encoding="utf-8")
    assert "animation.webp" in readme  # the README is in it, with its pictures
    assert 'href="concepts.html#friction"' in readme
    assert "saltus.Model.jacobian" in (tmp_path / "reference.html").read_text(encoding="utf-8")
    tutorial = (tmp_path / "tutorials" / "cradle.html").read_text(encoding="utf-8")
    assert tutorial.count("<iframe srcdoc=") == 1  # the run plays in it
    assert "first impact at 0.504614 s" in tutorial
    steps = (tmp_path / "cpp" / "steps.html").read_text(encoding="utf-8")
    assert "saltus::Stepper::advance" in steps
    assert "The state h later." in steps  # words of the header
    assert "namespace saltus" not in steps


@needs_doxygen
def test_members_of_the_headers_for_users_have_words(tmp_path):
    settings = (ROOT / "cpp" / "Doxyfile").read_text(encoding="utf-8")
    done = subprocess.run(
        ["doxygen", "-"],
        input=f'{settings}\nOUTPUT_DIRECTORY = "{tmp_path}"\n',
        cwd=ROOT / "cpp",
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert (tmp_path / "xml" / "classsaltus_1_1Stepper.xml").exists()


def test_each_header_for_users_is_on_one_page_of_the_reference():
    settings = (ROOT / "cpp" / "Doxyfile").read_text(encoding="utf-8").replace("\\\n", " ")
    left_out = re.search(r"^EXCLUDE_PATTERNS\s*=(.*)$", settings, re.MULTILINE).group(1).split()
    read = [
        path.name
        for path in sorted(HEADERS.rglob("*.hpp"))
        if not any(path.match(pattern.removeprefix("*/")) for pattern in left_out)
    ]
    pages = [path.read_text(encoding="utf-8") for path in sorted((DOCS / "cpp").glob("*.rst"))]
    listed = re.findall(r"^\.\. doxygenfile:: (\w+\.hpp)$", "".join(pages), re.MULTILINE)
    assert sorted(listed) == sorted(set(read) - {"saltus.hpp"})  # that one includes the others


def test_the_reference_has_each_name_once():
    text = (DOCS / "reference.rst").read_text(encoding="utf-8")
    listed = Counter(re.findall(r"^\.\. auto\w+:: saltus\.(\w+)$", text, re.MULTILINE))
    public = set(saltus.__all__) - {"__version__"}
    assert public - listed.keys() == set(), "give them a topic in python/docs/reference.rst"
    assert listed.keys() - public == {"plots"}
    assert set(listed.values()) == {1}


def test_the_theory_has_each_section_that_the_code_names():
    theory = (DOCS / "theory.md").read_text(encoding="utf-8")
    there = set(re.findall(r"^(?:## |\*\*)(\d|F\d|O\d?)\.", theory, re.MULTILINE))
    one = r"(?:\d|F\d|O\d?)\b"
    named = set()
    for folder in ("cpp", "python/saltus", "python/bindings"):
        for path in (ROOT / folder).rglob("*.[hcp][py]*"):
            text = re.sub(r"\n\s*//+", "", path.read_text(encoding="utf-8"))
            sections = rf"[Tt]heory[,:]? (?:sections? )?({one}(?:(?:,| and) {one})*)"
            for where in re.findall(sections, text):
                named |= set(re.split(r", | and ", where))
    assert {"2", "5", "7", "F1", "O2"} <= named
    assert named <= there


def test_pictures_of_the_concepts_are_what_their_script_draws(tmp_path):
    script = DOCS / "pictures" / "concepts.py"
    subprocess.run([sys.executable, script, tmp_path], check=True)
    for drawn in tmp_path.iterdir():
        now, kept = (
            re.findall(r"<text[^>]*>([^<]*)</text>", path.read_text(encoding="utf-8"))
            for path in (drawn, DOCS / "pictures" / drawn.name)
        )
        assert now == kept != [], drawn.name
    assert len(list(tmp_path.iterdir())) == 3


def test_each_page_is_in_the_contents():
    text = (DOCS / "index.md").read_text(encoding="utf-8")
    for page in sorted([*DOCS.glob("*.md"), *DOCS.glob("tutorials/*.ipynb")]):
        if page.stem not in ("index", "readme"):
            name = page.relative_to(DOCS)
            assert f"]({name})" in text, name
            assert f"\n   {name.with_suffix('')}\n" in text, f"{name} is in no toctree"
