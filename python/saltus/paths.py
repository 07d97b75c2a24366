"""Where the installed package keeps its C++ side and its models."""

from __future__ import annotations

from pathlib import Path

from saltus import _core


def cmake_dir() -> Path:
    """Return the folder to put on CMAKE_PREFIX_PATH, so that `find_package(saltus)` works.

    Returns
    -------
    pathlib.Path
    """
    # Not this file's folder: an editable install keeps Python files and compiled ones apart.
    return Path(_core.__file__).resolve().parent


def urdf_dir() -> Path:
    """Return the folder of the URDF files that come with the package.

    Returns
    -------
    pathlib.Path
    """
    return cmake_dir() / "share" / "saltus" / "urdf"
