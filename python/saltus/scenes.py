"""URDF texts of models with any number of parts, for examples and benchmarks."""

from __future__ import annotations

from collections.abc import Sequence

from saltus._core import ModelError


def cradle(
    balls: int,
    gap: float = 0.0,
    *,
    radius: float = 0.05,
    mass: float | Sequence[float] = 1.0,
    length: float = 1.0,
) -> str:
    """Return a Newton's cradle of spherical pendulums.

    Ball i hangs on the joints `swing_i` (about y, in the plane of the row; positive lifts it
    towards -x) and `sway_i` (about x, out of it). Links: `frame` (fixed), `gimbal_i` (no mass)
    and `ball_i`, a solid sphere. At rest the balls are at z = 0, the row is centred on x = 0.

    Parameters
    ----------
    balls : int
    gap : float
        [m] between neighbours at rest.
    radius : float
        [m]
    mass : float or sequence of float
        [kg] of every ball, or one number a ball.
    length : float
        [m] from pivot to centre.

    Returns
    -------
    str
        URDF text for `saltus.load_urdf`.

    Raises
    ------
    ModelError
        On numbers that no cradle can have.
    """
    masses = [float(mass)] * balls if isinstance(mass, int | float) else [float(m) for m in mass]
    if balls < 1 or len(masses) != balls:
        raise ModelError(f"a cradle of {balls} balls with {len(masses)} masses")
    if gap < 0:
        raise ModelError(f"gap = {gap} m: balls at rest cannot overlap")
    step = 2 * radius + gap
    parts = [
        _pendulum(i, (i - (balls - 1) / 2) * step, radius, masses[i], length) for i in range(balls)
    ]
    return f'<robot name="cradle_{balls}">\n  <link name="frame"/>\n{"".join(parts)}</robot>\n'


def chain(links: int, *, length: float = 0.2, mass: float = 0.2, radius: float = 0.02) -> str:
    """Return a chain of rods on revolute joints, axes alternately x and y.

    Joint `joint_i` carries `link_i`, a homogeneous cylinder that hangs down from it; nothing can
    touch.

    Parameters
    ----------
    links : int
    length : float
        [m] of a link.
    mass : float
        [kg] of a link.
    radius : float
        [m] of a link, for its inertia.

    Returns
    -------
    str
        URDF text for `saltus.load_urdf`.

    Raises
    ------
    ModelError
        On fewer than one link.
    """
    if links < 1:
        raise ModelError(f"a chain of {links} links")
    across = mass * (3 * radius**2 + length**2) / 12
    along = mass * radius**2 / 2
    parts = []
    for i in range(links):
        parent, z = ("frame", 0.0) if i == 0 else (f"link_{i - 1}", -length)
        parts.append(f"""\
  <joint name="joint_{i}" type="continuous">
    <parent link="{parent}"/>
    <child link="link_{i}"/>
    <origin xyz="0 0 {_number(z)}"/>
    <axis xyz="{"1 0 0" if i % 2 == 0 else "0 1 0"}"/>
  </joint>
  <link name="link_{i}">
    <inertial>
      <origin xyz="0 0 {_number(-length / 2)}"/>
      <mass value="{_number(mass)}"/>
      {_inertia(across, across, along)}
    </inertial>
  </link>
""")
    return f'<robot name="chain_{links}">\n  <link name="frame"/>\n{"".join(parts)}</robot>\n'


def _pendulum(i: int, x: float, radius: float, mass: float, length: float) -> str:
    about_centre = 0.4 * mass * radius**2
    return f"""\
  <joint name="swing_{i}" type="continuous">
    <parent link="frame"/>
    <child link="gimbal_{i}"/>
    <origin xyz="{_number(x)} 0 {_number(length)}"/>
    <axis xyz="0 1 0"/>
  </joint>
  <link name="gimbal_{i}"/>
  <joint name="sway_{i}" type="continuous">
    <parent link="gimbal_{i}"/>
    <child link="ball_{i}"/>
    <axis xyz="1 0 0"/>
  </joint>
  <link name="ball_{i}">
    <inertial>
      <origin xyz="0 0 {_number(-length)}"/>
      <mass value="{_number(mass)}"/>
      {_inertia(about_centre, about_centre, about_centre)}
    </inertial>
    <collision>
      <origin xyz="0 0 {_number(-length)}"/>
      <geometry>
        <sphere radius="{_number(radius)}"/>
      </geometry>
    </collision>
  </link>
"""


def _inertia(ixx: float, iyy: float, izz: float) -> str:
    xx, yy, zz = _number(ixx), _number(iyy), _number(izz)
    return f'<inertia ixx="{xx}" ixy="0" ixz="0" iyy="{yy}" iyz="0" izz="{zz}"/>'


def _number(x: float) -> str:
    """Return x with 15 digits, so that 0.1 + 0.2 reads 0.3."""
    return f"{x:.15g}"
