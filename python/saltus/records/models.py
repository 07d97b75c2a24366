"""Models as text and as HTML: an indented tree of joints and links."""

from __future__ import annotations

import math
from collections import Counter, defaultdict
from collections.abc import Iterator
from html import escape
from typing import NamedTuple

from saltus._core import JointInfo, JointType, Model, PlacedShape, shape_name
from saltus.records.tables import counted

MOST_ROWS = 60  # of a tree that print makes; a cradle of 1000 balls has 2000 joints

AXES: dict[tuple[float, ...], str] = {(1, 0, 0): "x", (0, 1, 0): "y", (0, 0, 1): "z"}
AXES |= {(-1, 0, 0): "-x", (0, -1, 0): "-y", (0, 0, -1): "-z"}
ALONG = {JointType.prismatic: "along", JointType.planar: "normal to"}  # others turn about it


class Row(NamedTuple):
    """A joint, and the link below it, of a tree; the root link has no joint."""

    depth: int
    joint: str
    kind: str
    axis: str
    limits: str
    link: str
    mass: str
    shapes: str


def model_tree(model: Model, *, most: int | None = None) -> str:
    """Return a model as an indented tree: joints with types, axes and limits, links with masses.

    `print(model)` prints this, without the end of a long one.

    Parameters
    ----------
    model : Model
    most : int, optional
        Number of lines of the tree; None: all.

    Returns
    -------
    str
    """
    rows = list(_rows(model))
    shown = len(rows) if most is None else min(most, len(rows))
    lines = [headline(model)]
    lines += [f"{'  ' * row.depth}{_line(row)}" for row in rows[:shown]]
    if shown < len(rows):
        lines.append(f"... {counted(len(rows) - shown, 'more joint')}; model_tree(model) has all")
    return "\n".join(lines)


def headline(model: Model) -> str:
    """Return one line: name, mass, and how many of what."""
    counts = {"coordinate": model.n_q, "velocity": model.n_v, "pair": model.n_pairs}
    if model.n_q == model.n_v:
        del counts["velocity"]
    words = [counted(number, noun) for noun, number in counts.items()]
    mass = sum(link.mass for link in model.links)
    return f"{model.name}: {', '.join(words)}, {mass:.4g} kg"


def _rows(model: Model) -> Iterator[Row]:
    """Yield the tree depth first, children in the order of the joints."""
    below: dict[str, list[JointInfo]] = defaultdict(list)
    for joint in model.joints:
        below[joint.parent].append(joint)
    shapes: dict[int, list[PlacedShape]] = defaultdict(list)
    for shape in model.shapes:
        shapes[shape.link].append(shape)
    units = {c.joint: c.unit for c in model.coordinates}
    links = {link.name: link for link in model.links}
    root = model.links[0]
    yield Row(0, "", "", "", "", root.name, _mass(root.mass), _shapes(shapes[0]))
    stack = [(1, joint) for joint in reversed(below[root.name])]
    while stack:
        depth, joint = stack.pop()
        link = links[joint.child]
        unit = units.get(joint.name) or ("m" if joint.type is JointType.prismatic else "rad")
        yield Row(
            depth,
            joint.name,
            joint.type.name,
            _axis(joint),
            _limits(joint, unit),
            link.name,
            _mass(link.mass),
            _shapes(shapes[link.index]),
        )
        stack += [(depth + 1, each) for each in reversed(below[link.name])]


def _line(row: Row) -> str:
    link = ", ".join(text for text in (row.link, row.mass, row.shapes) if text)
    if not row.joint:
        return link
    kind = " ".join(text for text in (row.kind, row.axis) if text)
    return f"{row.joint} ({', '.join(text for text in (kind, row.limits) if text)}): {link}"


def _axis(joint: JointInfo) -> str:
    if joint.axis is None:
        return ""
    x, y, z = (float(number) + 0.0 for number in joint.axis)
    name = AXES.get((x, y, z), f"({x:.3g}, {y:.3g}, {z:.3g})")
    return f"{ALONG.get(joint.type, 'about')} {name}"


def _limits(joint: JointInfo, unit: str) -> str:
    if joint.mimic is not None:
        factor = "" if joint.mimic.multiplier == 1 else f"{joint.mimic.multiplier:g} * "
        offset = f" {joint.mimic.offset:+g}" if joint.mimic.offset else ""
        return f"= {factor}{joint.mimic.joint}{offset}"
    if math.isinf(joint.lower) and math.isinf(joint.upper):
        return ""
    return f"{joint.lower:.4g} to {joint.upper:.4g} {unit}"


def _mass(mass: float) -> str:
    return f"{mass:.4g} kg" if mass else ""


def _shapes(shapes: list[PlacedShape]) -> str:
    counts = Counter(shape_name(each.shape).replace("_", "-") for each in shapes)
    return ", ".join(f"{n} {name}" + ("s" if n > 1 else "") for name, n in counts.items())


def html_table(heads: list[str], rows: list[list[str]], caption: str = "") -> str:
    """Return a table as HTML; cells are text, and the first column keeps its indent."""

    def cell(tag: str, text: str) -> str:
        indent = len(text) - len(text.lstrip())
        style = f"text-align:left;padding-left:{0.6 + 0.6 * indent:g}em"
        return f'<{tag} style="{style}">{escape(text.strip())}</{tag}>'

    def line(tag: str, texts: list[str]) -> str:
        return f"<tr>{''.join(cell(tag, text) for text in texts)}</tr>"

    head = f"<caption>{escape(caption)}</caption><thead>{line('th', heads)}</thead>"
    body = "".join(line("td", row) for row in rows)
    return f"<table>{head}<tbody>{body}</tbody></table>"


def printed(model: Model) -> str:
    """Return what `print(model)` prints."""
    return model_tree(model, most=MOST_ROWS)


def as_html(model: Model) -> str:
    """Return what a notebook shows."""
    rows = list(_rows(model))
    cells = [["  " * row.depth + (row.joint or row.link), *row[2:]] for row in rows[:MOST_ROWS]]
    if len(rows) > MOST_ROWS:
        cells.append([f"... {counted(len(rows) - MOST_ROWS, 'more joint')}", *[""] * 6])
    heads = ["joint", "type", "axis", "limits", "link", "mass", "shapes"]
    return html_table(heads, cells, headline(model))
