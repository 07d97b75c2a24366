"""Trajectories in HDF5 files that are complete in themselves."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from saltus._core import (
    ImpactLaw,
    ImpactOrder,
    ImpactProblem,
    Model,
    ModelError,
    StepOptions,
    __version__,
)
from saltus.records.described import (
    DOCUMENT,
    GROUP,
    difference,
    read_description,
    read_model,
    write_model,
)
from saltus.records.older_files import read_text_model, refuse_angles
from saltus.records.recording import Recording
from saltus.records.replace import replacing
from saltus.records.stored import Stored
from saltus.records.tables import (
    ARRAYS,
    CONTACT,
    FALLBACK,
    IMPACT,
    IMPULSE,
    LISTED_PAIRS,
    NUMBERS,
    SETTLING,
    SOURCES,
)

if TYPE_CHECKING:
    import h5py

FORMAT = "saltus trajectory"
VERSION = 3
"""Before 3 the model was URDF text and options of `load_urdf`, or not there. In 1 free and ball
joints were yaw, pitch, roll, and velocities had no names."""
MOST = ("max_iterations", "max_impacts", "max_halvings", "max_impulses")
BOUNDS = (*MOST, "rest", "simultaneous", "strict")
NAMES = ("coordinate_names", "velocity_names", "pair_names", "certificates", "control_names")
OPTIONS = ("h", "collisions", *BOUNDS)

Kind = TypeVar("Kind", bound=Recording)


def save(run: Recording, path: str | os.PathLike[str], *, visuals: bool = True) -> None:
    """Write a trajectory; see `Trajectory.save`."""
    import h5py

    with replacing(path) as part, h5py.File(part, "w") as file:
        _write(run, file, visuals)


def read(kind: type[Kind], path: str | os.PathLike[str], model: Model | None) -> Kind:
    """Read a trajectory, as a recording of this kind; see `saltus.load`."""
    import h5py

    path = Path(path)
    if not path.exists():
        raise ModelError(f"{path}: there is no such file")
    try:
        with h5py.File(path, "r") as file:
            return _read(kind, Stored(file, path), model)
    except ModelError:
        raise
    except (OSError, LookupError, TypeError, ValueError, RuntimeError, MemoryError) as error:
        # What HDF5 itself does not like, and what none of the checks foresaw.
        raise ModelError(f"{path} is no trajectory that saltus can read: {error}") from None


def _write(run: Recording, file: h5py.File, visuals: bool) -> None:
    import h5py

    text = h5py.string_dtype()
    file.attrs.update(format=FORMAT, version=VERSION, saltus_version=__version__)
    for name in OPTIONS:
        file.attrs[name] = getattr(run.options, name)
    file.attrs["law"] = ImpactLaw(run.options.law).name
    file.attrs["order"] = run.options.order.name
    file.attrs["certify"] = run.options.certify
    for name in NUMBERS:
        file.attrs[name] = getattr(run, name)
    for name in ARRAYS:
        file[name] = getattr(run, name)
    file["impulses"] = run.impulses
    file["settlings"] = run.settlings
    file["fallbacks"] = run.fallbacks.astype(
        [(name, "S16" if name == "rung" else FALLBACK[name]) for name in FALLBACK.names or ()]
    )
    if run.recorded_contacts is not None:
        file["contacts"] = run.recorded_contacts
    for name in ("control", "work"):
        rows = getattr(run, f"recorded_{name}")
        if rows is not None:
            file[name] = rows
    # The law by name, so that other programs can read it.
    law = h5py.enum_dtype({law.name: law.value for law in ImpactLaw}, basetype="u1")
    fields = [(name, law if name == "law" else IMPACT[name]) for name in IMPACT.names or ()]
    file["impacts"] = run.impacts.astype(np.dtype(fields))
    for name in NAMES:
        file.create_dataset(name, data=list(getattr(run, name)), dtype=text)
    if run.model is None:
        file.attrs["model"] = "not in this file: the run was loaded from a file without it"
        return
    try:
        write_model(file, run.model, visuals=visuals)
    except ModelError as error:  # a model of what no file can hold, as functions
        file.attrs["model"] = f"not in this file: {error}"
        return
    file.attrs["model"] = f"JSON in {DOCUMENT}"


def _read(kind: type[Kind], file: Stored, model: Model | None) -> Kind:
    if file.attribute("format", "") != FORMAT:
        raise ModelError(f"{file.path} holds no trajectory of saltus")
    version = file.number("version")
    if version > VERSION:
        raise ModelError(
            f"{file.path} has format version {version}; this saltus {__version__} reads up to "
            f"{VERSION}"
        )
    coordinates = file.names("coordinate_names")
    refuse_angles(coordinates, version, file.path)
    velocities = coordinates  # of files of version 1
    if "velocity_names" in file:
        velocities = file.names("velocity_names")
    pairs = file.names("pair_names")
    certificates = file.names("certificates") if "certificates" in file else ()
    arrays = _arrays(file, len(coordinates), len(velocities), len(pairs))
    if certificates and len(certificates) != len(arrays["impacts"]):
        file.fail('dataset "certificates"', "has not as many entries as there are impacts")
    model = _model(file, model, coordinates, pairs)
    arrays["control_names"] = file.names("control_names") if "control_names" in file else ()
    columns = len(arrays["control_names"])
    for name, width in (("control", columns), ("work", columns + len(SOURCES))):
        if name in file:
            arrays[f"recorded_{name}"] = file.array(name, (len(arrays["t"]), width))
    return kind(
        model=model,
        options=_step_options(file),
        coordinate_names=coordinates,
        velocity_names=velocities,
        pair_names=pairs,
        certificates=certificates,
        **arrays,
        **{name: file.number(name) for name in NUMBERS},
    )


def _arrays(file: Stored, n_q: int, n_v: int, pairs: int) -> dict[str, Any]:
    """Read all arrays and tables, and make them read-only."""
    rows = len(file.array("t", (None,)))
    if rows == 0:
        file.fail('dataset "t"', "has no rows")
    columns: dict[str, int] = {"q": n_q, "v": n_v, "p": n_v}
    arrays: dict[str, Any] = {
        name: file.array(name, (rows, columns[name]) if name in columns else (rows,))
        for name in ARRAYS
    }
    for name in ("t", *columns):
        file.check_finite(name, arrays[name])
    back = np.diff(arrays["t"]) < 0
    if back.any():
        file.fail('dataset "t"', f"goes back in time after row {int(np.argmax(back))}")
    impacts = arrays["impacts"] = file.table("impacts", IMPACT, {})
    nowhere = {"tangential": 0.0, "point": np.nan, "normal": np.nan}  # of older files
    impulses = arrays["impulses"] = file.table("impulses", IMPULSE, nowhere)
    unknown = {"energy": 0.0, "pair": -1}
    arrays["settlings"] = file.table("settlings", SETTLING, {}, optional=True)
    arrays["fallbacks"] = file.table("fallbacks", FALLBACK, unknown, optional=True)
    if "contacts" in file:
        arrays["recorded_contacts"] = file.table("contacts", CONTACT, {})
    for name in ("impulses", "settlings", "fallbacks", "recorded_contacts"):
        if name in arrays:
            least = -1 if name in ("settlings", "fallbacks") else 0
            stored = name.removeprefix("recorded_")
            file.check_indices(stored, "pair", arrays[name]["pair"], least, pairs)
    check = file.check_indices
    check("impulses", "impact", impulses["impact"], 0, len(impacts))
    check("impacts", "law", impacts["law"].astype(int), 0, len(ImpactLaw))
    check("impacts", "first", impacts["first"], 0, len(impulses) + 1)
    check("impacts", "count", impacts["count"], 0, len(impulses) + 1)
    check("impacts", "first + count", impacts["first"] + impacts["count"], 0, len(impulses) + 1)
    if "recorded_contacts" in arrays:
        check("contacts", "impact", arrays["recorded_contacts"]["impact"], -1, len(impacts))
    for array in arrays.values():
        array.flags.writeable = False
    return arrays


def _model(
    file: Stored, given: Model | None, coordinates: tuple[str, ...], pairs: tuple[str, ...]
) -> Model | None:
    """Return the model of a run: as the file has it, or as it is given, which must fit."""
    if given is not None:
        check_model(given, coordinates, pairs, file.path)
    if GROUP in file:
        description = read_description(file)
        if given is None:
            return None if _has_functions(description) else read_model(file, description)
        found = difference(description, given._description())
        if found:
            raise ModelError(f"the model is not that of the run in {file.path}: {found}")
        return given
    if given is not None or "urdf" not in file or file.number("version") >= VERSION:
        return given
    model = read_text_model(file)
    if set(pairs) <= set(model.limit_names) and model.n_pairs <= LISTED_PAIRS:
        model = model.without_collisions()
    check_model(model, coordinates, pairs, file.path)
    return model


def _has_functions(description: dict[str, Any]) -> bool:
    """Return whether a part of the model was a function, which a file cannot hold."""
    for name, key in (("forces", "name"), ("potentials", "name"), ("prescribed", "function")):
        parts = description.get(name)  # of a broken file anything
        if isinstance(parts, list) and any(isinstance(p, dict) and p.get(key) for p in parts):
            return True
    return False


def _step_options(file: Stored) -> StepOptions:
    older = {"max_halvings": 0, "strict": True}  # files of before have no such steps
    given = {name for name in OPTIONS if name in file.file.attrs} | set(older)
    numbers = {name: file.number(name, older.get(name)) for name in OPTIONS if name in given}
    if not numbers.get("h", 1.0) > 0:
        file.fail('attribute "h"', f"is {numbers['h']}; a step is above 0")
    law = file.member("law", ImpactLaw)
    return StepOptions(
        law=_lost_law if law is ImpactLaw.custom else law,
        order=file.member("order", ImpactOrder, ImpactOrder.fastest),
        certify=bool(file.number("certify", False)),
        **numbers,
    )


def _lost_law(_: ImpactProblem) -> np.typing.NDArray[np.float64]:
    raise ModelError("the law of this run was a function, which its file does not hold")


def check_model(
    model: Model, coordinates: tuple[str, ...], pairs: tuple[str, ...], path: Path
) -> None:
    """Raise ModelError where a model cannot be that of the run."""
    few = model.n_pairs <= LISTED_PAIRS  # else the run names those that collided
    for what, own, others in (
        ("coordinates", coordinates, model.coordinate_names),
        ("pairs", pairs, [*model.pair_names, *model.limit_names] if few else list(pairs)),
    ):
        if list(own) != others:
            raise ModelError(
                f"the run in {path} has the {what} {', '.join(own) or 'none'}; the model has "
                f"{', '.join(others) or 'none'}"
            )
