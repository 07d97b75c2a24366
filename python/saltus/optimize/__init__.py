"""Optimal control on the exact derivatives of steps, through impacts.

`ilqr` finds controls that make a cost small, `lqr` and `lqr_along` feedback about an equilibrium
and along a motion, `shoot` a few unknowns that make a miss zero, `orbit` a motion that repeats.
`transcribe` makes states unknowns too, and impacts a plan.
"""

from saltus.optimize.costs import Cost, Quadratic, Residuals
from saltus.optimize.iterate import ilqr
from saltus.optimize.orbits import Orbit, orbit
from saltus.optimize.plan import Plan, Policy
from saltus.optimize.program import Program
from saltus.optimize.reach import Reach
from saltus.optimize.regulate import Regulator, lqr, lqr_along
from saltus.optimize.shooting import Shot, shoot
from saltus.optimize.solvers import Solution
from saltus.optimize.sparse import Triplets
from saltus.optimize.transcribing import transcribe
from saltus.optimize.transcription import Transcription

__all__ = [
    "Cost",
    "Orbit",
    "Plan",
    "Policy",
    "Program",
    "Quadratic",
    "Reach",
    "Regulator",
    "Residuals",
    "Shot",
    "Solution",
    "Transcription",
    "Triplets",
    "ilqr",
    "lqr",
    "lqr_along",
    "orbit",
    "shoot",
    "transcribe",
]
