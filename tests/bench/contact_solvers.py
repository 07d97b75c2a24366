"""The solver of contacts' law beside Pinocchio's ADMM and PGS, and SciPy's nnls without friction.

    python -m tests.bench.contact_solvers --count 10

Contacts that do not rebound are resolved together: impulses p in the cones of friction, velocities
u = G p + u0 after them. `residual` is that of the law, `p - P(p - (u + mu |u_t| n) / G_ii)` with P
the projection on the cones and n the normals, over the largest impulse; a cell has its median and
worst of all problems, and the median time in microseconds of CPU. saltus is given M, N and T, and
makes G itself; the others are given G. PGS of Pinocchio 4.1 takes its first sweep for the answer
where mu = 0: its residuals there are those of one sweep.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from tqdm import tqdm

import saltus
from tests.bench.table import grid

try:
    import pinocchio as pin
except ImportError:
    pin = None
try:
    from scipy.optimize import nnls
except ImportError:
    nnls = None

SIZES = (1, 4, 16, 60)  # contacts
FRICTIONS = (0.0, 0.5)
HALF = (0.2, 0.15, 0.1)  # [m] of the boxes
TOLERANCE, ITERATIONS = 1e-10, 10_000  # of Pinocchio's
SETTLED = 1e-6  # residuals above this are counted


@dataclass
class Problem:
    """Free bodies at one instant: M, gradients of gaps N and of slips T, velocities v."""

    M: np.ndarray
    N: np.ndarray
    T: np.ndarray
    v: np.ndarray
    friction: float

    def rows(self) -> np.ndarray:
        """Return the rows of all contacts: two tangents and the normal of one after another."""
        m = len(self.N)
        J = np.zeros((3 * m, len(self.v)))
        J[0::3], J[1::3], J[2::3] = self.T[0::2], self.T[1::2], self.N
        return J


def frame(normal: np.ndarray) -> np.ndarray:
    """Return two unit tangents and the normal, as rows."""
    first = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    first /= np.linalg.norm(first)
    return np.array([first, np.cross(normal, first), normal])


def of_contacts(
    masses: np.ndarray, contacts: list[tuple], v: np.ndarray, friction: float
) -> Problem:
    """Contacts are (body, arm, other body or -1 for the world, its arm, normal)."""
    inertia = np.array([1, 1, 1, 0.02, 0.03, 0.04])
    M = np.diag((masses[:, None] * inertia).ravel())
    N, T = np.zeros((len(contacts), len(v))), np.zeros((2 * len(contacts), len(v)))
    for i, (a, arm_a, b, arm_b, normal) in enumerate(contacts):
        axes = frame(np.asarray(normal, float))
        for body, arm, sign in ((a, arm_a, 1), (b, arm_b, -1)):
            if body < 0:
                continue
            rows = sign * np.hstack([axes, np.cross(arm, axes)])
            T[2 * i : 2 * i + 2, 6 * body : 6 * body + 6] = rows[:2]
            N[i, 6 * body : 6 * body + 6] = rows[2]
    return Problem(M, N, T, v, friction)


def bodies_at_random(m: int, friction: float, rng: np.random.Generator) -> Problem:
    """Bodies that touch each other and the world wherever."""
    n = m // 2 + 1
    contacts = []
    for _ in range(m):
        a, b = (int(i) for i in rng.choice(np.arange(-1, n), 2, replace=False))
        normal = rng.normal(size=3)
        normal /= np.linalg.norm(normal)
        contacts.append((a, *rng.uniform(-0.2, 0.2, (1, 3)), b, rng.uniform(-0.2, 0.2, 3), normal))
    return of_contacts(rng.uniform(0.5, 2, n), contacts, rng.normal(size=6 * n), friction)


def tower(m: int, friction: float, rng: np.random.Generator, heavy: float = 1.0) -> Problem:
    """Boxes on each other, four corners each; masses alternate, up to `heavy` apart."""
    n = -(-m // 4)
    corners = [(x, y) for x in (-1, 1) for y in (-1, 1)]
    contacts = []
    for i in range(m):
        x, y = corners[i % 4]
        low, high = np.multiply(HALF, (x, y, -1)), np.multiply(HALF, (x, y, 1))
        contacts.append((i // 4, low, i // 4 - 1, high, (0, 0, 1)))
    v = np.tile([0, 0, -0.1, 0, 0, 0], n) + rng.normal(size=6 * n, scale=0.05)
    return of_contacts(np.where(np.arange(n) % 2, heavy, 1.0), contacts, v, friction)


def tower_of_many_masses(m: int, friction: float, rng: np.random.Generator) -> Problem:
    return tower(m, friction, rng, 1e4)


def jammed(m: int, friction: float, rng: np.random.Generator) -> Problem:
    """Boxes in a row without play between two walls: no velocity opens all gaps."""
    n = max(1, m - 1)
    contacts = []
    for i in range(m):  # the last one is with the far wall
        a, b = (i, i - 1) if i < n else (-1, n - 1)
        arms = (np.array([-HALF[0], 0, 0]), np.array([HALF[0], 0, 0]))
        contacts.append((a, arms[0], b, arms[1], (1, 0, 0)))
    return of_contacts(np.ones(n), contacts, rng.normal(size=6 * n), friction)


PROBLEMS = {
    "at random": bodies_at_random,
    "tower": tower,
    "tower, masses 1e4 apart": tower_of_many_masses,
    "jammed row": jammed,
}


def delassus(problem: Problem) -> tuple[np.ndarray, np.ndarray]:
    J = problem.rows()
    return J @ np.linalg.solve(problem.M, J.T), J @ problem.v


def projected(p: np.ndarray, friction: float) -> np.ndarray:
    """Return p, shape (m, 3), on the cones |p_t| <= mu p_n."""
    normal, size = p[:, 2], np.linalg.norm(p[:, :2], axis=1)
    on_ray = np.maximum((friction * size + normal) / (1 + friction**2), 0)
    inside = size <= friction * normal
    normal_on = np.where(inside, normal, on_ray)
    ratio = np.where(inside, 1, friction * on_ray / np.where(size > 0, size, 1))
    return np.column_stack([p[:, :2] * ratio[:, None], normal_on])


def residual(problem: Problem, p: np.ndarray) -> float:
    """Return by how much impulses p, shape (3 m,), miss the law, over the largest."""
    G, u0 = delassus(problem)
    u = (G @ p + u0).reshape(-1, 3)
    u[:, 2] += problem.friction * np.linalg.norm(u[:, :2], axis=1)
    p = p.reshape(-1, 3)
    scale = G.diagonal().reshape(-1, 3).max(axis=1)[:, None]
    missed = p - projected(p - u / scale, problem.friction)
    largest = np.abs(p).max() or np.abs(u0).max() / scale.max()
    return float(np.abs(missed).max() / largest)


def of_saltus(problem: Problem) -> tuple[np.ndarray, float]:
    """Return the impulses, shape (3 m,), and the time [s]."""
    M, N, T, v = problem.M, problem.N, problem.T, problem.v
    start = time.thread_time()
    out = saltus.resolve_impact(M, N, v, restitution=0, T=T, friction=problem.friction)
    spent = time.thread_time() - start
    p = np.zeros((len(N), 3))
    np.add.at(p[:, 2], out.impulses["pair"], out.impulses["lambda"])
    np.add.at(p[:, :2], out.impulses["pair"], out.impulses["tangential"])
    return p.ravel(), spent


def of_pinocchio(problem: Problem, name: str) -> tuple[np.ndarray, float]:
    """Return the same of Pinocchio's solver ADMM or PGS."""
    G, u0 = delassus(problem)
    world = pin.Model()
    models, datas = pin.StdVec_ConstraintModel(), pin.StdVec_ConstraintData()
    for _ in problem.N:
        contact = pin.PointContactConstraintModel(world, 0, pin.SE3.Identity())
        contact.setFriction(problem.friction)
        models.append(pin.ConstraintModel(contact))
        datas.append(models[len(models) - 1].createData())
    settings = getattr(pin, f"{name}SolverSettings")()
    settings.max_iterations = ITERATIONS
    for each in ("feasibility", "complementarity"):
        setattr(settings, f"absolute_{each}_tol", TOLERANCE)
        setattr(settings, f"relative_{each}_tol", TOLERANCE)
    solver, result = (
        getattr(pin, f"{name}ConstraintSolver")(),
        getattr(pin, f"{name}SolverResult")(),
    )
    operator = pin.DelassusOperatorDense(G)
    start = time.thread_time()
    solver.solve(operator, u0, models, datas, settings, result)
    spent = time.thread_time() - start
    return np.array(result.retrieveConstraintImpulses()), spent


