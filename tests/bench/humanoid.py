"""A humanoid of 32 joints on a free base, as URDF text: a robot's tree without a download."""

from __future__ import annotations

LIMBS = {  # where each begins on its parent [m], and the axes of its joints
    "leg_left": ("base", "0 0.1 -0.1", "zxyyyx"),
    "leg_right": ("base", "0 -0.1 -0.1", "zxyyyx"),
    "torso": ("base", "0 0 0.1", "zy"),
    "arm_left": ("torso_1", "0 0.2 0.3", "zxzyzxyy"),
    "arm_right": ("torso_1", "0 -0.2 0.3", "zxzyzxyy"),
    "head": ("torso_1", "0 0 0.4", "yz"),
}
AXES = {"x": "1 0 0", "y": "0 1 0", "z": "0 0 1"}


def humanoid() -> str:
    """Return a tree as wide and as deep as common humanoids': 38 coordinates with its base's."""
    parts = [_link("base", 15.0)]
    for limb, (parent, at, axes) in LIMBS.items():
        for i, axis in enumerate(axes):
            name = f"{limb}_{i}"
            parts += [_joint(name, parent, at, AXES[axis]), _link(name, 2.0)]
            parent, at = name, "0 0.01 -0.15"
    return f'<robot name="humanoid">{"".join(parts)}</robot>'


def _joint(name: str, parent: str, at: str, axis: str) -> str:
    return (
        f'<joint name="{name}" type="continuous"><parent link="{parent}"/><child link="{name}"/>'
        f'<origin xyz="{at}"/><axis xyz="{axis}"/></joint>'
    )


def _link(name: str, mass: float) -> str:
    return (
        f'<link name="{name}"><inertial><origin xyz="0 0 -0.08"/><mass value="{mass}"/>'
        '<inertia ixx="0.02" iyy="0.02" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>'
    )
