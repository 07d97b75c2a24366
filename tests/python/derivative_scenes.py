"""The systems of tests/data/step_derivatives.json, and steps that several tests differentiate."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np

import saltus
from saltus import BodyInertia, ModelBuilder, Pose

DATA = Path(__file__).parents[1] / "data"
CASES = {c["name"]: c for c in json.loads((DATA / "step_derivatives.json").read_text())["cases"]}


def numbers(x: object) -> np.ndarray:
    """Return decimals of 21 digits as doubles."""
    return np.array(x, dtype=object).astype(float)


def golden_system(name: str) -> saltus.Model:
    """Return a system of tests/data/golden.json."""
    systems = json.loads((DATA / "golden.json").read_text())["systems"]
    system = next(each for each in systems if each["name"] == name)
    builder = ModelBuilder(name, system["frames"][0][0]).set_gravity(system["gravity"])
    bodies = {
        b["frame"]: BodyInertia(b["mass"], b["com"], b["inertia_com"]) for b in system["bodies"]
    }
    for frame, parent, kind, parameter in system["frames"][1:]:
        builder.add_link(frame, bodies.get(frame, BodyInertia(0, (0, 0, 0), np.zeros((3, 3)))))
        if kind == "SE3":
            X = Pose(parameter["p"], parameter["R"])
            builder.add_joint(frame, "fixed", parent=parent, child=frame, X_PJ=X)
            continue
        axis = np.eye(3)["XYZ".index(kind[1])]
        if isinstance(parameter, list):
            joint = "revolute" if kind[0] == "R" else "prismatic"
            builder.add_joint(parameter[1], joint, parent=parent, child=frame, axis=axis)
        else:
            builder.add_joint(
                frame, "fixed", parent=parent, child=frame, X_PJ=Pose(parameter * axis)
            )
    return builder.build()


def ball_above_floor(case: dict) -> saltus.Model:
    m, r = numbers(case["theta"])
    builder = ModelBuilder("ball").add_half_space("floor", (0, 0, 1))
    builder.add_body("ball", saltus.Sphere(r), mass=m, joint="prismatic", axis=(0, 0, 1))
    return builder.set_default_contact(restitution=float(case["restitution"])).build()


def add_pendulum_ball(
    builder: ModelBuilder, name: str, parent: str, at: tuple, mass: float, length: float
) -> None:
    """Add a solid ball of radius 0.05 that hangs on a joint about y."""
    inertia = 0.4 * mass * 0.05**2
    builder.add_link(name, BodyInertia(mass, (0, 0, -length), inertia * np.eye(3)))
    builder.add_shape(name, saltus.Sphere(0.05), Pose((0, 0, -length)))
    builder.add_joint(
        f"joint_{name}", "revolute", parent=parent, child=name, X_PJ=Pose(at), axis=(0, 1, 0)
    )


def double_pendulum(case: dict) -> saltus.Model:
    m1, m2, l1, l2, wall = numbers(case["theta"])
    # about -y, so that positive angles swing the balls to +x
    builder = ModelBuilder("double pendulum").add_half_space("wall", (-1, 0, 0), -wall)
    for name, parent, at, m, length in (
        ("upper", "world", (0, 0, 0), m1, l1),
        ("lower", "upper", (0, 0, -l1), m2, l2),
    ):
        inertia = 0.4 * m * 0.05**2
        builder.add_link(name, BodyInertia(m, (0, 0, -length), inertia * np.eye(3)))
        builder.add_joint(
            f"joint_{name}",
            "revolute",
            parent=parent,
            child=name,
            X_PJ=Pose(at),
            axis=(0, -1, 0),
            damping=0.05,
        )
    builder.add_shape("lower", saltus.Sphere(0.05), Pose((0, 0, -l2)))
    return builder.set_default_contact(restitution=float(case["restitution"])).build()


def cradle(case: dict) -> saltus.Model:
    gap = float(numbers(case["theta"])[0])
    builder = ModelBuilder("cradle")
    for i in range(3):
        name = f"ball_{i}"
        builder.add_link(name, BodyInertia(1, (0, 0, -1), 0.001 * np.eye(3)))
        builder.add_shape(name, saltus.Sphere(0.05), Pose((0, 0, -1)))
        at = Pose((i * (0.1 + gap), 0, 0))
        builder.add_joint(
            f"swing_{i}", "revolute", parent="world", child=name, X_PJ=at, axis=(0, -1, 0)
        )
    return builder.build()


def corner(case: dict) -> saltus.Model:
    angle = float(case["angle"])
    r = 0.1
    builder = ModelBuilder("corner").set_gravity((0.3, 0, -2))
    builder.add_half_space("wall_0", (0, 0, 1), -r)
    builder.add_half_space("wall_1", (math.sin(angle), 0, -math.cos(angle)), -r)
    builder.add_link("slide", BodyInertia(0, (0, 0, 0), np.zeros((3, 3))))
    builder.add_joint("x", "prismatic", parent="world", child="slide", axis=(1, 0, 0))
    builder.add_link("ball", BodyInertia(1, (0, 0, 0), 0.004 * np.eye(3)))
    builder.add_shape("ball", saltus.Sphere(r))
    return builder.add_joint("z", "prismatic", parent="slide", child="ball", axis=(0, 0, 1)).build()


def ball_on_ball(case: dict) -> saltus.Model:
    m, R = numbers(case["theta"])
    builder = ModelBuilder("ball on ball")
    builder.add_body("hill", saltus.Sphere(R), joint="fixed")
    builder.add_link("slide", BodyInertia(0, (0, 0, 0), np.zeros((3, 3))))
    builder.add_joint("x", "prismatic", parent="world", child="slide", axis=(1, 0, 0))
    builder.add_link("ball", BodyInertia(m, (0, 0, 0), 0.4 * m * 0.01 * np.eye(3)))
    builder.add_shape("ball", saltus.Sphere(0.1))
    return builder.add_joint("z", "prismatic", parent="slide", child="ball", axis=(0, 0, 1)).build()


MODELS = {
    "chain3_mixed": lambda case: golden_system("chain3_mixed"),
    "cradle3_spherical": lambda case: golden_system("cradle3_spherical"),
    "bouncing_ball": ball_above_floor,
    "ball_lands": ball_above_floor,
    "double_pendulum_wall_nodal": double_pendulum,
    "double_pendulum_wall_discrete": double_pendulum,
    "cradle_with_gaps": cradle,
    "cradle_touching_100": cradle,
    "cradle_touching_2_02_-1": cradle,
    "corner_pi_2": corner,
    "corner_pi_3": corner,
    "ball_slides_on_ball": ball_on_ball,
}


def step_of(case: dict) -> tuple[saltus.Stepper, saltus.State]:
    """Return a stepper that has made the step of a case, and the state it ended in."""
    model = MODELS[case["name"]](case)
    stepper = saltus.Stepper(model, h=float(case["h"]), law=case["law"], record=True)
    state = saltus.State(0.0, numbers(case["q"]), numbers(case["p"]))
    return stepper, stepper.advance(state, qfrc=numbers(case["u"]))


def golden_columns(case: dict, by: str) -> np.ndarray:
    """Return the golden derivative by `by`, rows q_next then p_next."""
    part = case["derivative"][by]
    return np.vstack([np.atleast_2d(numbers(part[row])) for row in ("q_next", "p_next")])


def relative_error(x: np.ndarray, golden: np.ndarray) -> float:
    """Return the largest difference relative to the largest entry."""
    return float(np.abs(x - golden).max() / max(1e-300, np.abs(golden).max()))
