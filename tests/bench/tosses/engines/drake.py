"""Drake: the discrete step of a MultibodyPlant, by each of its contact approximations."""

from __future__ import annotations

import importlib.metadata

import numpy as np
from pydrake.geometry import (
    AddCompliantHydroelasticProperties,
    AddContactMaterial,
    AddRigidHydroelasticProperties,
    Box,
    HalfSpace,
    ProximityProperties,
)
from pydrake.math import RigidTransform, RotationMatrix
from pydrake.multibody.math import SpatialVelocity
from pydrake.multibody.plant import (
    AddMultibodyPlant,
    CoulombFriction,
    MultibodyPlantConfig,
)
from pydrake.multibody.tree import SpatialInertia, UnitInertia
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder

from tests.bench.tosses.data import EDGE, GRAVITY, MASS, ROW
from tests.bench.tosses.flight import Start
from tests.bench.tosses.parameters import CUBE, FRICTION, TABLE, Parameter, frame, table

NAME, VERSION = "Drake", importlib.metadata.version("drake")
STEPS = 4  # a row
SETTINGS = (
    "point contact, lagged",
    "point contact, similar",
    "point contact, sap",
    "point contact, tamsi",
    "hydroelastic contact, lagged",
)
PARAMETERS = (
    FRICTION,
    Parameter("stiffness", "N/m", 1e4, 5e2, 1e6, logarithmic=True),  # hydroelastic: 1e3 / m Pa
    Parameter("dissipation", "s/m", 1.0, 0.01, 50.0, logarithmic=True),
    Parameter("relaxation", "s", 0.01, 0.001, 0.3, logarithmic=True),  # sap's dissipation
    *CUBE,
    *TABLE,
)


def properties(values: dict[str, float], hydroelastic: bool) -> ProximityProperties:
    made = ProximityProperties()
    mu = values["friction"]
    AddContactMaterial(
        dissipation=values["dissipation"],
        point_stiffness=None if hydroelastic else values["stiffness"],
        friction=CoulombFriction(mu, mu),
        properties=made,
    )
    made.AddProperty("material", "relaxation_time", values["relaxation"])
    return made


def simulator(values: dict[str, float], setting: str) -> tuple:
    """Return a simulator, and the plant and its body in it."""
    kind, approximation = setting.split(" contact, ")
    hydroelastic = kind == "hydroelastic"
    builder = DiagramBuilder()
    config = MultibodyPlantConfig(
        time_step=ROW / STEPS,
        contact_model="hydroelastic" if hydroelastic else "point",
        discrete_contact_approximation=approximation,
        use_sampled_output_ports=False,
    )
    plant, _ = AddMultibodyPlant(config, builder)
    unit = UnitInertia(*[values["inertia"] / MASS] * 3)
    body = plant.AddRigidBody("cube", SpatialInertia(MASS, np.zeros(3), unit))
    cube, floor = properties(values, hydroelastic), properties(values, hydroelastic)
    if hydroelastic:
        modulus = 1e3 * values["stiffness"]
        AddCompliantHydroelasticProperties(EDGE / 4, modulus, cube)
        AddRigidHydroelasticProperties(floor)
    shape = Box(EDGE, EDGE, EDGE)
    plant.RegisterCollisionGeometry(body, RigidTransform(), shape, "cube", cube)
    plane = table(values)
    at = RigidTransform(RotationMatrix(frame(plane)), plane.normal * plane.offset)
    plant.RegisterCollisionGeometry(plant.world_body(), at, HalfSpace(), "table", floor)
    plant.mutable_gravity_field().set_gravity_vector([0, 0, -GRAVITY])
    plant.Finalize()
    return Simulator(builder.Build()), plant, body


_last: tuple = ()  # values and setting, and the simulator made for them


def simulate(start: Start, values: dict[str, float], setting: str) -> np.ndarray:
    global _last
    if not _last or _last[0] != (values, setting):
        _last = ((dict(values), setting), simulator(values, setting))
    simulation, plant, body = _last[1]
    context = simulation.get_mutable_context()
    context.SetTime(0.0)
    inside = plant.GetMyMutableContextFromRoot(context)
    R = RotationMatrix.ProjectToRotationMatrix(M=start.pose[:3, :3])
    plant.SetFreeBodyPose(inside, body, RigidTransform(R, start.pose[:3, 3]))
    v = start.velocity + np.array([0, 0, GRAVITY * ROW / STEPS / 2])  # steps are semi-implicit
    plant.SetFreeBodySpatialVelocity(inside, body, SpatialVelocity(start.spin, v))
    simulation.Initialize()
    poses = np.empty((start.rows, 4, 4))
    for k, pose in enumerate(poses):
        if k > 0:  # not to 0: the first update is there
            simulation.AdvanceTo((k - 0.5 / STEPS) * ROW)  # between two updates
        pose[:] = body.EvalPoseInWorld(inside).GetAsMatrix4()
    return poses
