"""The scenes: cradles, a line of unequal balls, a billiard break. All balls touch, but in one."""

from __future__ import annotations

from math import cos, pi, sqrt

import saltus
from compare.scene import Scene

LIFTED = 0.3  # [rad]
CUE = 5.0  # [m/s]
MIDDLE = 1 / cos(pi / 4) - 1  # mass of the middle ball of three for an angle of pi / 4

QUICK = 2.0  # [s] of a cradle, where only a look is wanted


def all_scenes(quick: bool = False) -> list[Scene]:
    """Return the scenes; quick ones show the first impact and little more."""
    seconds = QUICK if quick else 60.0
    cradles = [cradle(3, 1, seconds), cradle(5, 2, seconds), cradle(3, 1, seconds, gap=1e-6)]
    return [*cradles, line(), billiard()]


def cradle(balls: int, up: int, seconds: float, gap: float = 0.0) -> Scene:
    radius = 0.05
    apart = f", {1e6 * gap:g} µm apart" if gap else ""
    return Scene(
        name=f"cradle of {balls}, {up} up{apart}",
        kind="cradle",
        urdf=saltus.scenes.cradle(balls, gap, radius=radius, sways=False),
        radius=radius,
        masses=[1.0] * balls,
        places=[((i - (balls - 1) / 2) * (2 * radius + gap), 0.0) for i in range(balls)],
        q=[LIFTED] * up + [0.0] * (balls - up),
        v=[0.0] * balls,
        duration=seconds,
        gap=gap,
    )


def line() -> Scene:
    """Return a ball that comes with 1 m/s, to two that touch, 0.1 m away."""
    masses, radius = [1.0, MIDDLE, 1.0], 0.05
    places = [(-0.2, 0.0), (0.0, 0.0), (0.1, 0.0)]
    return Scene(
        name="three unequal balls",
        kind="line",
        urdf=_sliders(masses, radius, [x for x, _ in places]),
        radius=radius,
        masses=masses,
        places=places,
        q=[0.0] * 3,
        v=[1.0, 0.0, 0.0],
        duration=0.3,
    )


def billiard(rows: int = 5) -> Scene:
    radius, mass = 0.028575, 0.17
    places = [(0.0, 0.0)]
    for row in range(rows):
        x = (20 + sqrt(3) * row) * radius
        places += [(x, (2 * k - row) * radius) for k in range(row + 1)]
    balls = len(places)
    return Scene(
        name="billiard break",
        kind="break",
        urdf=saltus.scenes.billiard(rows, radius=radius, mass=mass),
        radius=radius,
        masses=[mass] * balls,
        places=places,
        q=[0.0] * (2 * balls),
        v=[CUE] + [0.0] * (2 * balls - 1),
        duration=0.3,
    )


def _sliders(masses: list[float], radius: float, places: list[float]) -> str:
    parts = [
        f"""\
  <joint name="x_{i}" type="prismatic">
    <parent link="rail"/>
    <child link="ball_{i}"/>
    <origin xyz="{x!r} 0 0"/>
    <axis xyz="1 0 0"/>
    <limit lower="-1000" upper="1000" effort="0" velocity="1000"/>
  </joint>
  <link name="ball_{i}">
    <inertial>
      <mass value="{mass!r}"/>
      <inertia ixx="{moment!r}" ixy="0" ixz="0" iyy="{moment!r}" iyz="0" izz="{moment!r}"/>
    </inertial>
    <collision>
      <geometry>
        <sphere radius="{radius!r}"/>
      </geometry>
    </collision>
  </link>
"""
        for i, (mass, x) in enumerate(zip(masses, places, strict=True))
        for moment in [0.4 * mass * radius**2]
    ]
    return f'<robot name="line">\n  <link name="rail"/>\n{"".join(parts)}</robot>\n'
