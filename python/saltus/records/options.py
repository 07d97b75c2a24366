"""The options of a run's steps as arguments of a `Stepper`."""

from __future__ import annotations

from typing import Any

from saltus._core import StepOptions

NAMES = (
    "law",
    "collisions",
    "order",
    "max_iterations",
    "max_impacts",
    "max_halvings",
    "max_impulses",
    "rest",
    "simultaneous",
    "strict",
)


def step_arguments(options: StepOptions) -> dict[str, Any]:
    """Return all that makes a step but h, and certificates, which change none."""
    return {name: getattr(options, name) for name in NAMES}
