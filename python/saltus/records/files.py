"""Trajectories in HDF5 files that are complete in themselves."""

from __future__ import annotations

import os
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypedDict, TypeVar

import numpy as np

from saltus._core import (
    ContactProperties,
    Convex,
    HalfSpace,
    ImpactLaw,
    ImpactOrder,
    ImpactProblem,
    JointEffects,
    JointType,
    MeshUse,
    Model,
    ModelError,
    StepOptions,
    TreeSolver,
    __version__,
    read_urdf,
)
from saltus.records.recording import Recording
from saltus.records.tables import (
    ARRAYS,
    CONTACT,
    FALLBACK,
    IMPACT,
    IMPULSE,
    LISTED_PAIRS,
    NUMBERS,
    SETTLING,
    fallbacks_of_file,
)
from saltus.urdf import build_quietly

if TYPE_CHECKING:
    import h5py

FORMAT = "saltus trajectory"
VERSION = 2  # 1: free and ball joints were yaw, pitch, roll, and velocities had no names
MOST = ("max_iterations", "max_impacts", "max_halvings", "max_impulses")
BOUNDS = (*MOST, "rest", "simultaneous", "strict")
NAMES = ("coordinate_names", "velocity_names", "pair_names", "certificates", "control_names")
OPTIONS = ("h", "collisions", *BOUNDS)

Kind = TypeVar("Kind", bound=Recording)


class UrdfOptions(TypedDict):
    """The options of `load_urdf` that change what a model consists of."""

    root_joint: JointType
    solver: TreeSolver
    meshes: MeshUse
    contact: ContactProperties | None
    floor: bool
    effects: JointEffects


def save(run: Recording, path: str | os.PathLike[str]) -> None:
    """Write a trajectory; see `Trajectory.save`."""
    import h5py

    check_folder(path)
    path = Path(path)
    # Under another name first: a failure leaves no half file, and an older one stays whole.
    part = path.with_name(path.name + ".part")
    try:
        with h5py.File(part, "w") as file:
            _write(run, file)
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)


def read(kind: type[Kind], path: str | os.PathLike[str], model: Model | None) -> Kind:
    """Read a trajectory, as a recording of this kind; see `saltus.load`."""
    import h5py

    path = Path(path)
    if not path.exists():
        raise ModelError(f"{path}: there is no such file")
    try:
        with h5py.File(path, "r") as file:
            return _read(kind, file, path, model)
    except (OSError, KeyError) as error:
        raise ModelError(f"{path} is no trajectory that saltus can read: {error}") from None


def check_folder(path: str | os.PathLike[str]) -> None:
    """Raise ModelError where no file can be written."""
    path = Path(path)
    if path.is_dir():
        raise ModelError(f"{path} is a folder; a file is to be written")
    if not path.absolute().parent.is_dir():
        raise ModelError(f"{path}: there is no folder {path.parent}")


def _write(run: Recording, file: h5py.File) -> None:
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
    options = None if run.model is None else _urdf_options(run.model)
    if run.model is None or options is None:
        file.attrs["model"] = "not in this file: it was built in code"
        return
    file.attrs["model"] = "URDF text in urdf"
    file.attrs["gravity"] = run.model.gravity
    file.attrs["root_joint"] = options["root_joint"].name
    file.attrs["solver"] = options["solver"].name
    file.attrs["meshes"] = options["meshes"].name
    file.attrs["floor"] = options["floor"]
    file.attrs["effects"] = options["effects"].value
    if options["contact"] is not None:
        file.attrs["restitution"] = options["contact"].restitution
        file.attrs["friction"] = options["contact"].friction
    file.create_dataset("urdf", data=run.model.source, dtype=text)


def _read(kind: type[Kind], file: h5py.File, path: Path, model: Model | None) -> Kind:
    if file.attrs.get("format") != FORMAT:
        raise ModelError(f"{path} holds no trajectory of saltus")
    if file.attrs["version"] > VERSION:
        raise ModelError(
            f"{path} has format version {file.attrs['version']}; this saltus {__version__} reads "
            f"up to {VERSION}"
        )
    arrays: dict[str, Any] = {name: file[name][()] for name in ARRAYS}
    arrays["impulses"] = _impulses(file["impulses"][()])
    arrays["impacts"] = file["impacts"][()].astype(IMPACT)
    settlings = file["settlings"][()] if "settlings" in file else []  # older files have none
    arrays["settlings"] = np.asarray(settlings, SETTLING)
    arrays["fallbacks"] = fallbacks_of_file(file.get("fallbacks"))
    if "contacts" in file:
        arrays["recorded_contacts"] = file["contacts"][()].astype(CONTACT)
    for name in ("control", "work"):
        if name in file:
            arrays[f"recorded_{name}"] = file[name][()]
    for array in arrays.values():
        array.flags.writeable = False
    numbers: dict[str, Any] = {name: file.attrs[name].item() for name in NUMBERS}
    certificates = tuple(file["certificates"].asstr()[()]) if "certificates" in file else ()
    options = {name: file.attrs[name].item() for name in OPTIONS if name in file.attrs}
    options.setdefault("max_halvings", 0)  # files of before have no such steps
    options.setdefault("strict", True)
    coordinates = tuple(file["coordinate_names"].asstr()[()])
    _refuse_angles(coordinates, file.attrs["version"], path)
    velocities = coordinates  # of files of version 1
    if "velocity_names" in file:
        velocities = tuple(file["velocity_names"].asstr()[()])
    pairs = tuple(file["pair_names"].asstr()[()])
    if model is None and "urdf" in file:
        builder = read_urdf(
            file["urdf"].asstr()[()],
            gravity=file.attrs["gravity"],
            root_joint=JointType[file.attrs["root_joint"]],
            solver=TreeSolver[file.attrs.get("solver", "automatic")],
            meshes=MeshUse[file.attrs.get("meshes", "none")],
            contact=_contact(file),
            floor=bool(file.attrs.get("floor", False)),
            effects=JointEffects(int(file.attrs.get("effects", 0))),  # older files: none acted
        )
        model = build_quietly(builder)
        if set(pairs) <= set(model.limit_names) and model.n_pairs <= LISTED_PAIRS:
            model = model.without_collisions()
    if model is not None:
        _check_model(model, coordinates, pairs, path)
    if "control_names" in file:
        arrays["control_names"] = tuple(file["control_names"].asstr()[()])
    return kind(
        model=model,
        options=_step_options(file, options),
        coordinate_names=coordinates,
        velocity_names=velocities,
        pair_names=pairs,
        certificates=certificates,
        **arrays,
        **numbers,
    )


