"""A run as a page: as text, as a file, in a browser, in a notebook."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from saltus.records.recording import Recording
from saltus.records.replace import check_folder
from saltus.view.page import in_frame, page_of, write_page
from saltus.view.scene import scene_of_run

FRAME = 480  # px, height in a notebook
MOST_TEXT = 20_000_000  # characters in a cell of a notebook; it is stored in the notebook's file


def html(
    run: Recording,
    path: str | os.PathLike[str] | None = None,
    *,
    pairs: Sequence[str] | None = None,
    dark: bool | None = None,
    autoplay: bool = False,
) -> str:
    """Return the page of a run, and write it where a path is given; see `Trajectory.html`."""
    if path is not None:
        check_folder(path)  # before the work
    scene = scene_of_run(run, pairs=pairs)
    scene["autoplay"] = autoplay
    if dark is not None:
        scene["theme"] = "dark" if dark else "light"
    text = page_of(scene)
    if path is not None:
        write_page(path, text)
    return text


def show(run: Recording, path: str | os.PathLike[str] | None = None) -> Path:
    """Write the page of a run and open it in a browser; see `Trajectory.show`."""
    import tempfile
    import webbrowser

    if path is None:
        title = run.require_model().name
        name = "".join(c if c.isalnum() else "_" for c in title)
        path = Path(tempfile.mkdtemp(prefix="saltus-")) / f"{name or 'run'}.html"
    html(run, path, autoplay=True)
    path = Path(path).absolute()
    if not webbrowser.open(path.as_uri()):
        print(f"page: {path} (no browser was found: open it by hand)")
    else:
        print(f"page: {path}")
    return path


def notebook_html(run: Recording) -> str:
    """Return what a notebook shows of a run: its page in a frame, or one line where it has none."""
    from html import escape

    if run.model is None:
        return f"<pre>{escape(repr(run))}</pre>"
    text = html(run)
    if len(text) > MOST_TEXT:
        words = f"{run!r}: its page has {len(text) / 1e6:.0f} MB, run.show() opens it"
        return f"<pre>{escape(words)}</pre>"
    return in_frame(text, FRAME)
