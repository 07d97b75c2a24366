"""URDF texts of models with any number of parts, for examples and benchmarks."""

from __future__ import annotations

from collections.abc import Sequence
from math import sqrt

from saltus._core import ModelError


def cradle(
    balls: int,
    gap: float = 0.0,
    *,
    radius: float = 0.05,
    mass: float | Sequence[float] = 1.0,
    length: float = 1.0,
    sways: bool = True,
) -> str:
    """Return a Newton's cradle of spherical pendulums, or of plane ones.

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
    sways : bool
        False: plane pendulums, without `sway_i` and `gimbal_i`.

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
        _pendulum(i, (i - (balls - 1) / 2) * step, radius, masses[i], length, sways)
        for i in range(balls)
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


def billiard(rows: int = 5, *, radius: float = 0.028575, mass: float = 0.17) -> str:
    """Return a cue ball and a triangle of balls that touch, on a table without cushions.

    Ball i slides on the joints `x_i` and `y_i`. `ball_0` is the cue, at the origin; the triangle
    begins at x = 20 radii with `ball_1` and widens towards +x. The table is not modelled: load the
    text with `gravity=(0, 0, 0)`.

    Parameters
    ----------
    rows : int
        Of the triangle: 5 make 15 balls.
    radius : float
        [m]
    mass : float
        [kg] of every ball.

    Returns
    -------
    str
        URDF text for `saltus.load_urdf`.

    Raises
    ------
    ModelError
        On fewer than one row.
    """
    if rows < 1:
        raise ModelError(f"a triangle of {rows} rows")
    places = [(0.0, 0.0)]
    for row in range(rows):
        x = (20 + sqrt(3) * row) * radius
        places += [(x, (2 * k - row) * radius) for k in range(row + 1)]
    parts = [_slider(i, "xy", (x, y, 0.0), radius, mass) for i, (x, y) in enumerate(places)]
    return f'<robot name="billiard_{rows}">\n  <link name="table"/>\n{"".join(parts)}</robot>\n'


def galton(rows: int = 20, columns: int = 10, balls: int = 5, *, pitch: float = 0.05) -> str:
    """Return a Galton board: rows of pins, balls that fall among them, and two walls.

    Pins are cylinders on the link `board`, and so never collide with each other; they are in the
    group `pins`. Ball i slides on the joints `x_i` and `z_i` in the plane y = 0; it hangs above the
    topmost row, which is at z = 0. The balls are in the group `balls` and pass through each
    other, so that each keeps its own energy.

    Parameters
    ----------
    rows, columns : int
        Of pins: 20 and 10 make 200.
    balls : int
        Each starts 0.013 of the pitch beside the one before it.
    pitch : float
        [m] between pins in a row, and between rows; a pin's radius is 1/10 of it, a ball's 1/5.

    Returns
    -------
    str
        URDF text for `saltus.load_urdf`.

    Raises
    ------
    ModelError
        On no pins or no balls.
    """
    if min(rows, columns, balls) < 1:
        raise ModelError(f"a board of {rows} x {columns} pins and {balls} balls")
    half = columns * pitch / 2  # odd rows are shifted by half a pitch
    pins = "".join(
        _pin((k + 0.25 + 0.5 * (row % 2)) * pitch - half, -row * pitch, pitch)
        for row in range(rows)
        for k in range(columns)
    )
    at = [((0.013 * i + 0.13) * pitch, 0.0, pitch) for i in range(balls)]
    sliders = "".join(_slider(i, "xz", at[i], 0.2 * pitch, 1.0) for i in range(balls))
    names = " ".join(f"ball_{i}" for i in range(balls))
    return f"""\
<robot name="galton_{rows * columns}">
  <link name="board">
{pins}  </link>
{sliders}  <saltus>
    <half_space name="left" normal="1 0 0" offset="{_number(-half)}"/>
    <half_space name="right" normal="-1 0 0" offset="{_number(-half)}"/>
    <group name="pins" links="board"/>
    <group name="balls" links="{names}"/>
    <exclude group1="balls" group2="balls"/>
  </saltus>
</robot>
"""


def _pin(x: float, z: float, pitch: float) -> str:
    return f"""\
    <collision>
      <origin xyz="{_number(x)} 0 {_number(z)}" rpy="1.5707963267948966 0 0"/>
      <geometry>
        <cylinder radius="{_number(0.1 * pitch)}" length="{_number(pitch)}"/>
      </geometry>
    </collision>
"""


def _slider(i: int, axes: str, at: tuple[float, float, float], radius: float, mass: float) -> str:
    """Return a ball on two slides, the first named axis at the root."""
    first, second = axes[0], axes[1]
    unit = {"x": "1 0 0", "y": "0 1 0", "z": "0 0 1"}
    root = "table" if axes == "xy" else "board"
    return f"""\
  <joint name="{first}_{i}" type="prismatic">
    <parent link="{root}"/>
    <child link="slide_{i}"/>
    <origin xyz="{" ".join(map(_number, at))}"/>
    <axis xyz="{unit[first]}"/>
    <limit lower="-1e6" upper="1e6" effort="0" velocity="1000"/>
  </joint>
  <link name="slide_{i}"/>
  <joint name="{second}_{i}" type="prismatic">
    <parent link="slide_{i}"/>
    <child link="ball_{i}"/>
    <axis xyz="{unit[second]}"/>
    <limit lower="-1e6" upper="1e6" effort="0" velocity="1000"/>
  </joint>
  <link name="ball_{i}">
{_ball(radius, mass, 0.0)}  </link>
"""


def _pendulum(i: int, x: float, radius: float, mass: float, length: float, sways: bool) -> str:
    gimbal = f"""\
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
"""
    pivot = f"""\
    <child link="ball_{i}"/>
    <origin xyz="{_number(x)} 0 {_number(length)}"/>
    <axis xyz="0 1 0"/>
  </joint>
"""
    return f"""\
  <joint name="swing_{i}" type="continuous">
    <parent link="frame"/>
{gimbal if sways else pivot}  <link name="ball_{i}">
{_ball(radius, mass, -length)}  </link>
"""


def _ball(radius: float, mass: float, z: float) -> str:
    """Return inertia and shape of a solid sphere at this height in its link's frame."""
    about_centre = 0.4 * mass * radius**2
    return f"""\
    <inertial>
      <origin xyz="0 0 {_number(z)}"/>
      <mass value="{_number(mass)}"/>
      {_inertia(about_centre, about_centre, about_centre)}
    </inertial>
    <collision>
      <origin xyz="0 0 {_number(z)}"/>
      <geometry>
        <sphere radius="{_number(radius)}"/>
      </geometry>
    </collision>
"""


def _inertia(ixx: float, iyy: float, izz: float) -> str:
    xx, yy, zz = _number(ixx), _number(iyy), _number(izz)
    return f'<inertia ixx="{xx}" ixy="0" ixz="0" iyy="{yy}" iyz="0" izz="{zz}"/>'


def _number(x: float) -> str:
    """Return x with 15 digits, so that 0.1 + 0.2 reads 0.3."""
    return f"{x:.15g}"