def _contact(file: h5py.File) -> ContactProperties | None:
    if "friction" not in file.attrs:
        return None
    return ContactProperties(
        restitution=file.attrs["restitution"].item(), friction=file.attrs["friction"].item()
    )


def _refuse_angles(coordinates: tuple[str, ...], version: int, path: Path) -> None:
    """Raise ModelError where free or ball joints are stored as yaw, pitch and roll."""
    for name in coordinates if version < 2 else ():
        joint = name.removesuffix("_pitch")
        if name != joint and {f"{joint}_yaw", f"{joint}_roll"} <= set(coordinates):
            raise ModelError(
                f'{path} holds joint "{joint}" as yaw, pitch and roll (format version {version}); '
                "free and ball joints are quaternions now: run the simulation again"
            )


def _impulses(stored: np.typing.NDArray[np.void]) -> np.typing.NDArray[np.void]:
    impulses = np.zeros(len(stored), IMPULSE)  # older files say nothing of friction
    impulses["point"] = impulses["normal"] = np.nan  # nor where impulses act
    for name in stored.dtype.names or ():
        impulses[name] = stored[name]
    return impulses


def _step_options(file: h5py.File, numbers: dict[str, Any]) -> StepOptions:
    law = ImpactLaw[file.attrs["law"]]
    order = ImpactOrder[file.attrs.get("order", "fastest")]
    chosen = _lost_law if law is ImpactLaw.custom else law
    certify = bool(file.attrs.get("certify", False))
    return StepOptions(law=chosen, order=order, certify=certify, **numbers)


def _lost_law(_: ImpactProblem) -> np.typing.NDArray[np.float64]:
    raise ModelError("the law of this run was a function, which its file does not hold")


def _check_model(
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


def _urdf_options(model: Model) -> UrdfOptions | None:
    """Return the options with which `load_urdf` makes this model of its text.

    None where there is no text, or where the model was changed after it was read, or needs other
    files (meshes, SRDF): links, joints, shapes, pairs or contacts then differ. A solver that makes
    the same of its trees gives the same bits.
    """
    if not model.source:
        return None
    # The joint that load_urdf added, if it did, is the only one below the model's root.
    types = {joint.type for joint in model.joints if joint.parent == model.links[0].name}
    wanted = _parts(model)
    floors = {False, any(isinstance(s.shape, HalfSpace) for s in model.shapes)}
    acting = (JointEffects.all, JointEffects.none)
    for floor, meshes, root_joint, solver, effects in product(
        floors, (MeshUse.none, MeshUse.hull), (JointType.fixed, *types), TreeSolver, acting
    ):
        options: UrdfOptions = {
            "root_joint": root_joint,
            "solver": solver,
            "meshes": meshes,
            "contact": model.default_contact,
            "floor": floor,
            "effects": effects,
        }
        try:
            again = build_quietly(read_urdf(model.source, **options))
        except ModelError:
            continue
        if _parts(again if model.n_pairs else again.without_collisions()) == wanted:
            return options
    return None


def _parts(model: Model) -> tuple[object, ...]:
    # A mesh that is in no pair has no part in the motion, and its file may be gone.
    shapes = [s.name for s in model.shapes if not isinstance(s.shape, Convex)]
    # A half-space that was added may have the name of load_urdf's floor and be elsewhere.
    planes = [i for i, s in enumerate(model.shapes) if isinstance(s.shape, HalfSpace)]
    poses = [model.shape_poses(model.neutral()[np.newaxis], i).tolist() for i in planes]
    names = model.link_names, model.joint_names, model.coordinate_names, shapes, poses
    pairs: list[object] = [model.n_pairs, repr(model.default_contact)]
    if model.n_pairs <= LISTED_PAIRS:
        pairs = [(n, repr(model.contact_properties(i))) for i, n in enumerate(model.pair_names)]
    names = (*names, model.limit_names, model.control_names, model.damping.tolist())
    return *names, pairs, [repr(trees) for trees in model.solvers]
