"""Second derivatives of a transcribed problem: exact of smooth steps, else differences."""

from __future__ import annotations

import numpy as np

from saltus.optimize.curvature import STEP, hessian
from saltus.optimize.pieces import Node, Pieces
from saltus.optimize.system import Array


class Curved:
    """A step's part of the Lagrangian of a program: its gradient by the step's own inputs."""

    def __init__(
        self,
        program: Pieces,
        k: int,
        weight: float,
        of_step: Array | None,
        of_gaps: Array,
        multipliers: Array,
    ) -> None:
        self.program, self.k, self.weight = program, k, weight
        self.of_step, self.of_gaps, self.multipliers = of_step, of_gaps, multipliers

    def gradient(self, y: Array, *, is_with_step: bool = True) -> Array:
        """Return the gradient at inputs y: xi, controls, durations; or all of it but the step's."""
        program, k, n, n_u = self.program, self.k, self.program.n, self.program.n_u
        node = program.placed(k, y[:n])
        g, last = np.zeros(len(y)), k == program.N
        u = y[n : n + n_u] if not last else np.zeros(0)
        if self.weight != 0:
            g[: n + len(u)] += self.weight * program.priced(k, node, u)[1]
        if self.of_step is None:
            return g
        if not last and is_with_step:
            by = self.pulled(node, u, y[n + n_u :])
            g += np.concatenate([node.chart.T @ by[:n], by[n:]])
        row = program.first_u + len(program.setting.hits)
        missed = program.misses(node)[1] if last else np.zeros((0, n))
        g[:n] += missed.T @ self.multipliers[row : row + len(missed)]
        row = len(self.multipliers) - len(program.crowded) - len(program.setting.clear)
        for i, (pair, at) in enumerate(program.setting.clear):
            if at == k:
                g[:n] += self.multipliers[row + i] * program.open_gap(pair, node)[1:]
        return g

    def pulled(self, node: Node, u: Array, taus: Array) -> Array:
        """Return the gradient of the step's constraints by state, controls and durations."""
        program, k = self.program, self.k
        assert self.of_step is not None
        if len(taus):
            step = program.step(k, node.state, u, taus)
            back = program.landing(k, step.end)[1].T @ self.of_step
            return np.asarray(step.gaps_by.T @ self.of_gaps - step.by.T @ back)
        whole, half = program.setting.planner.stepper, program.n // 2  # no matrix is needed
        end = whole.advance(node.state, control=u if len(u) else None)
        back = program.landing(k, end)[1].T @ self.of_step
        by = whole.vjp(-back[:half], -back[half:])
        return np.concatenate([by.q, by.p, by.control])

    def exact(self, y: Array) -> Array | None:
        """Return the exact Hessian of the step's constraints; None where it has none."""
        program, n = self.program, self.program.n
        if self.of_step is None or self.k == program.N or len(y) > n + program.n_u:
            return None  # no step, or one with planned impacts
        start, half = program.placed(self.k, y[:n]).state, n // 2
        return program.setting.planner.hessian(
            start, y[n:], -self.of_step[:half], -self.of_step[half:]
        )

    def hessian(self, y: Array) -> Array:
        """Return the Hessian at inputs y, inside the ranges where differences need it."""
        program, n, h = self.program, self.program.n, self.program.setting.planner.h
        n_u = program.n_u if self.k < program.N else 0
        y = y.copy()
        x = program.setting.states[self.k]
        y[n : n + n_u] = program.setting.system.inside(y[n : n + n_u], 2 * STEP) if n_u else []
        y[n + n_u :] = np.clip(y[n + n_u :], 2 * STEP * h, h * (1 - 2 * STEP))
        momenta = np.maximum(np.abs(x.p), 1)
        scales = [np.ones(n // 2), momenta, np.maximum(np.abs(y[n : n + n_u]), 1)]
        scales.append(np.full(len(y) - n - n_u, h))
        exact = self.exact(y)
        H = hessian(
            lambda d: self.gradient(y + d, is_with_step=exact is None), np.concatenate(scales)
        )
        return H if exact is None else H + exact
