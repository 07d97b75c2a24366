"""Pictures of runs, impacts and pairs of shapes. Needs matplotlib: pip install 'saltus[demo]'."""

from saltus.plots.cradle import is_cradle, plot_cradle
from saltus.plots.impacts import plot_cascade, plot_impacts
from saltus.plots.pairs import plot_gap, plot_gaps
from saltus.plots.run import plot, plot_run

__all__ = [
    "is_cradle",
    "plot",
    "plot_cascade",
    "plot_cradle",
    "plot_gap",
    "plot_gaps",
    "plot_impacts",
    "plot_run",
]
