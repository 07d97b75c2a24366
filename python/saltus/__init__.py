"""Tree-structured multibody models and a variational integrator that steps through impacts.

>>> import saltus
>>> model = saltus.load_urdf(saltus.urdf_dir() / "newtons_cradle_3.urdf")
>>> run = saltus.simulate(model, q={"swing_0": 0.3}, duration=1.0, h=0.01)
>>> print(f"{run.impacts['t'][0]:.4f} s")
0.5046 s

Units are SI. Arrays of coordinates are `(n,)`, trajectories `(rows, n)`. Everything that a user
can get wrong ends in `ModelError` (a ValueError), a step that cannot be made in `StepError` (a
RuntimeError) or its kind `JammedError`.
"""

from saltus import scenes
from saltus._core import (
    BodyInertia,
    Box,
    Capsule,
    Coordinate,
    Cylinder,
    Energies,
    Gap,
    Gaps,
    HalfSpace,
    Impact,
    ImpactLaw,
    ImpactOrder,
    ImpactOutcome,
    JammedError,
    JointInfo,
    JointType,
    LagrangianPartials,
    Link,
    Mimic,
    Model,
    ModelBuilder,
    ModelError,
    OnFailure,
    Pair,
    PlacedShape,
    Pose,
    Sphere,
    State,
    StepError,
    StepOptions,
    Stepper,
    StepReport,
    TreeSolution,
    TreeSolver,
    __version__,
    discrete_energy,
    energies,
    gap,
    gap_table,
    has_gap,
    nodal_energy,
    read_urdf,
    resolve_impact,
    rotation_from_rpy,
    shape_name,
    solid_sphere,
)
from saltus.batch import simulate_batch
from saltus.batch_trajectory import BatchTrajectory
from saltus.files import load
from saltus.paths import cmake_dir, urdf_dir
from saltus.rollout import simulate
from saltus.trajectory import Trajectory
from saltus.urdf import ModelWarning, load_urdf

__all__ = [
    "BatchTrajectory",
    "BodyInertia",
    "Box",
    "Capsule",
    "Coordinate",
    "Cylinder",
    "Energies",
    "Gap",
    "Gaps",
    "HalfSpace",
    "Impact",
    "ImpactLaw",
    "ImpactOrder",
    "ImpactOutcome",
    "JammedError",
    "JointInfo",
    "JointType",
    "LagrangianPartials",
    "Link",
    "Mimic",
    "Model",
    "ModelBuilder",
    "ModelError",
    "ModelWarning",
    "OnFailure",
    "Pair",
    "PlacedShape",
    "Pose",
    "Sphere",
    "State",
    "StepError",
    "StepOptions",
    "StepReport",
    "Stepper",
    "Trajectory",
    "TreeSolution",
    "TreeSolver",
    "__version__",
    "cmake_dir",
    "discrete_energy",
    "energies",
    "gap",
    "gap_table",
    "has_gap",
    "load",
    "load_urdf",
    "nodal_energy",
    "read_urdf",
    "resolve_impact",
    "rotation_from_rpy",
    "scenes",
    "shape_name",
    "simulate",
    "simulate_batch",
    "solid_sphere",
    "urdf_dir",
]