def of_nnls(problem: Problem) -> tuple[np.ndarray, float]:
    """Least |L^-1 N^T p + L^T v| with p >= 0, M = L L^T: the law without friction."""
    L = np.linalg.cholesky(problem.M)
    A, b = np.linalg.solve(L, problem.N.T), -L.T @ problem.v
    start = time.thread_time()
    normal, _ = nnls(A, b, maxiter=ITERATIONS)
    spent = time.thread_time() - start
    p = np.zeros((len(normal), 3))
    p[:, 2] = normal
    return p.ravel(), spent


def solvers() -> dict[str, Callable[[Problem], tuple[np.ndarray, float]]]:
    """Return those that are installed."""
    found = {"saltus": of_saltus}
    if hasattr(pin, "ADMMConstraintSolver"):  # Pinocchio 4
        found["Pinocchio ADMM"] = lambda problem: of_pinocchio(problem, "ADMM")
        found["Pinocchio PGS"] = lambda problem: of_pinocchio(problem, "PGS")
    if nnls is not None:
        found["SciPy nnls"] = of_nnls
    return found


def measured(solve: Callable, problems: list[Problem]) -> str:
    """Return a cell: median and worst residual, median time, and how many are not settled."""
    residuals, times, failed = [], [], 0
    for problem in problems:
        try:
            p, spent = solve(problem)
        except RuntimeError:  # JammedError, or nnls without end
            failed += 1
            continue
        residuals.append(residual(problem, p))
        times.append(1e6 * spent)
    missed = failed + int(np.sum(np.array(residuals) > SETTLED))
    of_all = f", {missed} of {len(problems)} not settled" if missed else ""
    if not residuals:
        return f"none{of_all}"
    return f"{np.median(residuals):.0e} ({max(residuals):.0e}), {np.median(times):.0f} µs{of_all}"


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--count", type=int, default=10, help="problems of each kind and size")
    parser.add_argument("--sizes", type=int, nargs="+", default=SIZES, help="contacts")
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    rng, named = np.random.default_rng(args.seed), solvers()
    kinds = [(kind, m, mu) for kind in PROBLEMS for mu in FRICTIONS for m in args.sizes]
    rows = []
    for kind, m, friction in tqdm(kinds, unit="kind", disable=None):
        problems = [PROBLEMS[kind](m, friction, rng) for _ in range(args.count)]
        cells = [
            "-" if name == "SciPy nnls" and friction else measured(solve, problems)
            for name, solve in named.items()
        ]
        rows.append([kind, str(m), f"{friction:g}", *cells])
    print(grid(["contacts of", "contacts", "mu", *named], rows))


if __name__ == "__main__":
    main()
