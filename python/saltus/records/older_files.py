"""What files of versions 1 and 2 had otherwise."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from saltus._core import (
    ContactProperties,
    InertiaUse,
    JointEffects,
    JointType,
    MeshUse,
    Model,
    ModelError,
    TreeSolver,
    read_urdf,
)
from saltus.records.stored import Stored
from saltus.urdf import build_quietly


def read_text_model(file: Stored) -> Model:
    """Make the model anew of its text; its visuals are read as `load_urdf` does."""
    builder = read_urdf(
        file.text("urdf"),
        gravity=np.asarray(file.file.attrs["gravity"]),
        root_joint=file.member("root_joint", JointType),
        solver=file.member("solver", TreeSolver, TreeSolver.automatic),
        meshes=file.member("meshes", MeshUse, MeshUse.none),
        contact=_contact(file),
        floor=bool(file.number("floor", False)),
        inertia=file.member("inertia", InertiaUse, InertiaUse.checked),
        effects=JointEffects(int(file.number("effects", 0))),  # older files: none acted
    )
    return build_quietly(builder)


def _contact(file: Stored) -> ContactProperties | None:
    if "friction" not in file.file.attrs:
        return None
    return ContactProperties(
        restitution=file.number("restitution"), friction=file.number("friction")
    )


def refuse_angles(coordinates: tuple[str, ...], version: int, path: Path) -> None:
    """Raise ModelError where free or ball joints are stored as yaw, pitch and roll."""
    for name in coordinates if version < 2 else ():
        joint = name.removesuffix("_pitch")
        if name != joint and {f"{joint}_yaw", f"{joint}_roll"} <= set(coordinates):
            raise ModelError(
                f'{path} holds joint "{joint}" as yaw, pitch and roll (format version {version}); '
                "free and ball joints are quaternions now: run the simulation again"
            )
