"""The path that `saltus.plots.impacts` had before."""

from saltus.plots.impacts import plot_cascade, plot_impacts

__all__ = ["plot_cascade", "plot_impacts"]
