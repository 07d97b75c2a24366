"""CPU time of this thread."""

from __future__ import annotations

from typing import TypedDict

PASSES = 7


class Time(TypedDict):
    min: float  # [us] a call
    median: float  # [us] a call


def summary(seconds: list[float]) -> Time:
    ordered = sorted(seconds)
    return {"min": 1e6 * ordered[0], "median": 1e6 * ordered[len(ordered) // 2]}
