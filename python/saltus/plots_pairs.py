"""The path that `saltus.plots.pairs` had before."""

from saltus.plots.pairs import Placed, draw_gap, plot_gap, plot_gaps

__all__ = ["Placed", "draw_gap", "plot_gap", "plot_gaps"]
