"""A transcribed problem: states and controls of all steps are unknowns, the steps constraints."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from saltus._core import State
from saltus.optimize.bend import Curved
from saltus.optimize.pieces import Node, Pieces, Setting
from saltus.optimize.planned import PlannedStep
from saltus.optimize.sparse import Blocks, Triplets
from saltus.optimize.system import Array
from saltus.runs.progress import Progress


class Program(Pieces):
    """Least cost(z) with low <= z <= high and least <= constraints(z) <= most.

    What a solver of nonlinear programs needs. z are the states after each step, (q, p) as
    differences from the guess, then the controls, then the durations of the arcs before planned
    impacts. Constraints are the steps, the gaps at planned impacts, what is to reach, and gaps that
    stay open.

    Attributes
    ----------
    guess : numpy.ndarray, shape (n,)
    low, high : numpy.ndarray, shape (n,)
    least, most : numpy.ndarray, shape (m,)
    tolerance : float
        Of constraints, and of the gradient of the Lagrangian.
    iterations : int
        At most.
    """

    def __init__(
        self,
        setting: Setting,
        tolerance: float,
        iterations: int,
        report: Progress | None = None,
        done: int = 0,
    ) -> None:
        super().__init__(setting)
        self.tolerance, self.report, self.done = tolerance, report, done
        self.total, self.iterations = iterations, iterations - done
        count = len(setting.hits)
        self.guess = np.concatenate([np.zeros(self.first_u), setting.control.ravel(), setting.taus])
        free, h = np.full(self.first_u, np.inf), setting.planner.h
        low, high = (np.tile(b, self.N) for b in setting.bounds)
        self.low = np.concatenate([-free, low, np.zeros(count)])
        self.high = np.concatenate([free, high, np.full(count, h)])
        equal = self.N * self.n + count + len(self.misses(self.node(self.N, self.guess))[0])
        gaps = [setting.least_gap(pair) for pair, _ in setting.clear]
        self.least = np.concatenate([np.zeros(equal), gaps, np.full(len(self.crowded), -np.inf)])
        self.most = np.concatenate(
            [np.zeros(equal), np.full(len(gaps), np.inf), np.full(len(self.crowded), h)]
        )
        self.best, self.best_key = self.guess, (np.inf, np.inf)
        self.noted: list[tuple[float, float]] = []
        self._at = np.full(len(self.guess), np.nan)
        self._steps: list[PlannedStep] = []

    def steps(self, z: Array) -> list[PlannedStep]:
        """Return all steps of z; those of the last z are kept."""
        if not np.array_equal(z, self._at):
            self._steps = [
                self.step(k, self.node(k, z).state, *self.inputs(k, z)) for k in range(self.N)
            ]
            self._at = z.copy()
        return self._steps

    def states(self, z: Array) -> list[State]:
        """Return the N + 1 states of z."""
        return [self.node(k, z).state for k in range(self.N + 1)]

    def control(self, z: Array) -> Array:
        """Return the controls of z, (N, n_u)."""
        return z[self.first_u : self.first_tau].reshape(self.N, self.n_u)

    def cost(self, z: Array) -> float:
        """Return the cost."""
        return sum(self.term(k, self.node(k, z), z)[0] for k in range(self.N + 1))

    def term(self, k: int, node: Node, z: Array) -> tuple[float, Array]:
        """Return the cost of step k, or of the last state, and its gradient by (xi, u)."""
        u = self.control(z)[k] if k < self.N else np.zeros(0)
        return self.priced(k, node, u)

    def gradient(self, z: Array) -> Array:
        """Return the gradient of the cost."""
        g = np.zeros(len(z))
        for k in range(self.N + 1):
            part = self.term(k, self.node(k, z), z)[1]
            if k < self.N:
                u = self.first_u + k * self.n_u
                g[u : u + self.n_u] += part[self.n :]
            if k > 0:
                g[(k - 1) * self.n : k * self.n] += part[: self.n]
        return g

    def constraints(self, z: Array) -> Array:
        """Return the constraints' values, (m,)."""
        rows = []
        for k, step in enumerate(self.steps(z)):
            rows.append(z[k * self.n : (k + 1) * self.n] - self.landing(k, step.end)[0])
        rows += [step.gaps for step in self._steps]
        rows.append(self.misses(self.node(self.N, z))[0])
        rows += [self.open_gap(pair, self.node(k, z))[:1] for pair, k in self.setting.clear]
        rows += [np.array([np.sum(z[self.first_tau + np.array(at)])]) for at in self.crowded]
        return np.concatenate(rows)

    def jacobian(self, z: Array) -> Triplets:
        """Return the derivative of the constraints, (m, n)."""
        out, row = Blocks(), 0
        steps, half = self.steps(z), np.arange(self.n)
        for k, step in enumerate(steps):
            by = -(self.landing(k, step.end)[1] @ step.by)
            out.add(row, k * self.n + half, np.eye(self.n))
            self.add_inputs(out, row, k, by, z)
            row += self.n
        for k, step in enumerate(steps):
            self.add_inputs(out, row, k, step.gaps_by, z)
            row += len(step.gaps)
        last = self.misses(self.node(self.N, z))[1]
        out.add(row, (self.N - 1) * self.n + half, last)
        row += len(last)
        for pair, k in self.setting.clear:
            gap = self.open_gap(pair, self.node(k, z))
            out.add(row, (k - 1) * self.n + half, gap[None, 1:])
            row += 1
        for at in self.crowded:
            out.add(row, self.first_tau + np.array(at), np.ones((1, len(at))))
            row += 1
        return out.triplets()

    def add_inputs(self, out: Blocks, row: int, k: int, by: Array, z: Array) -> None:
        """Add a derivative by state, controls and durations of step k."""
        columns = self.columns(k)
        by = by.copy()
        by[:, : self.n] = by[:, : self.n] @ self.node(k, z).chart
        known = columns >= 0
        out.add(row, columns[known], by[:, known])

    def defect(self, z: Array) -> float:
        """Return by how much z misses its constraints and bounds, at most."""
        c = self.constraints(z)
        over = [self.least - c, c - self.most, self.low - z, z - self.high, np.zeros(1)]
        return float(max(np.max(each, initial=0.0) for each in over))

    def key(self, z: Array) -> tuple[float, float]:
        """Return what is less for a better z: misses beyond the tolerance, then the cost."""
        return max(self.defect(z), 10 * self.tolerance), self.cost(z)

    def note(self, z: Array) -> None:
        """Take note of an iterate: the best is kept, and progress shown."""
        key = self.key(z)
        self.noted.append((key[1], key[0]))
        if key < self.best_key:
            self.best, self.best_key = np.array(z), key
        if self.report is not None:
            self.report(min(1.0, (self.done + len(self.noted)) / self.total))

    def hessian(self, z: Array, weight: float, multipliers: Array | None) -> Triplets:
        """Return the Hessian of weight cost(z) + multipliers . constraints(z), (n, n).

        By central differences of exact gradients, step by step: it has a block for each.
        """
        out, y = Blocks(), np.zeros(len(self.least)) if multipliers is None else multipliers
        gap_row = self.first_u
        for k in range(self.N + 1):
            at = self.by_step[k] if k < self.N else []
            of_gaps = y[gap_row : gap_row + len(at)]
            gap_row += len(at)
            columns = self.columns(k) if k < self.N else np.arange(self.n) + (k - 1) * self.n
            local = np.concatenate([z[columns[self.n :]]])
            xi = z[columns[: self.n]] if k > 0 else np.zeros(self.n)
            of_step = y[k * self.n : (k + 1) * self.n] if multipliers is not None else None
            lagrangian = Curved(self, k, weight, of_step, of_gaps, y)
            block = lagrangian.hessian(np.concatenate([xi, local]))
            known = columns >= 0
            out.add_square(columns[known], block[np.ix_(known, known)])
        return out.triplets()


def overlaps(program: Program, z: Array) -> list[tuple[int, int]]:
    """Return pair and state of gaps that are less than they may be."""
    setting, found = program.setting, []
    model = setting.system.model
    for k, x in enumerate(program.states(z)[1:], start=1):
        phi: Sequence[float] = model.gaps(x.q).phi.tolist()
        for pair, gap in enumerate(phi):
            slack = max(model.pair(pair).touch, 10 * program.tolerance)
            if gap < setting.least_gap(pair) - slack:
                found.append((pair, k))
    return found
