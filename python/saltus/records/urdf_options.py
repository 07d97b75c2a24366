"""Which options of `load_urdf` make a model of its text, so that a file can make it again."""

from __future__ import annotations

import pickle
from itertools import product
from typing import TypedDict

import numpy as np

from saltus._core import (
    ContactProperties,
    Convex,
    HalfSpace,
    InertiaUse,
    JointEffects,
    JointType,
    MeshUse,
    Model,
    ModelError,
    TreeSolver,
    read_urdf,
)
from saltus.records.tables import LISTED_PAIRS
from saltus.urdf import build_quietly


class UrdfOptions(TypedDict):
    """The options of `load_urdf` that change what a model consists of."""

    root_joint: JointType
    solver: TreeSolver
    meshes: MeshUse
    contact: ContactProperties | None
    floor: bool
    inertia: InertiaUse
    effects: JointEffects


def urdf_options(model: Model) -> UrdfOptions | None:
    """Return the options with which `load_urdf` makes this model of its text.

    None where there is no text, or where the model was changed after it was read, or needs other
    files (meshes, SRDF): links, joints, shapes, pairs or contacts then differ. A solver that makes
    the same of its trees gives the same bits.
    """
    if not model.source:
        return None
    # The joint that load_urdf added, if it did, is the only one below the model's root.
    types = {joint.type for joint in model.joints if joint.parent == model.links[0].name}
    joints = model._moving_parts()[1]
    effects_of = {joint[-1] for joint in joints} or {JointEffects.all}
    wanted = _parts(model)
    floors = {False, any(isinstance(s.shape, HalfSpace) for s in model.shapes)}
    roots = (JointType.fixed, *types)
    for inertia, floor, meshes, root_joint, effects, solver in product(
        InertiaUse, floors, (MeshUse.none, MeshUse.hull), roots, effects_of, TreeSolver
    ):
        options: UrdfOptions = {
            "root_joint": root_joint,
            "solver": solver,
            "meshes": meshes,
            "contact": model.default_contact,
            "floor": floor,
            "inertia": inertia,
            "effects": effects,
        }
        try:
            again = build_quietly(read_urdf(model.source, visuals=False, **options))
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
    moving = pickle.dumps(model._moving_parts())
    pairs: list[object] = [model.n_pairs, repr(model.default_contact)]
    if model.n_pairs <= LISTED_PAIRS:
        pairs = [(n, repr(model.contact_properties(i))) for i, n in enumerate(model.pair_names)]
    return moving, shapes, poses, pairs, [repr(trees) for trees in model.solvers]
