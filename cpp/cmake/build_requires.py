"""Print the build requirements of pyproject.toml, the one list that pip and CMake share."""

from pathlib import Path

try:
    import tomllib
except ImportError:  # Python 3.10
    from pip._vendor import tomli as tomllib

PYPROJECT = Path(__file__).resolve().parents[2] / "pyproject.toml"
print("\n".join(tomllib.loads(PYPROJECT.read_text())["build-system"]["requires"]))
