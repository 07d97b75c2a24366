"""Impacts as text: a line that sums one up, and its cascade (its impulses in order) as a table."""

from __future__ import annotations

from saltus._core import Impact
from saltus.records.models import html_table
from saltus.records.tables import counted

MOST_ROWS = 30  # of a table that print makes; a cradle of 1000 balls has 999 impulses at once


def headline(impact: Impact) -> str:
    """Return one line: when, how many impulses on how many contacts, under which law.

    Parameters
    ----------
    impact : Impact

    Returns
    -------
    str
    """
    law = f"{impact.law.name}{' as fallback' if impact.fallback else ''}"
    return f"impact at t = {impact.t:.6f} s: {count_line(impact)}; {law}"


def count_line(impact: Impact) -> str:
    """Return the numbers of impulses and contacts, and whether the outcome is unique.

    Parameters
    ----------
    impact : Impact
        Its `certificate` comes last, if it has one that is not empty.

    Returns
    -------
    str
    """
    counts = f"{counted(len(impact.pairs), 'impulse')} on {counted(impact.contacts, 'contact')}"
    certificate = getattr(impact, "certificate", None)
    return f"{counts}; {certificate}" if certificate else counts


def impact_table(impact: Impact, *, most: int | None = None) -> str:
    """Return the cascade of an impact as text: its impulses in order, one per line.

    `print(run.impact(0))` prints this, without the middle of a long cascade. With friction there is
    a column of friction impulses on the first shape of each pair, in the world frame.

    Parameters
    ----------
    impact : Impact
    most : int, optional
        Number of rows; longer cascades are printed without their middle. None: all.

    Returns
    -------
    str
    """
    total = len(impact.pairs)
    shown = total if most is None else min(most, total)
    first = [*range(shown - shown // 2)]
    last = [*range(total - shown // 2, total)]
    cells = {i: _cells(impact, i) for i in (*first, *last)}
    heads = ("#", "pair", "λ [N s]", "friction [N s]")
    wide = [max(map(len, column)) for column in zip(heads, *cells.values(), strict=True)]
    rubs = impact.tangentials.any()

    def line(number: str, pair: str, value: str, friction: str) -> str:
        start = f"  {number:>{wide[0]}}  {pair:<{wide[1]}}  "
        return start + (f"{value:<{wide[2]}}  {friction}" if rubs else value)

    lines = [headline(impact), line(*heads), *(line(*cells[i]) for i in first)]
    if shown < total:
        lines.append(f"  {'':>{wide[0]}}  ... {total - shown} more")
    return "\n".join([*lines, *(line(*cells[i]) for i in last)])


def _cells(impact: Impact, i: int) -> tuple[str, str, str, str]:
    friction = ", ".join(f"{value:.3g}" for value in impact.tangentials[i] + 0.0)
    return str(i + 1), impact.pairs[i], f"{impact.lambdas[i]:.4g}", f"({friction})"


def as_html(impact: Impact) -> str:
    """Return what a notebook shows."""
    count = len(impact.pairs)
    width = 4 if impact.tangentials.any() else 3
    heads = ["#", "pair", "λ [N s]", "friction [N s]"][:width]
    rows = [list(_cells(impact, i)[:width]) for i in range(min(count, MOST_ROWS))]
    if count > MOST_ROWS:
        rows.append(["", f"... {count - MOST_ROWS} more", "", ""][:width])
    return html_table(heads, rows, headline(impact))


def printed(impact: Impact) -> str:
    """Return what `print(impact)` prints."""
    return impact_table(impact, most=MOST_ROWS)
