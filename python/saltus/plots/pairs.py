"""Pictures of gaps: two shapes, their witness points and the normal. Needs matplotlib.

Shapes are convex: drawn are the facets that face the viewer, in parallel projection.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from itertools import pairwise
from math import ceil, cos, pi, sin
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from saltus._core import (
    Box,
    Capsule,
    Convex,
    Cylinder,
    HalfSpace,
    Pose,
    Sphere,
    gap,
    shape_name,
)
from saltus.plots.figure import finish, new_figure
from saltus.records.tables import Array

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Shape: TypeAlias = Any  # saltus.Shape: a room above this one
Facets: TypeAlias = list[Array]  # corners, (k, 3), counterclockwise seen from outside

ELEVATION = 0.35  # [rad] the viewer looks along +y, from this much above
ACROSS = np.array([[1, 0, 0], [0, sin(ELEVATION), cos(ELEVATION)]])  # right and up of the picture
TOWARDS = np.array([0.0, -cos(ELEVATION), sin(ELEVATION)])
LIGHT = np.array([-0.45, -0.55, 0.7]) / np.linalg.norm([-0.45, -0.55, 0.7])
AROUND, ALONG = 60, 18  # facets of round shapes
ORANGE, BLUE, GROUND = (0.96, 0.62, 0.25), (0.42, 0.65, 0.87), (0.80, 0.83, 0.80)
PLANE = 0.75  # [m] half the side of the square that stands for a half-space


class Placed(NamedTuple):
    """Two shapes and where they are, as `saltus.gap` takes them."""

    a: Shape
    X_WA: Pose
    b: Shape
    X_WB: Pose


def plot_gap(pair: Placed, path: str | os.PathLike[str] | None = None) -> Figure:
    """Draw two shapes, a orange and b blue, and the normal from one witness point to the other.

    Parameters
    ----------
    pair : Placed or sequence
        a, X_WA, b, X_WB, as `saltus.gap` takes them.
    path : str or os.PathLike, optional
        Where the picture is written.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    ModelError
        Where the pair has no gap function, or matplotlib is not installed.
    """
    figure = new_figure(path, (3.0, 3.4))
    draw_gap(figure.subplots(), Placed(*pair))
    return finish(figure, path)


def plot_gaps(
    pairs: Sequence[Placed], path: str | os.PathLike[str] | None = None, *, columns: int = 7
) -> Figure:
    """Draw many pairs on one sheet, as `plot_gap` draws one, and a legend.

    Parameters
    ----------
    pairs : sequence of Placed
    path : str or os.PathLike, optional
        Where the picture is written.
    columns : int

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    ModelError
        As `plot_gap`.
    """
    rows = ceil((len(pairs) + 1) / columns)  # one cell for the legend
    figure = new_figure(path, (1.75 * columns, 2.3 * rows))
    cells = list(figure.subplots(rows, columns, squeeze=False).flat)
    for axes, pair in zip(cells, pairs, strict=False):
        draw_gap(axes, Placed(*pair))
    for axes in cells[len(pairs) :]:
        axes.set_axis_off()
    _share_scale(cells[: len(pairs)])
    _draw_legend(cells[-1])
    return finish(figure, path)


def draw_gap(axes: Axes, pair: Placed) -> None:
    """Draw a pair into axes; its title is the kinds of shape and the curvatures of the gap."""
    found = gap(*pair)
    _draw_shape(axes, pair.b, pair.X_WB, BLUE)
    _draw_shape(axes, pair.a, pair.X_WA, ORANGE)
    _draw_normal(axes, _project(found.p_WB), _project(found.p_WA))
    small, *_, large = sorted(np.abs(np.linalg.eigvalsh(found.F_W)))[-2:]
    curved = f"{round(small, 2):g}, {round(large, 2):g} /m"
    axes.set_title(f"{shape_name(pair.a)} ~ {shape_name(pair.b)}", fontsize=9, pad=12)
    axes.text(0.5, 1.01, curved, transform=axes.transAxes, fontsize=7.5, ha="center", color="0.35")
    axes.set_aspect("equal", adjustable="box")
    axes.set_axis_off()


def _share_scale(cells: Sequence[Axes]) -> None:
    """Give all of them the scale of the largest picture."""
    half = 0.53 * np.max([axes.dataLim.size for axes in cells], axis=0)
    for axes in cells:
        middle = np.asarray(axes.dataLim.get_points()).mean(axis=0)
        (left, low), (right, high) = middle - half, middle + half
        axes.set(xlim=(left, right), ylim=(low, high))


def _draw_normal(axes: Axes, start: Array, end: Array) -> None:
    arrow = {"arrowstyle": "-|>", "lw": 1.3, "shrinkA": 0, "shrinkB": 2.5, "color": "crimson"}
    axes.annotate("", tuple(end), tuple(start), arrowprops=arrow, zorder=3)
    axes.plot(*np.transpose([start, end]), "o", ms=3.5, color="black", zorder=4)


def _draw_legend(axes: Axes) -> None:
    axes.set(xlim=(0, 1), ylim=(0, 1))
    for y, colour, word in ((0.82, ORANGE, "a"), (0.64, BLUE, "b")):
        axes.plot(0.12, y, "s", ms=11, color=colour)
        axes.text(0.26, y, word, va="center", fontsize=9)
    _draw_normal(axes, np.array([0.12, 0.36]), np.array([0.12, 0.52]))
    axes.text(0.26, 0.44, "n, from witness\nto witness", va="center", fontsize=9)
    axes.text(0.05, 0.15, "numbers: curvatures\nof φ along and across", va="center", fontsize=8)


def _draw_shape(axes: Axes, shape: Shape, X: Pose, colour: tuple[float, float, float]) -> None:
    """Draw the facets towards the viewer, shaded, and the edges between flat ones."""
    from matplotlib.collections import PolyCollection

    flat = isinstance(shape, HalfSpace)
    facets = [corners @ X.R.T + X.p for corners in facets_of(shape)]
    outward = _normals(facets)
    (seen,) = np.nonzero(outward @ TOWARDS > 1e-9)
    light = 0.62 + 0.38 * np.maximum(0, outward[seen] @ LIGHT)
    colours = np.clip(light[:, None] * (GROUND if flat else colour), 0, 1)
    edged = isinstance(shape, Box | Convex | HalfSpace)
    polygons = [_project(facets[k]) for k in seen]
    edges = "0.25" if edged else colours
    axes.add_collection(
        PolyCollection(polygons, facecolors=colours, edgecolors=edges, linewidths=0.6, zorder=1)
    )
    if isinstance(shape, Cylinder):
        caps = [p for p in polygons if len(p) == AROUND]
        rims = PolyCollection(caps, facecolors="none", edgecolors="0.25", linewidths=0.6, zorder=2)
        axes.add_collection(rims)
    axes.autoscale_view()


def _project(points: npt.ArrayLike) -> Array:
    return np.asarray(np.asarray(points) @ ACROSS.T)


def _normals(facets: Facets) -> Array:
    """Return the unit normals of plane polygons by Newell's sum, 0 where the area is; (m, 3)."""
    out = np.empty((len(facets), 3))
    for size in {len(corners) for corners in facets}:
        rows = [k for k, corners in enumerate(facets) if len(corners) == size]
        corners = np.stack([facets[k] for k in rows])
        out[rows] = np.cross(corners, np.roll(corners, -1, axis=1)).sum(axis=1)
    length = np.linalg.norm(out, axis=1, keepdims=True)
    return np.asarray(out / np.where(length > 0, length, 1))


