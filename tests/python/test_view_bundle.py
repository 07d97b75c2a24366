"""The bundle of the page is what its sources give, and its licences are those of its packages."""

from __future__ import annotations

import json
import shutil
import subprocess

import pytest
from test_python_rooms import PACKAGE

PAGE = PACKAGE / "view" / "page"


@pytest.mark.slow
def test_the_bundle_is_that_of_its_sources(tmp_path):
    if not shutil.which("npm") or not shutil.which("node"):
        pytest.skip("node and npm are not installed")
    for name in ("package.json", "package-lock.json"):
        shutil.copy(PAGE / name, tmp_path)
    shutil.copytree(PAGE / "src", tmp_path / "src")
    quiet = {"cwd": tmp_path, "capture_output": True, "text": True}
    installed = subprocess.run(["npm", "ci", "--no-audit", "--no-fund"], **quiet)
    if installed.returncode and ("network" in installed.stderr or "EAI" in installed.stderr):
        pytest.skip("npm cannot reach its registry")
    assert installed.returncode == 0, installed.stderr
    built = subprocess.run(["npm", "run", "build"], **quiet)
    assert built.returncode == 0, built.stderr
    same = (tmp_path / "bundle.js").read_bytes() == (PAGE / "bundle.js").read_bytes()
    assert same, f"run npm ci && npm run build in a copy of {PAGE}, and keep its bundle.js"


def test_packages_are_pinned_and_their_licences_are_here():
    package = json.loads((PAGE / "package.json").read_text())
    lock = json.loads((PAGE / "package-lock.json").read_text())["packages"]
    licences = (PAGE / "LICENSES.txt").read_text(encoding="utf-8")
    for name, version in {**package["dependencies"], **package["devDependencies"]}.items():
        assert lock[f"node_modules/{name}"]["version"] == version  # exact, no range
    for name, version in package["dependencies"].items():
        assert f"==== {name} {version}" in licences
        assert lock[f"node_modules/{name}"]["license"] == "MIT"
