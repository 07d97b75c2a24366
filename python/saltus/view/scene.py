"""A run as plain data for the page: poses over time, impacts, forces, gaps, energies."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from saltus._core import Model, State, __version__
from saltus.records.pairs import gaps_over, named_pairs, pair_name, pairs_of_run
from saltus.records.recording import Recording
from saltus.records.tables import Array, counted
from saltus.view.arrays import packed
from saltus.view.instants import Instants, instants_of
from saltus.view.parts import Parts, shapeless

MOST_GAPS = 24  # pairs whose gaps the page can plot
MOST_VALUES = 60_000  # of gaps in all


def scene_of_run(run: Recording, *, pairs: Sequence[str] | None = None) -> dict[str, Any]:
    """Return what the page shows of a run.

    Parameters
    ----------
    run : Recording
    pairs : sequence of str, optional
        Names "a ~ b" of two shapes whose gap is to be plotted. None: those that met first, then
        others, as long as they are few.

    Returns
    -------
    dict
        For `json.dumps`.

    Raises
    ------
    ModelError
        Where the run has no model, or on names of pairs that do not exist.
    """
    model = run.require_model()
    parts = Parts(model, run.q[0])
    instants = instants_of(run)
    return {
        "version": __version__,
        "mode": "run",
        "title": model.name,
        "summary": run.summary(),
        "notices": _notices(run, model, instants),
        "gravity": model.gravity.tolist(),
        "h": run.options.h,
        **parts.described(),
        "t": packed(instants.t, "f8"),
        "poses": packed(parts.poses(instants.q)),
        "kinetic": packed(instants.kinetic, "f8"),
        "potential": packed(instants.potential, "f8"),
        **_impacts(run, instants, parts.origin),
        "forces": _forces(run, instants, parts.origin),
        "gaps": _gaps(run, model, instants, pairs),
    }


def scene_of_model(model: Model, parts: Parts, state: State, h: float) -> dict[str, Any]:
    """Return what a live page shows at its start: a model in a state, and nothing that happened.

    Parameters
    ----------
    model : Model
    parts : Parts
        Of the model.
    state : State
    h : float
        [s] the time step, which is told.

    Returns
    -------
    dict
        For `json.dumps`.
    """
    q = np.asarray(state.q)[np.newaxis]
    none = packed(np.zeros(0), "f8")
    whole = packed(np.zeros(0), "i4")
    return {
        "version": __version__,
        "mode": "live",
        "title": model.name,
        "summary": f"live, h = {h:.3g} s; closing the page ends it",
        "notices": [text for text in [shapeless(model)] if text],
        "gravity": model.gravity.tolist(),
        "h": h,
        **parts.described(),
        "t": packed([state.t], "f8"),
        "poses": packed(parts.poses(q)),
        "kinetic": packed([model.kinetic_energy(state)], "f8"),
        "potential": packed([model.potential_energy(q[0])], "f8"),
        "impacts": {
            "t": none,
            "instant": whole,
            "kinetic_before": none,
            "first": packed([0], "i4"),
            "certificates": [],
        },
        "impulses": {
            "pairs": [],
            "pair": whole,
            "lambda": none,
            "point": none,
            "normal": none,
            "vector": none,
        },
        "forces": None,
        "gaps": {"pairs": [], "phi": none},
    }


def _notices(run: Recording, model: Model, instants: Instants) -> list[str]:
    """Return what a viewer must know to judge what is seen."""
    notices = []
    if not run.complete:
        notices.append(f"This run stopped before its end, at t = {run.t[-1]:g} s.")
    if len(run) == 1:
        notices.append("This run has one row: nothing moves.")
    if no_shapes := shapeless(model):
        notices.append(no_shapes)
    if instants.interpolated:
        many = counted(instants.interpolated, "impact")
        notices.append(f"At {many} the places of bodies are interpolated between recorded rows.")
    lossy = int(np.count_nonzero(run.fallbacks["rung"] != "halved"))
    if lossy:
        notices.append(f"{counted(lossy, 'arc')} were made by time stepping, which loses energy.")
    return notices


def _impacts(run: Recording, instants: Instants, origin: Array) -> dict[str, Any]:
    own = run.impulses
    numbers, pair = np.unique(own["pair"], return_inverse=True)
    vector = own["lambda"][:, None] * own["normal"] + own["tangential"]
    return {
        "impacts": {
            "t": packed(run.impacts["t"], "f8"),
            "instant": packed(instants.impact_at, "i4"),
            "kinetic_before": packed(instants.kinetic_before, "f8"),
            "first": packed([*run.impacts["first"], len(own)], "i4"),
            "certificates": list(run.certificates),
        },
        "impulses": {
            "pairs": [run.pair_names[i] for i in numbers],
            "pair": packed(pair, "i4"),
            "lambda": packed(own["lambda"]),
            "point": packed(own["point"] - origin),
            "normal": packed(own["normal"]),
            "vector": packed(vector),
        },
    }


def _forces(run: Recording, instants: Instants, origin: Array) -> dict[str, Any] | None:
    """Return mean forces of the contacts that were held, at the rows that are shown."""
    if run.recorded_contacts is None:
        return None
    held = run.recorded_contacts[run.recorded_contacts["impact"] < 0]
    rows = instants.recorded[instants.recorded >= 0]
    own = held[np.isin(held["row"], rows)]
    # Of a row that sums up several steps, the last: forces are those of one step.
    own = own[np.abs(own["t"] - run.t[own["row"]]) < 0.5 * run.options.h]
    first = np.searchsorted(own["row"], [*rows, len(run)])
    numbers, pair = np.unique(own["pair"], return_inverse=True)
    force = (own["lambda"][:, None] * own["normal"] + own["tangential"]) / run.options.h
    return {
        "t": packed(run.t[rows], "f8"),
        "first": packed(first, "i4"),
        "pairs": [run.pair_names[i] for i in numbers],
        "pair": packed(pair, "i4"),
        "point": packed(own["point"] - origin),
        "vector": packed(force),
    }


def _gaps(
    run: Recording, model: Model, instants: Instants, names: Sequence[str] | None
) -> dict[str, Any]:
    chosen = pairs_of_run(run, model) if names is None else named_pairs(model, names)
    if names is None:
        chosen = chosen[: max(1, min(MOST_GAPS, MOST_VALUES // len(instants.t)))]
    values = gaps_over(model, instants.q, chosen)
    return {"pairs": [pair_name(model, pair) for pair in chosen], "phi": packed(values)}