def _revolved(profile: Sequence[tuple[float, float]]) -> Facets:
    """Return the facets between circles (radius, z), from below upwards."""
    angle = 2 * pi * np.arange(AROUND) / AROUND
    circles = [
        np.stack([r * np.cos(angle), r * np.sin(angle), np.full(AROUND, z)], axis=-1)
        for r, z in profile
    ]
    rings = [
        np.array([low[i], low[i - AROUND + 1], high[i - AROUND + 1], high[i]])
        for low, high in pairwise(circles)
        for i in range(AROUND)
    ]
    return [*rings, circles[0][::-1], circles[-1]]


def _arc(radius: float, z: float, first: float, last: float) -> list[tuple[float, float]]:
    steps = np.linspace(first, last, ALONG + 1)
    return [(radius * cos(s), z + radius * sin(s)) for s in steps]


def _capsule(shape: Capsule) -> Facets:
    below = _arc(shape.radius, -shape.half_length, -pi / 2, 0)
    return _revolved([*below, *_arc(shape.radius, shape.half_length, 0, pi / 2)])


def _cylinder(shape: Cylinder) -> Facets:
    return _revolved([(shape.radius, -shape.half_length), (shape.radius, shape.half_length)])


def _box(shape: Box) -> Facets:
    face = np.array([[1, 1, 1], [-1, 1, 1], [-1, -1, 1], [1, -1, 1]])
    faces = [np.roll(face, k, axis=1) for k in range(3)]
    return [corners * shape.half for corners in (*faces, *(-f[::-1] for f in faces))]


def _convex(shape: Convex) -> Facets:
    return [shape.vertices[face] for face in shape.faces]


def _hull(shape: Shape) -> Facets:
    """Return the facets of any shape with an end, by its points farthest from half-spaces."""
    points = []
    for r, z in _arc(1, 0, -pi / 2, pi / 2):
        for angle in 2 * pi * np.arange(AROUND) / AROUND:
            across = np.array([-sin(angle), cos(angle), 0])
            normal = np.array([r * cos(angle), r * sin(angle), z])
            plane = Pose(np.zeros(3), np.stack([across, np.cross(normal, across), normal], axis=1))
            points.append(gap(shape, Pose(), HalfSpace(), plane).p_WA)
    return _convex(Convex(points))


def _half_space(_: HalfSpace) -> Facets:
    return [PLANE * np.array([[1.0, 1, 0], [-1, 1, 0], [-1, -1, 0], [1, -1, 0]])]


def facets_of(shape: Shape) -> Facets:
    """Return what is drawn of a shape, in its frame."""
    return FACETS.get(type(shape), _hull)(shape)


FACETS: dict[type, Callable[..., Facets]] = {
    Sphere: lambda shape: _revolved(_arc(shape.radius, 0, -pi / 2, pi / 2)),
    Capsule: _capsule,
    Box: _box,
    Cylinder: _cylinder,
    HalfSpace: _half_space,
    Convex: _convex,
}
