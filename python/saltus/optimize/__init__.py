"""Optimal control on the exact derivatives of steps, through impacts.

`ilqr` finds controls that make a cost small, `lqr` feedback about an equilibrium or a motion,
`shoot` a few unknowns that make a miss zero.
"""

from saltus.optimize.costs import Cost, Quadratic, Residuals
from saltus.optimize.iterate import ilqr
from saltus.optimize.plan import Plan, Policy

__all__ = ["Cost", "Plan", "Policy", "Quadratic", "Residuals", "ilqr"]
