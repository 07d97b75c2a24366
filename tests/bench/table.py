"""The results as Markdown."""

from __future__ import annotations

from tests.bench import trep
from tests.bench.flops import partials_flops

HOW = f"""\
Times are µs of thread CPU time, the least of all passes. saltus and Pinocchio are called in C++,
MuJoCo and Drake by one call for 200 steps, DART by one call a step. Every engine has the same tree,
from the same URDF, fixed joints folded; contacts, limits, damping, mimic joints off. saltus has six
joints where a base is free, the others have a free-flyer. A ratio below 1 means saltus is faster.

- partials: L and all first and second partials: all non-zero products, into allocated arrays
- / deriv, / rnea: over Pinocchio's computeRNEADerivatives, and L, L_q, L_v over its rnea
- inverse / rnea, forward / aba: inverse and forward dynamics, kinematics included, over Pinocchio's
- of peak: flops of the partials (480 a joint, 54 a pair of joint and ancestor) in their time, over
  what a loop of fused multiply-adds reaches on the same core
- step: 200 steps of 1 ms after 10, from rest at 0.1 rad (robots: at 0 rad, with
  0.2 rad/s in every joint); Newton: iterations a step
- / Euler, / implicit: over mj_step with these integrators; / Drake: over the discrete step of a
  MultibodyPlant; / DART: over World.step
- / trep: over published figures, {trep.SOURCE}
- heap: allocations in all the timed steps together"""

RATIOS = {
    "model": lambda row, _: row["model"],
    "n": lambda row, _: str(row["n"]),
    "partials": lambda row, _: number(least(row, "partials")),
    "/ deriv": lambda row, _: number(ratio(row, "partials", "pinocchio_derivatives")),
    "/ trep": lambda row, _: number(ratio(row, "partials", "trep_partials"), 2),
    "of peak": lambda row, peaks: percent(fraction_of_peak(row, peaks)),
    "L, L_q, L_v": lambda row, _: number(least(row, "first")),
    "/ rnea": lambda row, _: number(ratio(row, "first", "pinocchio_rnea")),
    "inverse / rnea": lambda row, _: number(ratio(row, "inverse_dynamics", "pinocchio_rnea")),
    "forward / aba": lambda row, _: number(ratio(row, "accelerations", "pinocchio_aba")),
    "step": lambda row, _: number(least(row, "step")),
    "Newton": lambda row, _: number(row.get("iterations")),
    "/ Euler": lambda row, _: number(ratio(row, "step", "mujoco_step")),
    "/ implicit": lambda row, _: number(ratio(row, "step", "mujoco_implicit_step")),
    "/ Drake": lambda row, _: number(ratio(row, "step", "drake_step")),
    "/ DART": lambda row, _: number(ratio(row, "step", "dart_step")),
    "10 ms step / trep": lambda row, _: number(ratio(row, "step_10ms", "trep_step_10ms"), 2),
    "heap": lambda row, _: number(row.get("allocations")),
}

TIMES = {  # what the ratios are made of, and more
    "partials": "partials",
    "lagrangian": "lagrangian()",
    "first": "L, L_q, L_v",
    "inverse_dynamics": "inverse dynamics",
    "accelerations": "forward dynamics",
    "newton": "one Newton iteration",
    "step": "step",
    "step_10ms": "10 ms step",
    "mujoco_step": "mj_step Euler",
    "mujoco_implicit_step": "mj_step implicit",
    "drake_step": "Drake",
    "dart_step": "DART",
    "pinocchio_derivatives": "computeRNEADerivatives",
    "pinocchio_aba_derivatives": "computeABADerivatives",
    "pinocchio_rnea": "rnea",
    "pinocchio_aba": "aba",
}


def markdown(results: dict) -> str:
    parts = [bullets(notes(results)), HOW, ratios(results), growth(results["growth"])]
    parts += ["Absolute times [µs]:", times(results["rows"]), impacts(results["impacts"])]
    parts += [batch(results["batch"]), emblem(results["emblem"])]
    return "\n\n".join(part for part in parts if part)


