"""The benchmarks' models: one URDF text each, that every engine is given."""

from __future__ import annotations

import importlib.metadata
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from pathlib import Path

import saltus
from tests.bench.reduce import without_fixed_joints

ROBOTS = {
    "panda": ("panda_description/urdf/panda.urdf", False),
    "anymal": ("anymal_b_simple_description/robots/anymal.urdf", True),
    "talos": ("talos_data/robots/talos_reduced.urdf", True),
    "tiago": ("tiago_description/robots/tiago.urdf", False),
}


ROOT = Path(__file__).parents[2]

ROBOTS_RATE = 0.2  # [rad/s] or they would fall freely from rest, and their joints not move

PLACE_HOLDER = 1e-5  # [kg] lighter links have inertias of no body, which MuJoCo refuses


@dataclass(frozen=True)
class Scene:
    """A tree without shapes, mimic joints, damping and limits, and its calm start."""

    name: str
    kind: str  # chain, cradle, robot
    urdf: str
    angle: float  # [rad | m] every coordinate at the start
    floating: bool = False
    rate: float = 0.0  # [rad/s | m/s] every joint's velocity at the start; a free base rests
    balls: int = 0  # of a cradle, else 0


def chain(links: int) -> Scene:
    return Scene(f"chain {links}", "chain", saltus.scenes.chain(links), 0.1)


def cradle(balls: int) -> Scene:
    urdf = bare(saltus.scenes.cradle(balls))
    return Scene(f"cradle {balls}", "cradle", urdf, 0.1, balls=balls)


def touching_cradle(balls: int) -> Scene:
    """Return a cradle with its shapes; its angle is the first ball's."""
    return Scene(f"cradle {balls}", "touching", saltus.scenes.cradle(balls), 0.3, balls=balls)


def standing_quadruped() -> Scene:
    """Return the quadruped of the examples with friction under its feet, and its parcel."""
    text = (ROOT / "urdf" / "quadruped.urdf").read_text()
    frictionless, rough = (
        '<contact restitution="1" friction="0"/>',
        '<contact restitution="0" friction="0.5"/>',
    )
    assert frictionless in text
    return Scene("quadruped", "pile", text.replace(frictionless, rough), 0.0)


def robots() -> tuple[list[Scene], str]:
    """Return the robots of example-robot-data, or none and why."""
    try:
        folder = robots_folder()
    except importlib.metadata.PackageNotFoundError:
        return [], "robots: example-robot-data is not installed (pip install 'saltus[robots]')"
    return [
        Scene(name, "robot", bare((folder / path).read_text()), 0.0, floating, ROBOTS_RATE)
        for name, (path, floating) in ROBOTS.items()
    ], ""


def robots_folder() -> Path:
    data = importlib.metadata.distribution("example-robot-data")
    return Path(data.locate_file("cmeel.prefix/share/example-robot-data/robots"))


def bare(urdf: str) -> str:
    """Return links, inertias and moving joints alone.

    Meshes, limits, damping, mimic and fixed joints are what engines treat differently.
    """
    robot = ET.fromstring(urdf)
    for element in list(robot):
        if element.tag not in {"link", "joint"}:
            robot.remove(element)
        for part in list(element):
            if part.tag in {"visual", "collision", "mimic", "dynamics", "safety_controller"}:
                element.remove(part)
            elif part.tag == "limit":
                part.attrib = {"lower": "-1e3", "upper": "1e3", "effort": "1e6", "velocity": "1e6"}
    without_fixed_joints(robot)
    for inertial in robot.iterfind("link/inertial"):
        if 0 < float(inertial.find("mass").get("value")) < PLACE_HOLDER:
            small = {
                "ixx": "1e-9",
                "iyy": "1e-9",
                "izz": "1e-9",
                "ixy": "0",
                "ixz": "0",
                "iyz": "0",
            }
            inertial.find("inertia").attrib = small
    return ET.tostring(robot, encoding="unicode")


def root_link(urdf: str) -> str:
    robot = ET.fromstring(urdf)
    children = {joint.find("child").get("link") for joint in robot.iterfind("joint")}
    (root,) = (e.get("name") for e in robot.iterfind("link") if e.get("name") not in children)
    return root


def ancestor_pairs(scene: Scene) -> int:
    """Return how many pairs (joint, itself or one above it) the scene's tree has."""
    robot = ET.fromstring(scene.urdf)
    joints = robot.findall("joint")
    above = {j.find("child").get("link"): j.find("parent").get("link") for j in joints}
    base = 6 if scene.floating else 0
    depths = [base]
    for link in above:
        depth = base
        while link in above:
            link, depth = above[link], depth + 1
        depths.append(depth)
    return sum(depths[1:]) + base * (base + 1) // 2
