"""Frames of live pages: what a page is told that has seen an earlier one."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Frame:
    """What pages are told at a time.

    Attributes
    ----------
    number : int
        From 1 on; 0: no frame.
    text : str
        JSON of what all pages are told alike.
    beginning : int
        Number of the last reset; numbers of impacts begin anew with each.
    impacts : tuple of (int, str)
        The last impacts: number, and JSON.
    """

    number: int = 0
    text: str = ""
    beginning: int = 0
    impacts: tuple[tuple[int, str], ...] = ()

    @property
    def last(self) -> int:
        """Number of the last impact, 0 where there is none."""
        return self.impacts[-1][0] if self.impacts else 0

    def since(self, seen: Frame) -> bytes:
        """Return JSON for a page that has seen another frame: with all impacts that are new to it.

        A page that has seen none is told the last impact alone.
        """
        if seen.number == 0:
            known = self.last - 1
        else:
            known = seen.last if seen.beginning == self.beginning else 0
        fresh = ", ".join(text for number, text in self.impacts if number > known)
        return f'{self.text[:-1]}, "impacts": [{fresh}]}}'.encode()
