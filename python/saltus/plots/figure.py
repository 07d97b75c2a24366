"""Figures, and writing them where a path is given. Needs matplotlib: pip install 'saltus[demo]'."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from saltus._core import ModelError

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def new_figure(path: str | os.PathLike[str] | None, size: tuple[float, float]) -> Figure:
    """Return an empty figure: one of pyplot's where it is to be shown, else a free one."""
    try:
        from matplotlib.figure import Figure
    except ImportError as error:
        raise ModelError(
            f"pictures need matplotlib: pip install 'saltus[demo]' ({error})"
        ) from None
    if path is not None:
        figure = Figure(figsize=size, layout="constrained")
        _check_ending(figure, path)
        return figure
    from matplotlib import pyplot

    return pyplot.figure(figsize=size, layout="constrained")


def finish(figure: Figure, path: str | os.PathLike[str] | None) -> Figure:
    """Write the figure where a path is given."""
    if path is not None:
        figure.savefig(path, dpi=150)
    return figure


def _check_ending(figure: Figure, path: str | os.PathLike[str]) -> None:
    """Raise before anything is drawn where the ending is no format."""
    formats = figure.canvas.get_supported_filetypes()
    ending = Path(path).suffix.removeprefix(".").lower()
    if ending and ending not in formats:  # without one, matplotlib adds its default
        raise ModelError(f'{os.fspath(path)}: no format "{ending}"; there are {", ".join(formats)}')
