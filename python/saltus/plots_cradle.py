"""The path that `saltus.plots.cradle` had before."""

from saltus.plots.cradle import is_cradle, plot_cradle

__all__ = ["is_cradle", "plot_cradle"]
