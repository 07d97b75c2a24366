"""Shapes of a model as geometries for the page; equal ones are one geometry, drawn many times."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from saltus._core import Box, Capsule, Convex, Cylinder, Ellipsoid, HalfSpace, Sphere
from saltus.view.arrays import packed

Shape = Sphere | Capsule | Box | Cylinder | HalfSpace | Ellipsoid | Convex


class Geometries:
    """The different geometries of a scene.

    Spheres and ellipsoids are one, a unit ball of several scales; likewise boxes and cylinders.
    Capsules and hulls differ by more than a scale.

    Attributes
    ----------
    stored : list of dict
        For the page, in the order of the numbers that `add` returns.
    """

    def __init__(self) -> None:
        self.stored: list[dict[str, Any]] = []
        self._numbers: dict[str, int] = {}

    def add(self, shape: Any) -> tuple[int, list[float]]:
        """Return the number of the geometry of a shape, and the three scales along its axes.

        Parameters
        ----------
        shape : Shape
            Or a mesh with vertices and faces of three.

        Returns
        -------
        (int, list of float)
        """
        match shape:
            case Sphere():
                return self._number({"type": "sphere"}), [shape.radius] * 3
            case Ellipsoid():
                return self._number({"type": "sphere"}), shape.radii.tolist()
            case Box():
                return self._number({"type": "box"}), shape.half.tolist()
            case Cylinder():
                scale = [shape.radius, shape.radius, shape.half_length]
                return self._number({"type": "cylinder"}), scale
            case Capsule():
                sizes = {"radius": shape.radius, "half_length": shape.half_length}
                return self._number({"type": "capsule", **sizes}), [1.0] * 3
            case HalfSpace():
                return self._number({"type": "plane"}), [1.0] * 3
            case Convex():
                return self.add_mesh(shape.vertices, _triangles(shape.faces)), [1.0] * 3
            case _:  # a mesh of triangles, which visuals may be
                return self.add_mesh(shape.vertices, shape.faces, smooth=True), [1.0] * 3

    def add_mesh(
        self, vertices: npt.ArrayLike, triangles: npt.ArrayLike, *, smooth: bool = False
    ) -> int:
        """Return the number of a geometry of triangles.

        Parameters
        ----------
        vertices : array_like, shape (n, 3)
            [m]
        triangles : array_like, shape (m, 3)
            Numbers of vertices, counterclockwise seen from outside.
        smooth : bool
            Whether flat angles between triangles are drawn round.

        Returns
        -------
        int
        """
        mesh = {"vertices": packed(vertices), "triangles": packed(triangles, "i4")}
        return self._number({"type": "mesh", "smooth": smooth, **mesh})

    def _number(self, geometry: dict[str, Any]) -> int:
        key = json.dumps(geometry, sort_keys=True)
        if key not in self._numbers:
            self._numbers[key] = len(self.stored)
            self.stored.append(geometry)
        return self._numbers[key]


def bounding_radius(shape: Shape) -> float:
    """Return the largest distance [m] of a shape's points from its frame's origin."""
    match shape:
        case Sphere():
            return shape.radius
        case Ellipsoid():
            return float(shape.radii.max())
        case Box():
            return float(np.linalg.norm(shape.half))
        case Cylinder():
            return float(np.hypot(shape.radius, shape.half_length))
        case Capsule():
            return shape.radius + shape.half_length
        case HalfSpace():
            return float("inf")
        case _:
            return float(np.linalg.norm(shape.vertices, axis=1).max())


def _triangles(faces: Sequence[Sequence[int]]) -> npt.NDArray[np.int32]:
    fans = [(face[0], face[k], face[k + 1]) for face in faces for k in range(1, len(face) - 1)]
    return np.array(fans, np.int32).reshape(-1, 3)
