"""Where example-robot-data has its files."""

from __future__ import annotations

import importlib.metadata
from pathlib import Path

import pytest


def robots_folder() -> Path:
    try:
        data = importlib.metadata.distribution("example-robot-data")
    except importlib.metadata.PackageNotFoundError:
        pytest.skip("example-robot-data is not installed: pip install 'saltus[robots]'")
    return Path(data.locate_file("cmeel.prefix/share/example-robot-data/robots")).resolve()
