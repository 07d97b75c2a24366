"""What a transcribed problem is made of: states and steps of its unknowns, with derivatives."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from saltus._core import ModelError, State, StepError
from saltus.optimize.costs import Cost, check
from saltus.optimize.planned import Hit, PlannedStep, Planner
from saltus.optimize.reach import MissFunction
from saltus.optimize.sparse import Indices
from saltus.optimize.system import Array, System, difference_slopes


@dataclass(frozen=True)
class Setting:
    """What is to be solved: where it starts, what it costs, what it must reach, and the plan."""

    system: System
    planner: Planner
    cost: Cost
    reach: MissFunction | None
    bounds: tuple[Array, Array]
    states: list[State]  # the guess; unknowns are differences from it
    control: Array
    hits: list[Hit]
    taus: Array
    clear: list[tuple[int, int]]  # pair and state: gaps that must not close there
    clearance: float = 0.0  # [m] of pairs that are not planned to touch

    def least_gap(self, pair: int) -> float:
        """Return the least that the gap of a pair may be at a state."""
        return 0.0 if any(hit.pair == pair for hit in self.hits) else self.clearance


class Node(NamedTuple):
    """A state of the unknowns, and how it moves with them."""

    state: State
    chart: Array  # (2 n_v, 2 n_v): directions of (q, p) by unknowns


class Pieces:
    """The parts of a transcribed problem: where the unknowns are, states, steps, costs, gaps."""

    def __init__(self, setting: Setting) -> None:
        self.setting = setting
        self.N, self.n_u = setting.control.shape
        self.n = 2 * setting.system.model.n_v
        self.first_u = self.N * self.n
        self.first_tau = self.first_u + self.N * self.n_u
        self.by_step = [
            [i for i, hit in enumerate(setting.hits) if hit.step == k] for k in range(self.N)
        ]
        self.crowded = [at for at in self.by_step if len(at) > 1]

    def columns(self, k: int) -> Indices:
        """Return where state, controls and durations of step k are in z; -1 for the start's."""
        state = np.arange((k - 1) * self.n, k * self.n) if k > 0 else np.full(self.n, -1)
        u = self.first_u + np.arange(k * self.n_u, (k + 1) * self.n_u)
        return np.concatenate([state, u, self.first_tau + np.array(self.by_step[k], dtype=int)])

    def node(self, k: int, z: Array) -> Node:
        """Return state k."""
        xi = z[(k - 1) * self.n : k * self.n] if k > 0 else np.zeros(self.n)
        return self.placed(k, xi)

    def placed(self, k: int, xi: Array) -> Node:
        """Return the state xi from the guess of state k."""
        system, chart, half = self.setting.system, np.eye(self.n), self.n // 2
        if system.balls:
            chart[:half, :half] = np.linalg.inv(difference_slopes(system.balls, xi[:half]))
        return Node(system.shift(self.setting.states[k], xi), chart)

    def step(self, k: int, x: State, u: Array, taus: Array) -> PlannedStep:
        """Return step k, with names of what is wrong."""
        hits = [self.setting.hits[i] for i in self.by_step[k]]
        try:
            return self.setting.planner.step(x, u, hits, taus)
        except (ModelError, StepError) as error:
            raise type(error)(f"step {k}, at t = {x.t:g} s: {error}") from error

    def inputs(self, k: int, z: Array) -> tuple[Array, Array]:
        """Return controls and durations of step k, within actuators' ranges: see System.inside."""
        u = z[self.first_u + k * self.n_u : self.first_u + (k + 1) * self.n_u]
        taus = z[self.first_tau + np.array(self.by_step[k], dtype=int)]
        return self.setting.system.inside(u, 1e-13), np.clip(taus, 0, self.setting.planner.h)

    def landing(self, k: int, end: State) -> tuple[Array, Array]:
        """Return the end of step k from the guess of state k + 1, and the slope of that."""
        system, half = self.setting.system, self.n // 2
        moved = system.difference(self.setting.states[k + 1], end)
        slopes = np.eye(self.n)
        slopes[:half, :half] = difference_slopes(system.balls, moved[:half])
        return moved, slopes

    def misses(self, node: Node) -> tuple[Array, Array]:
        """Return how far the last state is from what it must reach, and that by its unknowns."""
        system, reach = self.setting.system, self.setting.reach
        if reach is None:
            return np.zeros(0), np.zeros((0, self.n))
        v, slopes = system.velocity_slopes(node.state)
        r, J = reach(node.state.q, v)
        residual, by, half = np.atleast_1d(np.asarray(r, float)), np.asarray(J, float), self.n // 2
        if by.shape != (len(residual), self.n):
            raise ModelError(
                f"reach returned {len(residual)} misses with derivatives of shape {by.shape}; they "
                f"are ({len(residual)}, {self.n}), columns q, along velocities, then v"
            )
        whole = by[:, half:] @ slopes
        whole[:, :half] += by[:, :half]
        return residual, whole @ node.chart

    def priced(self, k: int, node: Node, u: Array) -> tuple[float, Array]:
        """Return the cost of step k from a state, and its gradient by (xi, u)."""
        system, cost, x = self.setting.system, self.setting.cost, node.state
        v = system.model.velocity(x)
        term = cost.stage(k, x.q, v, u) if k < self.N else cost.final(x.q, v)
        what = f"step {k}" if k < self.N else "the last state"
        check(term, self.n + len(u), what)
        g, half = np.array(term[1], dtype=float), self.n // 2
        by_v = g[half : self.n].copy()
        if np.any(by_v):  # v is a function of q and p
            g[half : self.n] = 0
            g[: self.n] += by_v @ system.velocity_slopes(x)[1]
        return float(term[0]), np.concatenate([node.chart.T @ g[: self.n], g[self.n :]])

    def open_gap(self, pair: int, node: Node) -> Array:
        """Return a gap, and its derivative by the unknowns of its state."""
        gaps = self.setting.system.model.gaps(node.state.q)
        by = np.asarray(gaps.phi_q[pair]) @ node.chart[: self.n // 2]
        return np.concatenate([[gaps.phi[pair]], by])
