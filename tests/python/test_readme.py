"""README and the manual: their code is that of the files and runs, their links lead somewhere."""

from __future__ import annotations

import doctest
import re
import subprocess
import sys

import numpy as np
import pytest
from test_examples import PREDICTED
from tests.conftest import ROOT

import saltus
from saltus.cli.main import main

README = ROOT / "README.md"
PAGES = [README, *sorted((ROOT / "python" / "docs").glob("*.md"))]


def by_name(path):
    return path.stem


def blocks(path, language: str) -> list[str]:
    text = path.read_text(encoding="utf-8")
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def test_hello_is_the_file():
    assert (ROOT / "examples" / "hello_cradle.cpp").read_text() in blocks(README, "cpp")


def test_first_program_of_readme_does_what_its_comments_say(tmp_path):
    (code, _) = blocks(README, "python")
    command = [sys.executable, "-W", "error", "-c", code]
    done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=tmp_path)
    assert done.stdout.startswith("first impact at 0.5046 s\nimpact at t = 0.504644 s: 2 impulses")
    assert (tmp_path / "cradle.png").stat().st_size > 20_000


def test_python_of_readme_runs(tmp_path):
    (_, code) = blocks(README, "python")
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=tmp_path)
    assert done.stderr == ""
    assert done.stdout.splitlines()[-1] == "[0. 1.]"  # as its comment says


def test_output_of_readme_is_what_is_printed(capsys):
    file = str(ROOT / "urdf" / "newtons_cradle_3.urdf")
    assert main(["simulate", file, "--set", "swing_0=0.3", "--duration", "10", "--h", "0.01"]) == 0
    lines = capsys.readouterr().out.splitlines()[-3:]
    assert len(lines) == 3
    readme = README.read_text(encoding="utf-8")
    for line in lines:
        assert f"    {line}\n" in readme


def test_numbers_of_the_examples_are_those_they_print():
    text = README.read_text(encoding="utf-8")
    cells = [
        cell for line in text.splitlines() if "](examples/" in line for cell in line.split("|")
    ]
    said = [(cell, re.findall(r"\d+\.\d{3,}", cell)) for cell in cells]
    checked = 0
    for cell, numbers in said:
        for number in numbers:
            example = re.search(r"examples/(\w+)\.py", cell)
            assert example, cell
            assert any(number in line for line in PREDICTED[example[1]]), cell
            checked += 1
    assert checked >= 7


def test_all_examples_are_in_readme():
    text = README.read_text(encoding="utf-8")
    for file in [*(ROOT / "examples").glob("*.py"), *(ROOT / "examples").glob("*.cpp")]:
        assert f"](examples/{file.name})" in text, file.name


def test_pictures_of_readme_are_small_and_move():
    image = pytest.importorskip("PIL.Image")
    folder = ROOT / "python" / "docs" / "pictures"
    files = sorted(folder.glob("*.webp"))
    assert sum(file.stat().st_size for file in files) < 600_000
    assert (folder / "animation.webp").stat().st_size <= 400_000
    for file in files:
        used = [page for page in PAGES if f"/{file.name})" in page.read_text(encoding="utf-8")]
        assert used, f"no page shows {file}"
        picture = image.open(file)
        assert picture.n_frames >= 50 if file.stem == "animation" else picture.n_frames == 1
        assert np.asarray(picture.convert("L")).std() > 3, f"{file}: nothing is drawn"


@pytest.mark.slow
@pytest.mark.usefixtures("browser")  # which is absent in words where it is
def test_the_script_beside_the_pictures_makes_them(tmp_path):
    image = pytest.importorskip("PIL.Image")
    folder = ROOT / "python" / "docs" / "pictures"
    cells = re.findall(r"\| !\[.*\|$", README.read_text(encoding="utf-8"), re.MULTILINE)
    grid = re.findall(r"/(\w+)\.webp\)", "".join(cells))
    assert len(grid) == 9
    names = ["first", "plot", *grid]
    command = [sys.executable, folder / "make.py", "--to", tmp_path, *names]
    subprocess.run(command, check=True, capture_output=True, text=True)
    for name in names:
        own, kept = (
            np.asarray(image.open(where / f"{name}.webp").convert("L"), dtype=float)
            for where in (tmp_path, folder)
        )
        assert own.shape == kept.shape, name
        assert np.abs(own - kept).mean() < 3, f"{name}.webp is not what make.py makes now"


def test_tests_named_in_readme_exist():
    rows = re.findall(r"^\|.*\| `(\w+)` \|$", README.read_text(encoding="utf-8"), re.MULTILINE)
    assert len(rows) >= 10
    sources = "".join(p.read_text() for p in (ROOT / "tests" / "cpp").rglob("test_*.cpp"))
    for name in rows:
        assert re.search(rf"TEST\w*\(\w+, {name}", sources), name


@pytest.mark.parametrize("page", PAGES, ids=by_name)
def test_links_lead_somewhere(page):
    text = re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.M | re.S)
    links = re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", text)
    assert links, "a page nobody leaves"
    for link in links:
        if not link.startswith("https://"):
            assert (page.parent / link).exists(), link


class ShortNames(doctest.OutputChecker):
    """The compiled part's exceptions are known to users by the package's name."""

    def check_output(self, want: str, got: str, optionflags: int) -> bool:
        return super().check_output(want, got.replace("saltus._core.", "saltus."), optionflags)


@pytest.mark.parametrize("page", PAGES[1:], ids=by_name)
def test_dialogues_of_the_manual_go_as_printed(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    runner = doctest.DocTestRunner(ShortNames(), optionflags=doctest.ELLIPSIS)
    text = page.read_text(encoding="utf-8")
    dialogue = doctest.DocTestParser().get_doctest(text, {}, page.stem, str(page), 0)
    said: list[str] = []
    runner.run(dialogue, out=said.append)
    assert not runner.failures, "".join(said)


@pytest.mark.parametrize("page", [p for p in PAGES[1:] if blocks(p, "python")], ids=by_name)
def test_programs_of_the_manual_run(page, tmp_path):
    code = "\n".join(blocks(page, "python"))
    command = [sys.executable, "-W", "error", "-c", code]
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, check=False)
    assert done.returncode == 0, done.stderr


def test_urdf_of_the_manual_loads():
    (text,) = blocks(ROOT / "python" / "docs" / "urdf.md", "xml")
    model = saltus.load_urdf(text)
    assert model.pair_names == ["ball ~ floor", "ball ~ ramp", "ball ~ world"]
    assert not model.warnings


@pytest.mark.parametrize("file", sorted((ROOT / "urdf").glob("*.urdf")), ids=by_name)
def test_info_knows_the_files_in_urdf(file, capsys):
    assert main(["info", str(file)]) == 0
    assert capsys.readouterr().out.startswith(f"{file.stem}: ")
