"""A recorded motion with methods that show it: pages and videos."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from saltus import view as view_
from saltus.records.recording import Recording


@dataclass(frozen=True, eq=False, repr=False)
class Shown(Recording):
    """A recording that can be looked at; `Trajectory` is one."""

    def html(
        self,
        path: str | os.PathLike[str] | None = None,
        *,
        pairs: Sequence[str] | None = None,
        dark: bool | None = None,
        autoplay: bool = False,
    ) -> str:
        """Make one HTML file that plays the run in a browser, without a server or a network.

        Parameters
        ----------
        path : str or os.PathLike, optional
            File to write.
        pairs : sequence of str, optional
            Pairs of shapes, "a ~ b", whose gap the page plots. None: those that met, then others.
        dark : bool, optional
            True, False: dark, light. None: as the reader's system.
        autoplay : bool
            Whether it plays when it is opened.

        Returns
        -------
        str
            The text of the file.

        Raises
        ------
        ModelError
            Where the run has no model, where no file can be written, on names of pairs that do not
            exist.
        """
        return view_.html(self, path, pairs=pairs, dark=dark, autoplay=autoplay)

    def show(self, path: str | os.PathLike[str] | None = None) -> Path:
        """Open the run in a browser, and print where its page is.

        Parameters
        ----------
        path : str or os.PathLike, optional
            File for the page; None: one among the temporary files.

        Returns
        -------
        pathlib.Path
            Of the page.

        Raises
        ------
        ModelError
            As `html`.
        """
        return view_.show(self, path)

    def video(
        self,
        path: str | os.PathLike[str],
        rate: float = 30.0,
        slow: float = 1.0,
        *,
        size: tuple[int, int] = (1280, 720),
        view: str = "corner",
        follow: str | None = None,
        dark: bool = False,
    ) -> None:
        """Make a video of the run, a WebM file, with a Chromium of this machine.

        Frame k shows the run at t[0] + k / (rate slow).

        Parameters
        ----------
        path : str or os.PathLike
            File to write; its name ends with .webm.
        rate : float
            [1/s] frames.
        slow : float
            How many times slower than the motion the video runs; 0.1 is ten times faster.
        size : (int, int)
            [px] width and height.
        view : str
            Where the camera is: "corner", "front", "side", "top".
        follow : str, optional
            A link that the camera moves along with.
        dark : bool
            Whether the background is dark.

        Raises
        ------
        ModelError
            Where there is no Chromium (the variable SALTUS_CHROMIUM may name one), where the run
            has no model, where no file can be written, on arguments out of their range.
        """
        view_.video(
            self, path, rate=rate, slow=slow, size=size, view=view, follow=follow, dark=dark
        )

    def _repr_html_(self) -> str:
        return view_.notebook_html(self)
