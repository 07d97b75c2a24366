"""Second derivatives of cost and step: exact of smooth steps, else differences of gradients."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from saltus._core import State
from saltus.optimize.costs import Cost, to_state
from saltus.optimize.system import Array, Rollout, System, difference_slopes

# Of central differences of a gradient: (machine epsilon)^(1/3).
STEP = 6e-6


def hessian(gradient: Callable[[Array], Array], scales: Array) -> Array:
    """Return the symmetric part of the derivative of a gradient at 0, by central differences."""
    columns = []
    for i, scale in enumerate(scales):
        d = np.zeros(len(scales))
        d[i] = STEP * scale
        columns.append((gradient(d) - gradient(-d)) / (2 * STEP * scale))
    H = np.stack(columns, axis=1)
    return np.asarray(0.5 * (H + H.T))


class Curvature:
    """The Hessian of l_k + V_x . F by x = (q, p) and u, for each step of a rollout.

    That of a smooth step is exact. Of costs and other steps it is by differences of gradients, in a
    chart about the rollout's own states. A ball's gradient is along turns and no chart's; the
    antisymmetric part is what that adds, and is left out.
    """

    def __init__(self, system: System, cost: Cost, path: Rollout) -> None:
        self.system, self.cost, self.path = system, cost, path

    def priced(self, k: int, x: State, u: Array) -> Array:
        """Return the gradient by (q, p, u) of step k's cost."""
        term = self.cost.stage(k, x.q, self.system.model.velocity(x), u)
        return to_state(self.system, x, term[1], term[2])[0]

    def pulled(self, k: int, x: State, u: Array, after: Array) -> Array:
        """Return the gradient by (q, p, u) of `after` . F."""
        system, n = self.system, self.system.model.n_v
        end = system.advance(x, u)
        q_hat = after[:n]
        if system.balls:
            moved = system.model.difference(self.path.states[k + 1].q, end.q)
            q_hat = difference_slopes(system.balls, moved).T @ q_hat
        back = system.stepper.vjp(q_hat, after[n:])
        return np.concatenate([back.q, back.p, back.control])

    def __call__(self, k: int, after: Array) -> Array:
        """Return the Hessian of step k, (2 n_v + n_u, 2 n_v + n_u)."""
        x = self.path.states[k]
        u = self.system.inside(self.path.control[k], 2 * STEP)
        n = 2 * self.system.model.n_v
        scales = [np.ones(n // 2), np.maximum(np.abs(x.p), 1), np.maximum(np.abs(u), 1)]

        exact = self.system.hessian(x, u, after[: n // 2], after[n // 2 :])

        def gradient(d: Array) -> Array:
            near = self.system.shift(x, d[:n]), u + d[n:]
            g = self.priced(k, *near)
            return g if exact is not None else g + self.pulled(k, *near, after)

        H = hessian(gradient, np.concatenate(scales))
        return H if exact is None else H + exact

    def of_the_end(self) -> Array:
        """Return the Hessian of the last state's cost, (2 n_v, 2 n_v)."""
        x, n_v = self.path.states[-1], self.system.model.n_v

        def gradient(d: Array) -> Array:
            y = self.system.shift(x, d)
            term = self.cost.final(y.q, self.system.model.velocity(y))
            return to_state(self.system, y, term[1], term[2])[0]

        return hessian(gradient, np.repeat([1.0, max(1.0, float(np.abs(x.p).max()))], n_v))
