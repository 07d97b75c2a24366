"""URDF without fixed joints, so that every engine is given the same bodies and no more."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import dataclass, field

import numpy as np

DIAGONAL_AND_ABOVE = (
    ("ixx", 0, 0),
    ("ixy", 0, 1),
    ("ixz", 0, 2),
    ("iyy", 1, 1),
    ("iyz", 1, 2),
    ("izz", 2, 2),
)


@dataclass
class Body:
    """Mass, first moment and inertia, all about the origin of the link's frame L."""

    mass: float = 0.0  # [kg]
    first: np.ndarray = field(default_factory=lambda: np.zeros(3))  # [kg m] mass * p_LCom
    inertia: np.ndarray = field(default_factory=lambda: np.zeros((3, 3)))  # [kg m^2]

    def add(self, other: Body, X: np.ndarray) -> None:
        """Join `other`, whose frame is placed at X, shape (4, 4), in this one's."""
        R, p = X[:3, :3], X[:3, 3]
        first = R @ other.first
        # I + m [p]'[p] + [p]'[c] + [c]'[p], with c the first moment in our axes
        cross = _gram(p, first)
        self.inertia += R @ other.inertia @ R.T + other.mass * _gram(p, p) + cross + cross.T
        self.first += first + other.mass * p
        self.mass += other.mass


def without_fixed_joints(robot: ET.Element) -> None:
    """Fold the child of every fixed joint into its parent."""
    links = {link.get("name"): link for link in robot.iterfind("link")}
    bodies = {name: read_body(link) for name, link in links.items()}
    changed = set()
    while (joint := robot.find("joint[@type='fixed']")) is not None:
        parent = joint.find("parent").get("link")
        child = joint.find("child").get("link")
        X = read_origin(joint)
        bodies[parent].add(bodies[child], X)
        changed.add(parent)
        for other in robot.iterfind("joint"):
            if other.find("parent").get("link") == child:
                other.find("parent").set("link", parent)
                write_origin(other, X @ read_origin(other))
        robot.remove(joint)
        robot.remove(links[child])
    for name in changed:
        if bodies[name].mass > 0:
            write_body(links[name], bodies[name])


def read_body(link: ET.Element) -> Body:
    body = Body()
    inertial = link.find("inertial")
    if inertial is not None:
        moments = inertial.find("inertia")
        inertia = np.zeros((3, 3))
        for name, i, j in DIAGONAL_AND_ABOVE:
            inertia[i, j] = inertia[j, i] = float(moments.get(name, "0"))
        mass = float(inertial.find("mass").get("value"))
        body.add(Body(mass, np.zeros(3), inertia), read_origin(inertial))
    return body


def write_body(link: ET.Element, body: Body) -> None:
    for old in link.findall("inertial"):
        link.remove(old)
    com = body.first / body.mass
    about_com = body.inertia - body.mass * _gram(com, com)
    inertial = ET.SubElement(link, "inertial")
    ET.SubElement(inertial, "origin", xyz=_text(com), rpy="0 0 0")
    ET.SubElement(inertial, "mass", value=repr(float(body.mass)))
    moments = {name: repr(float(about_com[i, j])) for name, i, j in DIAGONAL_AND_ABOVE}
    ET.SubElement(inertial, "inertia", moments)


def read_origin(element: ET.Element) -> np.ndarray:
    """Return the pose of the element's <origin>, shape (4, 4)."""
    X = np.eye(4)
    origin = element.find("origin")
    if origin is not None:
        X[:3, 3] = np.fromstring(origin.get("xyz", "0 0 0"), sep=" ")
        X[:3, :3] = _rotation(*np.fromstring(origin.get("rpy", "0 0 0"), sep=" "))
    return X


def write_origin(element: ET.Element, X: np.ndarray) -> None:
    origin = element.find("origin")
    if origin is None:
        origin = ET.SubElement(element, "origin")
    R = X[:3, :3]
    # At a pitch of +-90 degrees roll and yaw are one angle: all of it is called yaw.
    pitch = np.arctan2(-R[2, 0], np.hypot(R[0, 0], R[1, 0]))
    if np.hypot(R[0, 0], R[1, 0]) > 1e-9:
        roll, yaw = np.arctan2(R[2, 1], R[2, 2]), np.arctan2(R[1, 0], R[0, 0])
    else:
        roll, yaw = 0.0, np.arctan2(-R[0, 1], R[1, 1])
    origin.attrib = {"xyz": _text(X[:3, 3]), "rpy": _text(np.array([roll, pitch, yaw]))}


def _rotation(roll: float, pitch: float, yaw: float) -> np.ndarray:
    (cr, cp, cy), (sr, sp, sy) = np.cos([roll, pitch, yaw]), np.sin([roll, pitch, yaw])
    about_x = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    about_y = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    about_z = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    return about_z @ about_y @ about_x


def _gram(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return [a]'[b] of the cross matrices: (a.b) 1 - b a'."""
    return a @ b * np.eye(3) - np.outer(b, a)


def _text(x: np.ndarray) -> str:
    return " ".join(repr(float(number)) for number in x)
