"""The comparison in words: tables for the terminal, and the manual's page."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from compare import picture
from compare.scene import Scene

EXACT = {  # velocities after the first impact, as parts of that with which the first ball came
    "cradle of 3, 1 up": [0.0, 0.0, 1.0],
    "cradle of 3, 1 up, 1 µm apart": [0.0, 0.0, 1.0],
    "cradle of 5, 2 up": [0.0, 0.0, 0.0, 1.0, 1.0],
    "three unequal balls": [-0.1715728753, 0.8284271247, 0.8284271247],
}

Row = list[str]


def tables(scenes: Sequence[Scene], results: Sequence[dict]) -> str:
    """Return a table for each scene."""
    return "\n\n".join(f"{scene.name}:\n\n{table(scene, results)}" for scene in scenes)


def table(scene: Scene, results: Sequence[dict]) -> str:
    """Return a scene's table in Markdown, aligned so that it reads as plain text too."""
    measured = [(r["name"], r["scenes"][scene.name]) for r in results if scene.name in r["scenes"]]
    if scene.kind == "break":
        head = ["engine", "mirror error", "energy error", "CPU [s]"]
        rows = [
            [name, power(m["mirror"]), power(m["energy"]), f"{m['cpu']:.3f}"]
            for name, m in measured
        ]
        return grid(head, rows)
    head = ["engine", "velocities after the impact", "energy error", "CPU [s]"]
    exact: Row = ["exact", velocities(EXACT[scene.name]), "0", ""]
    rows = [
        [name, velocities(m["exits"]), power(m["energy"]), f"{m['cpu']:.3f}"]
        for name, m in measured
    ]
    if scene.kind == "cradle":
        head.insert(2, "ball at rest [rad]")
        exact.insert(2, "" if scene.gap else "0")
        for row, (_, m) in zip(rows, measured, strict=True):
            row.insert(2, power(m["resting"]))
    return grid(head, [exact, *rows])


def settings(results: Sequence[dict], absent: Sequence[str]) -> str:
    """Return a line on each engine: its version, its setting, and what went wrong."""
    lines = [f"{r['name']} {r['version']}: {r['setting']}" for r in results]
    lines += [f"{r['name']} failed: {r['error']}" for r in results if "error" in r]
    return "\n".join(f"- {line}" for line in [*lines, *absent])


def velocities(numbers: Sequence[float]) -> str:
    return ", ".join(f"{round(x, 3) + 0.0:.3f}" for x in numbers)


def power(x: float) -> str:
    return "0" if x == 0 else f"{x:.1e}"


def grid(head: Row, rows: Sequence[Row]) -> str:
    wide = [max(map(len, column)) for column in zip(head, *rows, strict=True)]
    lines = [head, ["-" * width for width in wide], *rows]
    padded = ((cell.ljust(width) for cell, width in zip(line, wide, strict=True)) for line in lines)
    return "\n".join(f"| {' | '.join(line)} |" for line in padded)


def write_page(
    file: Path, scenes: Sequence[Scene], results: Sequence[dict], absent: Sequence[str]
) -> None:
    """Write the manual's page, and its picture beside it."""
    image = file.with_suffix(".png")
    picture.draw(scenes, results, image)
    page = Path(__file__).with_name("page.md").read_text(encoding="utf-8")
    cells = {
        f"{scene.kind}{len(scene.masses)}{'_apart' if scene.gap else ''}": table(scene, results)
        for scene in scenes
    }
    text = page.format(
        cores=os.cpu_count(), picture=image.name, settings=settings(results, absent), **cells
    )
    file.write_text(text, encoding="utf-8")
