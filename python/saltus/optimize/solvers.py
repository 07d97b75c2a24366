"""Solvers of nonlinear programs: those of SciPy, and the interface for others."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from saltus._core import ModelError
from saltus.optimize.program import Program
from saltus.optimize.sparse import Triplets
from saltus.optimize.system import Array


class Solution(NamedTuple):
    """What a solver has found.

    Attributes
    ----------
    z : numpy.ndarray, shape (n,)
    converged : bool
    message : str
        Why it ended.
    """

    z: Array
    converged: bool
    message: str


MOST_DENSE = 400  # unknowns, of which SLSQP takes seconds

Solver = Callable[[Program], Solution]


def solver_of(solver: str | Solver | None) -> Solver:
    """Return a solver by its name, or the caller's own; None chooses by size."""
    if solver is None:
        return lambda program: (by_slsqp if len(program.guess) <= MOST_DENSE else by_trust_region)(
            program
        )
    if callable(solver):
        return solver
    names = {"trust-constr": by_trust_region, "slsqp": by_slsqp}
    if solver not in names:
        raise ModelError(
            f"solver is {solver!r}; it is one of {', '.join(map(repr, names))} of SciPy, or a "
            "function from optimize.Program to optimize.Solution"
        )
    return names[solver]


def scipy_minimize() -> Any:
    """Return the module scipy.optimize, or say how to get it."""
    try:
        import scipy.optimize
        import scipy.sparse
    except ImportError as error:
        raise ImportError(
            "transcribe needs SciPy, or a solver of your own as solver=: pip install scipy"
        ) from error
    return scipy


def by_trust_region(program: Program) -> Solution:
    """Return what SciPy's trust-constr finds: sparse, with second derivatives.

    Byrd, Hribar and Nocedal, "An interior point algorithm for large-scale nonlinear programming",
    SIAM Journal on Optimization 9, 1999.
    """
    scipy = scipy_minimize()
    n, m = len(program.guess), len(program.least)

    def sparse(entries: Triplets, rows: int) -> Any:
        at = entries.rows, entries.columns
        return scipy.sparse.csr_matrix((entries.values, at), shape=(rows, n))

    constraints = scipy.optimize.NonlinearConstraint(
        program.constraints,
        program.least,
        program.most,
        jac=lambda z: sparse(program.jacobian(z), m),
        hess=lambda z, y: sparse(program.hessian(z, 0.0, np.asarray(y)), n),
    )
    bounded = np.any(np.isfinite(program.low)) or np.any(np.isfinite(program.high))
    found = scipy.optimize.minimize(
        program.cost,
        program.guess,
        method="trust-constr",
        jac=program.gradient,
        hess=lambda z: sparse(program.hessian(z, 1.0, None), n),
        bounds=scipy.optimize.Bounds(program.low, program.high) if bounded else None,
        constraints=constraints,
        callback=lambda z, _: program.note(z),
        options={
            "maxiter": program.iterations,
            "gtol": program.tolerance,
            "xtol": 1e-3 * program.tolerance,
            "barrier_tol": program.tolerance,
            "sparse_jacobian": True,
        },
    )
    return Solution(np.asarray(found.x), bool(found.status in (1, 2)), str(found.message))


def by_slsqp(program: Program) -> Solution:
    """Return what SciPy's SLSQP finds: dense, so for some hundred unknowns.

    Kraft, "A software package for sequential quadratic programming", DFVLR-FB 88-28, 1988.
    """
    scipy = scipy_minimize()
    equal = program.least == program.most
    above, below = np.isfinite(program.least) & ~equal, np.isfinite(program.most) & ~equal
    signs = np.concatenate([np.ones(int(above.sum())), -np.ones(int(below.sum()))])
    limits = np.concatenate([program.least[above], -program.most[below]])
    rows = np.concatenate([np.flatnonzero(above), np.flatnonzero(below)])

    def dense(z: Array) -> Array:
        J = np.zeros((len(program.least), len(z)))
        entries = program.jacobian(z)
        np.add.at(J, (entries.rows, entries.columns), entries.values)
        return J

    constraints = [
        {
            "type": "eq",
            "fun": lambda z: (program.constraints(z) - program.least)[equal],
            "jac": lambda z: dense(z)[equal],
        }
    ]
    if len(rows):
        constraints.append(
            {
                "type": "ineq",
                "fun": lambda z: signs * program.constraints(z)[rows] - limits,
                "jac": lambda z: signs[:, None] * dense(z)[rows],
            }
        )
    found = scipy.optimize.minimize(
        program.cost,
        program.guess,
        method="SLSQP",
        jac=program.gradient,
        bounds=scipy.optimize.Bounds(program.low, program.high),
        constraints=constraints,
        callback=program.note,
        options={"maxiter": program.iterations, "ftol": 1e-2 * program.tolerance},
    )
    return Solution(np.asarray(found.x), bool(found.success), str(found.message))
