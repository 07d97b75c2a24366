"""The results as Markdown."""

from __future__ import annotations

import math

COLUMNS = (
    "model",
    "n",
    "partials",
    "/ deriv",
    "L, L_q, L_v",
    "/ rnea",
    "lagrangian()",
    "step",
    "/ mj_step",
    "Newton",
    "mj_step",
    "derivatives",
    "rnea",
)

HOW = """\
All times are µs. saltus and Pinocchio are called in C++; MuJoCo by one call for 200 steps.
Every engine has the same tree, from the same URDF; contacts, limits, damping, mimic joints off.
Pinocchio and MuJoCo have a free-flyer where a base is free, saltus six joints.

- partials: L and all first and second partials: all non-zero products, into allocated arrays
- / deriv: the same over Pinocchio's computeRNEADerivatives
- / rnea: L, L_q, L_v over Pinocchio's rnea
- lagrangian(): partials as people call them: dense arrays are allocated, zeroed, made symmetric
- step: 200 steps of 1 ms after 10, from rest at 0.1 rad (robots: 0); mj_step: Euler, the same
- Newton: iterations a step"""


def markdown(results: dict) -> str:
    parts = ["\n".join(f"- {note}" for note in results["notes"]), HOW, times(results["rows"])]
    parts += [growth(results["rows"]), emblem(results["emblem"])]
    return "\n\n".join(part for part in parts if part)


def least(row: dict, name: str) -> float | None:
    time = row.get(name)
    return None if time is None else time["min"]


def ratio(row: dict, ours: str, theirs: str) -> float | None:
    a, b = least(row, ours), least(row, theirs)
    return None if a is None or b is None else a / b


def number(x: float | None, digits: int = 3) -> str:
    return "-" if x is None else f"{x:.{digits}g}"


def line(cells: list[str] | tuple[str, ...]) -> str:
    return f"| {' | '.join(cells)} |"


def times(rows: list[dict]) -> str:
    """Return times [us] and their ratios to the peers."""
    lines = [line(COLUMNS), line(["---"] * len(COLUMNS))]
    for row in rows:
        cells = [
            least(row, "partials"),
            ratio(row, "partials", "pinocchio_derivatives"),
            least(row, "first"),
            ratio(row, "first", "pinocchio_rnea"),
            least(row, "lagrangian"),
            least(row, "step"),
            ratio(row, "step", "mujoco_step"),
            row["iterations"],
            least(row, "mujoco_step"),
            least(row, "pinocchio_derivatives"),
            least(row, "pinocchio_rnea"),
        ]
        lines.append(line([row["model"], str(row["n"]), *map(number, cells)]))
    return "\n".join(lines)


def growth(rows: list[dict]) -> str:
    """Return exponents of time ~ n^e between models of a kind."""
    lines = []
    for kind, first, last in (("chain", 32, 256), ("chain", 16, 256), ("cradle", 60, 2000)):
        ends = [r for n in (first, last) for r in rows if r["kind"] == kind and r["n"] == n]
        if len(ends) != 2:
            continue
        span = math.log(last / first)
        exponents = [
            f"{name} {math.log(least(ends[1], name) / least(ends[0], name)) / span:.2f}"
            for name in ("partials", "generators", "step")
        ]
        lines.append(f"- growth exponents, {kind} n = {first} to {last}: {', '.join(exponents)}")
    return "\n".join(lines)


def emblem(runs: list[dict]) -> str:
    head = (
        "cradle of 3",
        "s",
        "wall s / s",
        "CPU s / s",
        "energy error",
        "largest angle of middle ball",
    )
    lines = [line(head), line(["---"] * len(head))]
    for run in runs:
        cells = (run["duration"], run["wall"], run["cpu"], run["energy_error"], run["resting_ball"])
        lines.append(line([run["engine"], *map(number, cells)]))
    return "\n".join(lines)
