"""From URDF to a model, with warnings of elements that are not used."""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from saltus._core import (
    ContactProperties,
    InertiaUse,
    JointEffects,
    JointType,
    MeshUse,
    Model,
    ModelBuilder,
    ModelError,
    TreeSolver,
    read_urdf,
)

PACKAGE = str(Path(__file__).parent) + os.sep


class ModelWarning(UserWarning):
    """An element of a model's file is not used, or a property that matters is missing."""


def issue_warnings(texts: Sequence[str]) -> None:
    """Issue a model's warnings as `ModelWarning`, as if from the line that asked this package."""
    level, frame = 1, sys._getframe()
    while frame.f_back is not None and frame.f_code.co_filename.startswith(PACKAGE):
        level, frame = level + 1, frame.f_back
    for text in texts:
        warnings.warn(text, ModelWarning, stacklevel=level)


def build_quietly(builder: ModelBuilder) -> Model:
    """Build without the warnings that were issued when the model was made before."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelWarning)
        return builder.build()


def load_urdf(
    path_or_text: str | os.PathLike[str],
    *,
    gravity: ArrayLike = (0.0, 0.0, -9.81),
    package_dirs: Sequence[str | os.PathLike[str]] = (),
    root_joint: JointType | str = JointType.fixed,
    solver: TreeSolver | str = TreeSolver.automatic,
    meshes: MeshUse | str = MeshUse.hull,
    srdf: str | os.PathLike[str] | None = None,
    contact: ContactProperties | None = None,
    floor: bool = False,
    effects: JointEffects | str = JointEffects.all,
    visuals: bool = True,
    inertia: InertiaUse | str = InertiaUse.checked,
    strict: bool = False,
) -> Model:
    """Read a model from a URDF file or text.

    Parameters
    ----------
    path_or_text : str or os.PathLike
        A file, or URDF text where it begins with "<".
    gravity : array_like, shape (3,)
        [m/s^2]
    package_dirs : sequence of str or os.PathLike
        Where `package://name/rest` is looked up: folders that hold `name`, or `name` itself.
    root_joint : JointType or str
        How the root link is connected to the world: fixed, or by a joint named "root" to a link
        named "world".
    solver : TreeSolver or str
        The linear solver of the steps. It changes the speed, and results by rounding only. Rarely
        needed; `TreeSolver` says when, `Model.solvers` has the solvers in use.
    meshes : MeshUse or str
        Collision meshes are replaced by their convex hulls, or not used. The file's own setting for
        a link, `<mesh link="..." use="..."/>`, takes precedence.
    srdf : str or os.PathLike, optional
        SRDF, a file or text: which links never collide, and states by name, `Model.state`.
        Half-spaces stay watched.
    contact : ContactProperties, optional
        The default contact, in place of the file's own: restitution and friction of all pairs that
        nothing else sets.
    floor : bool
        True: adds a floor, the half-space z <= 0, unless the file has it.
    effects : JointEffects or str
        What of the joints acts: limits as stops, damping, dry friction, motors. "none": joints move
        freely, and the numbers of the file are information.
    visuals : bool
        True: reads what links look like, `Model.visuals`, for pictures; meshes take time.
    inertia : InertiaUse or str
        `checked`: from the file, which must be possible, moments to 2 %; `as_given`: from the file,
        whatever moments are; `from_shapes`: so, too, and links without a mass are filled with
        water.
    strict : bool
        True: refuses what is wrong in the file and else read with a warning, as other readers do:
        limits that are missing or crossed, `<mimic>` of what is fixed or not there, sizes of 0,
        inertias that no body has, bytes that are no UTF-8.

    Returns
    -------
    Model
        Its `warnings` are also issued as `ModelWarning`.

    Raises
    ------
    ModelError
        With file and line, `element` and `name` of the culprit.

    See Also
    --------
    read_urdf : gives a `ModelBuilder`, to add to the model before it is built.
    """
    if np.shape(gravity) != (3,):
        raise ModelError(f"gravity = {gravity!r}; it has three components [m/s^2]")
    builder = read_urdf(
        path_or_text,
        gravity=gravity,
        package_dirs=package_dirs,
        root_joint=root_joint,
        solver=solver,
        meshes=meshes,
        srdf=srdf,
        contact=contact,
        floor=floor,
        effects=effects,
        visuals=visuals,
        inertia=inertia,
        strict=strict,
    )
    return builder.build()