def notes(results: dict) -> list[str]:
    """Return what was measured on which machine, and what was not."""
    machine, peaks = results["machine"], results["peaks"]
    return [
        f"CPU: {machine['cpu']}, {machine['logical']} logical; {machine['system']}",
        f"its peaks, one thread: {peaks['fma_gflops']:.0f} GFlop/s of fused multiply-adds, "
        f"{peaks['copy_gbs']:.1f} GB/s copy, {peaks['triad_gbs']:.1f} GB/s triad",
        *results["versions"],
        *results["absent"],
        *results["errors"],
    ]


def least(row: dict, name: str) -> float | None:
    time = row.get(name)
    return None if time is None else time["min"]


def ratio(row: dict, ours: str, theirs: str) -> float | None:
    a, b = least(row, ours), least(row, theirs)
    return None if a is None or b is None else a / b


def fraction_of_peak(row: dict, peaks: dict) -> float | None:
    time = least(row, "partials")
    if time is None:
        return None
    return partials_flops(row["n"], row["pairs"]) / (1e3 * time) / peaks["fma_gflops"]


def number(x: float | None, digits: int = 3) -> str:
    if x is None:
        return "-"
    return f"{x:.0f}" if abs(x) >= 10**digits else f"{x:.{digits}g}"


def percent(x: float | None) -> str:
    return "-" if x is None else f"{100 * x:.1f} %"


def grid(head: list[str], rows: list[list[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def bullets(lines: list[str]) -> str:
    return "\n".join(f"- {line}" for line in lines)


def ratios(results: dict) -> str:
    """Return our times and how they compare; columns without numbers are left out."""
    cells = [[cell(row, results["peaks"]) for cell in RATIOS.values()] for row in results["rows"]]
    return filled_columns(list(RATIOS), cells)


def times(rows: list[dict]) -> str:
    """Return all times [us] that the ratios are made of."""
    cells = [
        [row["model"], str(row["n"]), *(number(least(row, name)) for name in TIMES)] for row in rows
    ]
    return filled_columns(["model", "n", *TIMES.values()], cells)


def filled_columns(head: list[str], rows: list[list[str]]) -> str:
    keep = [i for i in range(len(head)) if any(row[i] != "-" for row in rows)]
    return grid([head[i] for i in keep], [[row[i] for i in keep] for row in rows])


def growth(entries: list[dict]) -> str:
    """Return exponents of time ~ n^e between two models of a kind."""
    return bullets(
        [
            f"growth exponent of {entry['name']}, {entry['kind']} n = {entry['first']} to "
            f"{entry['last']}: {entry['exponent']:.2f}"
            for entry in entries
        ]
    )


def impacts(rows: list[dict]) -> str:
    """Return what a step with impacts costs over one without."""
    head = ["touching balls", "h", "smooth step", "step with impact", "ratio"]
    head += ["contacts", "impulses an impact", "arcs a step"]
    lines = []
    for row in rows:
        if row["smooth"] <= 0 or row["steps"] == 0:
            continue
        cells = (row["smooth"], row["impact"], row["impact"] / row["smooth"], row["contacts"])
        each = (row["impulses"] / row["impacts"], row["arcs"] / row["steps"])
        lines.append([row["model"], str(row["h"]), *map(number, (*cells, *each))])
    return grid(head, lines)


def batch(result: dict) -> str:
    """Return what a second thread is worth to a batch, and to a loop of multiply-adds."""
    if not result:
        return ""
    # read from JSON, the numbers of threads are text
    wall, cpu = (
        {int(n): seconds for n, seconds in result[name].items()} for name in ("wall", "cpu")
    )
    head = ["cradles of 3", "s each", "wall s, 1 thread", "2 threads", "CPU s, 1 thread"]
    head += ["2 threads", "speed-up", "of a multiply-add loop", "the one over the other"]
    cells = (result["runs"], result["duration"], wall[1], wall[2], cpu[1], cpu[2])
    ends = (result["scaling"], result["scaling_multiply_adds"], result["efficiency"])
    return grid(head, [list(map(number, (*cells, *ends)))])


def emblem(runs: list[dict]) -> str:
    """Return the touching cradle of three, engine by engine."""
    head = ["cradle of 3", "simulated s", "CPU s / s"]
    head += ["energy error", "largest angle of the middle ball"]
    lines = []
    for run in runs:
        cells = (run["duration"], run["cpu"], run["energy_error"], run["resting_ball"])
        lines.append([run["engine"], *map(number, cells)])
    return grid(head, lines)
