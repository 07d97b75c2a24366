"""The backward pass of iLQR with bounds on u, and the small box QP inside it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from saltus.optimize.costs import Expansions
from saltus.optimize.curvature import Curvature
from saltus.optimize.system import Array, Slopes


@dataclass(frozen=True)
class Feedback:
    """du = alpha open_k + gain_k dx, and the decrease of the cost to expect of it.

    Attributes
    ----------
    open : numpy.ndarray, shape (N, n_u)
    gain : numpy.ndarray, shape (N, n_u, 2 n_v)
        0 where a control is at its bound.
    linear, square : float
        The cost changes by alpha linear + alpha^2 square, to second order.
    """

    open: Array
    gain: Array
    linear: float
    square: float

    @property
    def decrement(self) -> float:
        """What the cost falls by with alpha = 1, to second order."""
        return -(self.linear + self.square)


def box_qp(
    H: Array, g: Array, low: Array, high: Array
) -> tuple[Array, npt.NDArray[np.bool_]] | None:
    """Minimise g.x + x.H x / 2 with low <= x <= high, by projected Newton steps.

    Returns
    -------
    x : numpy.ndarray, shape (n,)
    free : numpy.ndarray, shape (n,)
        Whether x is between its bounds. None in place of both where H is not positive.
    """
    x = np.clip(np.zeros(len(g)), low, high)
    free = np.ones(len(g), dtype=bool)
    for _ in range(100):
        slope = g + H @ x
        free = ~(((x <= low) & (slope > 0)) | ((x >= high) & (slope < 0)))
        if not free.any():
            return x, free
        try:
            L = np.linalg.cholesky(H[np.ix_(free, free)])
        except np.linalg.LinAlgError:
            return None
        step = np.zeros(len(g))
        step[free] = -np.linalg.solve(L.T, np.linalg.solve(L, slope[free]))
        if np.abs(step).max() <= 1e-14 * (1 + np.abs(x).max()):
            return x, free
        value, alpha = g @ x + 0.5 * x @ H @ x, 1.0
        while alpha > 1e-10:
            trial = np.clip(x + alpha * step, low, high)
            if g @ trial + 0.5 * trial @ H @ trial <= value + 1e-4 * slope @ (trial - x):
                break
            alpha *= 0.5
        if np.array_equal(trial, x):
            return x, free
        x = trial
    return x, free


def backward(
    cost: Expansions,
    slopes: Slopes,
    control: Array,
    bounds: tuple[Array, Array],
    damping: float,
    curvature: Curvature | None = None,
) -> Feedback | None:
    """Return the feedback that the quadratic model of the cost wants; None if it has no minimum.

    Riccati's recursion from the last step to the first: with V the cost to go,
    Q_x = l_x + A^T V_x, Q_u = l_u + B^T V_x, Q_uu = l_uu + B^T V_xx B + damping, and so on.
    """
    N, m = control.shape
    n = slopes.A.shape[1]
    low, high = bounds
    is_bounded = bool(np.isfinite(low).any() or np.isfinite(high).any())
    open_loop, gain = np.zeros((N, m)), np.zeros((N, m, n))
    V_x, V_xx = cost.x[N], cost.xx[N] if curvature is None else curvature.of_the_end()
    linear = square = 0.0
    for k in reversed(range(N)):
        A, B = slopes.A[k], slopes.B[k]
        l_xx, l_uu, l_ux = cost.xx[k], cost.uu[k], cost.ux[k]
        if curvature is not None:
            H = curvature(k, V_x)
            l_xx, l_uu, l_ux = H[:n, :n], H[n:, n:], H[n:, :n]
        VB = V_xx @ B
        Q_x, Q_u = cost.x[k] + A.T @ V_x, cost.u[k] + B.T @ V_x
        Q_xx, Q_uu, Q_ux = l_xx + A.T @ V_xx @ A, l_uu + B.T @ VB, l_ux + VB.T @ A
        damped = Q_uu + damping * np.eye(m)
        free = np.ones(m, dtype=bool)
        if is_bounded:
            found = box_qp(damped, Q_u, low - control[k], high - control[k])
            if found is None:
                return None
            du, free = found
        K = np.zeros((m, n))
        if free.any():
            try:
                L = np.linalg.cholesky(damped[np.ix_(free, free)])
            except np.linalg.LinAlgError:
                return None
            K[free] = -np.linalg.solve(L.T, np.linalg.solve(L, Q_ux[free]))
            if not is_bounded:
                du = -np.linalg.solve(L.T, np.linalg.solve(L, Q_u))
        open_loop[k], gain[k] = du, K
        linear += float(du @ Q_u)
        square += 0.5 * float(du @ Q_uu @ du)
        V_x = Q_x + K.T @ (Q_uu @ du + Q_u) + Q_ux.T @ du
        V_xx = Q_xx + K.T @ Q_uu @ K + K.T @ Q_ux + Q_ux.T @ K
        V_xx = 0.5 * (V_xx + V_xx.T)
    return Feedback(open_loop, gain, linear, square)
