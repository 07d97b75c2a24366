"""Other rules for the same impact, as README compares them.

One ball of a row of three that touch comes in with speed 1; the rules are computed here, each from
its definition.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests.conftest import ROOT

import saltus

NORMALS = np.diff(np.eye(3), axis=0)  # gradients of x[i + 1] - x[i]
CAME = np.array([1.0, 0.0, 0.0])


def reflections(masses: np.ndarray) -> np.ndarray:
    return saltus.resolve_impact(np.diag(masses), NORMALS, CAME).v


def complementarity(masses: np.ndarray) -> np.ndarray:
    """Return the solution of 0 <= lambda, 0 <= u+ + u-, lambda (u+ + u-) = 0, both contacts on."""
    G = NORMALS @ np.diag(1 / masses) @ NORMALS.T
    impulses = np.linalg.solve(G, -2 * NORMALS @ CAME)
    assert impulses.min() > 0
    return CAME + NORMALS.T @ impulses / masses


def springs(masses: np.ndarray, exponent: float) -> np.ndarray:
    """Return the velocities after contact by springs that only push.

    Their stiffness scales time and depth, not the velocities afterwards.
    """

    def rates(_: float, y: np.ndarray) -> np.ndarray:
        depths = np.maximum(-NORMALS @ y[:3], 0)
        return np.concatenate([y[3:], NORMALS.T @ depths**exponent / masses])

    start = np.concatenate([np.zeros(3), CAME])
    return solve_ivp(rates, (0, 40), start, rtol=1e-9, atol=1e-12).y[3:, -1]


RULES = {  # by the first words of their rows in README
    "reflections": reflections,
    "one complementarity problem": complementarity,
    "linear springs": lambda masses: springs(masses, 1.0),
    "Hertzian springs": lambda masses: springs(masses, 1.5),
}


def readme_row(begin: str) -> list[list[float]]:
    """Return the numbers of the table's row that begins so."""
    lines = (ROOT / "README.md").read_text(encoding="utf-8").splitlines()
    (row,) = (line for line in lines if line.startswith(f"| {begin}"))
    cells = row.replace("−", "-").strip("| ").split("|")[1:]
    return [[float(number) for number in cell.split(",")] for cell in cells]


@pytest.mark.parametrize("rule", RULES)
def test_readme_compares_what_is_so(rule):
    both_masses = np.array([[1, 1, 1], [1, 0.5, 1]])
    both_after = np.array([RULES[rule](masses) for masses in both_masses])
    np.testing.assert_allclose((both_masses * both_after).sum(axis=1), 1, atol=1e-6)  # momentum
    np.testing.assert_allclose((both_masses * both_after**2).sum(axis=1), 1, atol=1e-6)  # energy
    np.testing.assert_allclose(readme_row(rule), both_after, atol=6e-4)  # three decimals
