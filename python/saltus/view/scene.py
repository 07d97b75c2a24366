"""A run as plain data for the page: poses over time, impacts, forces, gaps, energies."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np

from saltus._core import Model, ModelError, Pose, State, __version__, gap, has_gap
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
    parts = Parts(model)
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
        **_impacts(run, instants),
        "forces": _forces(run, instants),
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


def _impacts(run: Recording, instants: Instants) -> dict[str, Any]:
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
            "point": packed(own["point"]),
            "normal": packed(own["normal"]),
            "vector": packed(vector),
        },
    }


def _forces(run: Recording, instants: Instants) -> dict[str, Any] | None:
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
        "point": packed(own["point"]),
        "vector": packed(force),
    }


def _gaps(
    run: Recording, model: Model, instants: Instants, names: Sequence[str] | None
) -> dict[str, Any]:
    placed = model.shapes
    chosen = _named(model, names) if names is not None else _most_used(run, model)
    if names is None:
        chosen = chosen[: max(1, min(MOST_GAPS, MOST_VALUES // len(instants.t)))]
    shapes = sorted({shape for pair in chosen for shape in pair})
    poses = {shape: _poses_of(model, instants.q, shape) for shape in shapes}
    values = np.empty((len(instants.t), len(chosen)))
    for column, (a, b) in enumerate(chosen):
        one, other = placed[a].shape, placed[b].shape
        for row in range(len(values)):
            values[row, column] = gap(one, poses[a][row], other, poses[b][row]).phi
    return {"pairs": [pair_name(model, pair) for pair in chosen], "phi": packed(values)}


def _poses_of(model: Model, q: Array, shape: int) -> list[Pose]:
    return [Pose(X[:3, 3], X[:3, :3]) for X in model.shape_poses(q, shape)]


def pair_name(model: Model, pair: tuple[int, int]) -> str:
    """Return the name of a pair of shapes, which are numbers in `model.shapes`."""
    return " ~ ".join(model.shapes[i].name for i in pair)


def _named(model: Model, names: Sequence[str]) -> list[tuple[int, int]]:
    index = {placed.name: i for i, placed in enumerate(model.shapes)}
    found = []
    for name in names:
        a, _, b = name.partition(" ~ ")
        if a not in index or b not in index or a == b:
            raise ModelError(
                f'no pair "{name}"; it is named "a ~ b" after two of the shapes '
                f"{', '.join(index) or '(there are none)'}"
            )
        if not has_gap(model.shapes[index[a]].shape, model.shapes[index[b]].shape):
            raise ModelError(f'pair "{name}": no gap function is known for these two shapes')
        found.append((index[a], index[b]))
    return found


def _most_used(run: Recording, model: Model) -> list[tuple[int, int]]:
    """Return pairs of shapes: those that met, the most frequent first, then the others."""
    numbers = Counter(run.impulses["pair"].tolist())
    if run.recorded_contacts is not None:
        numbers.update(run.recorded_contacts["pair"].tolist())
    index = {placed.name: i for i, placed in enumerate(model.shapes)}
    pairs: dict[tuple[int, int], None] = {}
    for number, _ in numbers.most_common():
        ends = [end.split("[")[0] for end in run.pair_names[number].split(" ~ ")]
        if len(ends) == 2 and ends[0] in index and ends[1] in index:
            pairs[index[ends[0]], index[ends[1]]] = None
    if model.n_pairs <= 20 * MOST_GAPS:
        pairs.update(dict.fromkeys((pair.a, pair.b) for pair in model.pairs))
    shapes = [placed.shape for placed in model.shapes]
    return [(a, b) for a, b in pairs if has_gap(shapes[a], shapes[b])]
