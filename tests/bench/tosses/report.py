"""The results as Markdown, and as the manual's page."""

from __future__ import annotations

from pathlib import Path

from tests.bench.table import bullets, grid
from tests.bench.tosses import measures, picture
from tests.bench.tosses.data import EDGE, GRAVITY, ROW

TEMPLATE = Path(__file__).with_name("page.md")
STARTS = ("recorded", "calibrated", "flight")
MEASURES = ["position mean", "median", "angle mean", "median", "failed"]


def cells(one: dict) -> list[str]:
    """Return position [widths] and angle [deg], means and medians, and failures, of a Summary."""
    positions = [f"{one[f'position_{which}']:.3f}" for which in ("mean", "median")]
    angles = [f"{one[f'angle_{which}']:.1f}" for which in ("mean", "median")]
    return [*positions, *angles, str(one["failed"])]


def errors(results: dict, start: str) -> str:
    """Return the table of what each engine reaches from starts of one kind."""
    head = ["engine", *MEASURES, "CPU [s]"]
    rows = []
    for engine in results["engines"]:
        run = engine["starts"][start]
        rows.append([engine["name"], *cells(run["on_report"]), f"{run['cpu']:.1f}"])
    return grid(head, rows)


def on_fit(results: dict) -> str:
    """Return the errors on the half that was fitted, as a check against fitting too much."""
    head = ["engine", *MEASURES]
    rows = [
        [engine["name"], *cells(engine["starts"]["calibrated"]["on_fit"])]
        for engine in results["engines"]
    ]
    return grid(head, rows)


def fits(results: dict, start: str = "calibrated") -> str:
    """Return what was fitted, engine by engine."""
    lines = []
    for engine in results["engines"]:
        found = engine["starts"][start]["fit"]
        numbers = ", ".join(f"{name} {value:.3g}" for name, value in found["values"].items())
        lines.append(f"{engine['name']} {engine['version']}, {found['setting']}: {numbers}")
    return bullets(lines)


def calibration(results: dict) -> str:
    found, noise = results["calibration"], results["noise"]
    return bullets(
        [
            f"lengths: a metre is recorded as {found['scale']:.4f} m "
            f"(g is {found['scale'] * GRAVITY:.3f} m/s²)",
            f"at rest the centre is at {1e3 * results['resting_height']:.1f} mm, "
            f"{results['resting_height'] / (EDGE / 2):.3f} of half an edge",
            f"velocities: those of {1e3 * found['delay']:.2f} ms before their row "
            f"({found['delay'] / ROW:.2f} of a row)",
            f"spin of the first row: {found['spin']:.3f} of that of the flight",
            f"what then is left between velocities of first rows and of flights: "
            f"{noise['velocity']:.4f} m/s and {noise['spin']:.3f} rad/s a component (68 %)",
        ]
    )


def noise(results: dict) -> str:
    """Return how far an engine is from itself when its starts are disturbed."""
    rows = []
    for engine in results["engines"]:
        pairs = [None if error is None else tuple(error) for error in engine["noise"]]
        rows.append([engine["name"], *cells(measures.summary(pairs).json())])
    return grid(["engine", *MEASURES], rows)


def pairs(results: dict) -> str:
    rows = [[" and ".join(pair["engines"]), *cells(pair)] for pair in results["pairs"]]
    return grid(["engines", *MEASURES], rows) if rows else "(one engine)"


def notes(results: dict) -> list[str]:
    """Return what ran, what did not, and the first failure of each engine in words."""
    lines = [
        f"{results['tosses']['fitted']} tosses fitted, {results['tosses']['reported']} others "
        f"reported; {results['budget']} evaluations a fit, seed {results['seed']}"
    ]
    lines += results["absent"]
    for engine in results["engines"]:
        for start in STARTS:
            texts = [e for e in engine["starts"][start]["errors"] if isinstance(e, str)]
            if texts:
                lines.append(f"{engine['name']}, {start}: {len(texts)} failed, first: {texts[0]}")
    return lines


def parts(results: dict) -> dict[str, str]:
    """Return the pieces of the page by the names that its template has for them."""
    return {
        "notes": bullets(notes(results)),
        "calibration": calibration(results),
        **{start: errors(results, start) for start in STARTS},
        "on_fit": on_fit(results),
        "fits": fits(results),
        "fits_recorded": fits(results, "recorded"),
        "noise": noise(results),
        "pairs": pairs(results),
    }


def markdown(results: dict) -> str:
    """Return all tables, with a line above each."""
    said = {
        "notes": "Errors: positions in widths of the cube, angles in degrees.",
        "calibration": "From free flight:",
        "recorded": "Starts as recorded:",
        "calibrated": "Starts calibrated:",
        "flight": "Starts from the whole flight:",
        "on_fit": "Calibrated, on the half that was fitted:",
        "fits": "Fitted to calibrated starts:",
        "fits_recorded": "Fitted to starts as recorded:",
        "noise": "Between an engine and itself with disturbed starts:",
        "pairs": "Between engines:",
    }
    made = parts(results)
    return "\n\n".join(f"{line}\n\n{made[name]}" for name, line in said.items())


def write_page(results: dict, file: Path) -> None:
    """Write the page and its picture beside it."""
    picture.draw(results, file.with_suffix(".png"))
    text = TEMPLATE.read_text(encoding="utf-8")
    for name, part in parts(results).items():
        text = text.replace("{" + name + "}", part)
    file.write_text(text, encoding="utf-8")
