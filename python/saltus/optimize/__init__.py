"""Optimal control on the exact derivatives of steps, through impacts.

`ilqr` finds controls that make a cost small, `lqr` and `lqr_along` feedback about an equilibrium
and along a motion, `shoot` a few unknowns that make a miss zero, `orbit` a motion that repeats.
"""

from saltus.optimize.costs import Cost, Quadratic, Residuals
from saltus.optimize.iterate import ilqr
from saltus.optimize.orbits import Orbit, orbit
from saltus.optimize.plan import Plan, Policy
from saltus.optimize.reach import Reach
from saltus.optimize.regulate import Regulator, lqr, lqr_along
from saltus.optimize.shooting import Shot, shoot

__all__ = [
    "Cost",
    "Orbit",
    "Plan",
    "Policy",
    "Quadratic",
    "Reach",
    "Regulator",
    "Residuals",
    "Shot",
    "ilqr",
    "lqr",
    "lqr_along",
    "orbit",
    "shoot",
]
