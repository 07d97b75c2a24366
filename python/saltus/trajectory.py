"""The path that `saltus.Trajectory` had before, which pickles of runs from then name."""

from saltus.runs.trajectory import Trajectory

__all__ = ["Trajectory"]
