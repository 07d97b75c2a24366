"""What happens on a live page: impulses of impacts, forces of held contacts, the gap of a pair."""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from saltus._core import Impact, Model, Pose, StepReport, gap
from saltus.records.pairs import ShapePair, pair_name, pairs_of_model, shape_names
from saltus.records.tables import Array

MOST_IMPACTS = 40  # that are kept for pages which come late to them
MOST_ARROWS = 200  # of an impact, and of forces


class Events:
    """What steps report, as pages are told it.

    Parameters
    ----------
    model : Model
    q : numpy.ndarray, shape (n_q,)
        At the start.
    h : float
        [s] the time step.
    origin : numpy.ndarray, shape (3,)
        [m] what places on the page are relative to.

    Attributes
    ----------
    pairs : list of str
        Names of the pairs of shapes whose gap may be asked for, the nearest at the start first.
    chosen : int
        Which of them is told, at first 0.
    """

    def __init__(self, model: Model, q: Array, h: float, origin: Array) -> None:
        self.model, self.h, self.origin = model, h, origin
        self._shapes = model.shapes  # asked once: the model makes this list anew each time
        pairs = pairs_of_model(model)
        phi = [self._phi(q, pair) for pair in pairs]
        self._pairs = [pairs[i] for i in np.argsort(phi, kind="stable")]
        self.pairs = [pair_name(model, pair) for pair in self._pairs]
        self._numbers = {shape_names(name): i for i, name in enumerate(self.pairs)}
        self.chosen = 0
        self.beginning = 0  # number of the last reset, by which pages know that there was one
        self.forget()

    def forget(self) -> None:
        """Begin anew, as after a reset."""
        self.beginning += 1
        self.count = 0  # of impacts
        self.impacts: tuple[tuple[int, str], ...] = ()  # the last: number, and JSON for pages
        self.forces: list[list[Any]] = []  # of the step just made

    def choose(self, pair: int) -> None:
        """Tell the gap of another pair, by its number."""
        self.chosen = pair

    def add(self, report: StepReport) -> None:
        """Take in what a step reports."""
        if report.impacts:
            fresh = (self._told(impact) for impact in report.impacts)
            told = ((each["number"], json.dumps(each)) for each in fresh)
            self.impacts = (*self.impacts, *told)[-MOST_IMPACTS:]
        self.forces = [
            self._arrow(c.pair, c.point, (c.impulse * c.normal + c.tangential) / self.h, c.normal)
            for c in report.contacts[:MOST_ARROWS]
        ]

    def told(self, q: Array) -> dict[str, Any]:
        """Return what a frame tells all pages alike at coordinates q."""
        phi = self._phi(q, self._pairs[self.chosen]) if self.pairs else None
        return {
            "beginning": self.beginning,
            "forces": self.forces,
            "gap": {"pair": self.chosen, "phi": phi},
        }

    def _told(self, impact: Impact) -> dict[str, Any]:
        self.count += 1
        vectors = impact.lambdas[:, None] * impact.normals + impact.tangentials
        rows = list(zip(impact.pairs, impact.points, vectors, impact.normals, strict=True))
        closed = {self._numbers.get(shape_names(pair), -1) for pair in impact.pairs}
        return {
            "number": self.count,
            "t": impact.t,
            "certificate": impact.certificate,
            "impulses": list(zip(impact.pairs, impact.lambdas.tolist(), strict=True))[:MOST_ARROWS],
            "arrows": [self._arrow(*row) for row in rows[:MOST_ARROWS]],
            "closed": sorted(closed - {-1}),  # numbers of pairs: their gaps are 0 at this instant
        }

    def _phi(self, q: Array, pair: ShapePair) -> float:
        ends: list[Any] = []
        for i in pair:
            X = self.model.shape_poses(q[np.newaxis], i)[0]
            ends += [self._shapes[i].shape, Pose(X[:3, 3], X[:3, :3])]
        return float(gap(*ends).phi)

    def _arrow(self, pair: str, point: Array, vector: Array, normal: Array) -> list[Any]:
        return [pair, (point - self.origin).tolist(), vector.tolist(), normal.tolist()]
