"""
Compiled part of saltus; everything public is in the package itself.
"""

from __future__ import annotations
import collections.abc
import enum
import numpy
import numpy.typing
import os
import typing

__all__: list[str] = [
    "AdjacentLinks",
    "At",
    "BatchTrajectory",
    "BodyInertia",
    "Box",
    "BuilderJoint",
    "BuilderLink",
    "Capsule",
    "ContactImpulse",
    "ContactProperties",
    "Convex",
    "Coordinate",
    "Cylinder",
    "Ellipsoid",
    "Energies",
    "ForceMoment",
    "Frames",
    "FrictionOutcome",
    "Gap",
    "Gaps",
    "HalfSpace",
    "Impact",
    "ImpactCertificate",
    "ImpactDerivative",
    "ImpactKind",
    "ImpactLaw",
    "ImpactOrder",
    "ImpactOutcome",
    "ImpactOutcomes",
    "ImpactProblem",
    "InertiaCheck",
    "InertiaUse",
    "JammedError",
    "JointEffects",
    "JointInfo",
    "JointType",
    "LagrangianPartials",
    "Link",
    "LoopType",
    "MeshUse",
    "Mimic",
    "Model",
    "ModelBuilder",
    "ModelError",
    "ModelGradient",
    "OnFailure",
    "Pair",
    "PlacedShape",
    "Pose",
    "Selection",
    "Sensor",
    "SensorKind",
    "Smoothness",
    "Sphere",
    "State",
    "StepDerivative",
    "StepDirection",
    "StepError",
    "StepOptions",
    "StepReport",
    "Stepper",
    "Trajectory",
    "TreeSolution",
    "TreeSolver",
    "TriangleMesh",
    "Visual",
    "Wrench",
    "adjoint",
    "check_derivatives",
    "classify_impact",
    "close_loops",
    "energies",
    "equilibrium",
    "gap",
    "gap_table",
    "has_gap",
    "impact_outcomes",
    "read_urdf",
    "resolve_impact",
    "resolve_overlap",
    "rotation_from_rpy",
    "shape_name",
    "simulate",
    "simulate_batch",
    "solid_box",
    "solid_cylinder",
    "solid_inertia",
    "solid_sphere",
    "states",
    "volume",
]

class ModelError(ValueError):
    """
    Bad input: a file, a name, the shape of an array, a number that no model can have.

    Attributes
    ----------
    element : str
        Kind of the culprit where it has a name ("link", "joint", "coordinate"), else "".
    name : str
        Its name, else "".
    trajectory : Trajectory or None
        The rows before it, where it ended a run of `simulate`.
    """

    element: typing.ClassVar[str] = ""
    name: typing.ClassVar[str] = ""
    trajectory: typing.Any

class StepError(RuntimeError):
    """
    A step that could not be made; the state it started from is unchanged.

    Attributes
    ----------
    t : float
        [s] where the step, or the arc of it that failed, began.
    residual : float
        [largest momentum] scaled residual when the solver gave up.
    iterations : int
        Newton iterations, arcs or impulses spent.
    trajectory : Trajectory or None
        The rows before it, where it ended a run of `simulate`.
    """

    iterations: typing.ClassVar[int] = 0
    residual: typing.ClassVar[float]
    t: typing.ClassVar[float]
    trajectory: typing.Any

class JammedError(StepError):
    """
    A cascade of impulses that does not end: bodies jammed between others.
    """

class Pose:
    """
    A rigid placement of a frame B in a frame A.

    `X_AB * p_B` is the point `p_B` seen from A, `X_AB * X_BC` the placement of C in A.

    Parameters
    ----------
    p : array_like, shape (3,)
        [m] B's origin in A.
    R : array_like, shape (3, 3)
        Rotation; its columns are B's axes in A.
    """
    @staticmethod
    def from_quaternion(
        quaternion: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[4, 1]"],
        p: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = (0, 0, 0),
    ) -> Pose:
        """
        A pose from a quaternion x y z w.

        Parameters
        ----------
        quaternion : array_like, shape (4,)
            x y z w, of any length but 0.
        p : array_like, shape (3,)
            [m] B's origin in A.

        Raises
        ------
        ModelError
            On a quaternion that is not finite or has no length.
        """
    @staticmethod
    def from_rpy(
        roll: typing.SupportsFloat | typing.SupportsIndex,
        pitch: typing.SupportsFloat | typing.SupportsIndex,
        yaw: typing.SupportsFloat | typing.SupportsIndex,
        p: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = (0, 0, 0),
    ) -> Pose:
        """
        A pose from fixed-axis roll, pitch and yaw [rad] and a position [m], as in URDF.
        """
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        p: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = (0, 0, 0),
        R: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 3]"] = (
            (1, 0, 0),
            (0, 1, 0),
            (0, 0, 1),
        ),
    ) -> None: ...
    @typing.overload
    def __mul__(self, X_BC: Pose) -> Pose: ...
    @typing.overload
    def __mul__(
        self, p_B: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]
    ) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    def inverse(self) -> Pose:
        """
        The placement of A in B.
        """
    def matrix(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        The homogeneous matrix, shape (4, 4).
        """
    @property
    def R(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 3]"]:
        """
        rotation, shape (3, 3)
        """
    @property
    def p(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m] origin, shape (3,)
        """
    @property
    def quaternion(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 1]"]:
        """
        the rotation as unit quaternion x y z w with w >= 0, shape (4,)
        """
    @property
    def rpy(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Roll, pitch, yaw [rad] of the rotation, shape (3,).

        Pitch is in [-pi/2, pi/2]. Where it is at one of the ends only yaw - roll or yaw + roll is told, and
        roll is 0.
        """

class BodyInertia:
    """
    Mass of a rigid body, in the frame of its link (or joint) J.

    `a + b` is the two bodies welded together.

    Parameters
    ----------
    mass : float
        [kg]
    c_J : array_like, shape (3,)
        [m] centre of mass.
    I_J : array_like, shape (3, 3)
        [kg m^2] about the centre of mass, axes of J.
    """
    def __add__(self, other: BodyInertia) -> BodyInertia: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        mass: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        c_J: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = (0, 0, 0),
        I_J: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 3]"] = (
            (0, 0, 0),
            (0, 0, 0),
            (0, 0, 0),
        ),
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    def seen_from(self, X_PB: Pose) -> BodyInertia:
        """
        The same body in frame P, where this one is given in frame B.
        """
    @property
    def I_J(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 3]"]:
        """
        [kg m^2] about the centre of mass, shape (3, 3)
        """
    @property
    def c_J(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m] centre of mass, shape (3,)
        """
    @property
    def mass(self) -> float:
        """
        [kg]
        """

class TreeSolver(enum.Enum):
    """
    How steps solve for velocities on each tree of a model.

    A matter of speed: answers differ by rounding. Leave it to `automatic`, unless timing both says
    otherwise for a tree near the border, or to check answers by another way to them.

    automatic
        lu for shallow trees, sweep for deep ones, such as chains of more than some 15 joints (20 where
        several are equal); `Model.solvers` tells what became of it.
    lu
        Elimination from the leaves, without fill: O(sum of depth^2). Equal trees are solved side by
        side, in lanes of vector instructions.
    sweep
        A recursion like that of articulated bodies, one tree after the other: O(n).
    """

    automatic = ...
    lu = ...
    sweep = ...

class LagrangianPartials:
    """
    L = T - V at one (q, v), and all its first and second partials.

    Read-only views, no copies. Rows of `L_vq` are velocities: `L_vq[i, j]` is the derivative by `v[i]`
    and `q[j]`. Johnson and Murphey, "Discrete and continuous mechanics for tree representations of
    mechanical systems", ICRA 2008, with composite quantities in place of sums over bodies.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    @property
    def L_q(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        [J/rad | N], shape (n,)
        """
    @property
    def L_qq(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        shape (n, n)
        """
    @property
    def L_v(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        [J s/rad | N s] the momenta p, shape (n,)
        """
    @property
    def L_vq(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        shape (n, n); row = velocity, column = coordinate
        """
    @property
    def L_vv(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        the mass matrix, shape (n, n)
        """
    @property
    def value(self) -> float:
        """
        [J] L = T - V
        """

class Sphere:
    """
    A ball about its frame's origin.
    """
    def __getstate__(self) -> tuple[float]: ...
    def __init__(self, radius: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def radius(self) -> float:
        """
        [m]
        """

class Capsule:
    """
    All points within `radius` of the segment |z| <= `half_length`.
    """
    def __getstate__(self) -> tuple[float, float]: ...
    def __init__(
        self,
        radius: typing.SupportsFloat | typing.SupportsIndex,
        half_length: typing.SupportsFloat | typing.SupportsIndex,
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def half_length(self) -> float:
        """
        [m] of the segment, without the caps
        """
    @property
    def radius(self) -> float:
        """
        [m]
        """

class Box:
    """
    |x| <= half[0], |y| <= half[1], |z| <= half[2].
    """
    def __getstate__(
        self,
    ) -> tuple[typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]]: ...
    def __init__(
        self, half: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def half(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m] half-extents, shape (3,)
        """

class Cylinder:
    """
    Axis z, |z| <= `half_length`.
    """
    def __getstate__(self) -> tuple[float, float]: ...
    def __init__(
        self,
        radius: typing.SupportsFloat | typing.SupportsIndex,
        half_length: typing.SupportsFloat | typing.SupportsIndex,
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def half_length(self) -> float:
        """
        [m]
        """
    @property
    def radius(self) -> float:
        """
        [m]
        """

class HalfSpace:
    """
    The solid z <= 0 of its frame; only the root link may carry one.
    """
    def __getstate__(self) -> tuple[()]: ...
    def __init__(self) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...

class Ellipsoid:
    """
    (x/radii[0])^2 + (y/radii[1])^2 + (z/radii[2])^2 <= 1.
    """
    def __getstate__(
        self,
    ) -> tuple[typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]]: ...
    def __init__(
        self, radii: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def radii(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m] shape (3,)
        """

class Convex:
    """
    The convex hull of points, facets that are coplanar joined.

    Parameters
    ----------
    points : array_like, shape (n, 3)
        [m] 4 or more, not in a plane; those inside are dropped.

    Raises
    ------
    ModelError
        Where they are too few, not finite, or thinner than 1e-6 of their length.
    """
    def __getstate__(self) -> tuple: ...
    def __init__(
        self, points: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 3]"]
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def edges(self) -> list[tuple[int, int]]:
        """
        vertices at the two ends of each edge
        """
    @property
    def faces(self) -> list[list[int]]:
        """
        vertices of each face, counterclockwise seen from outside
        """
    @property
    def vertices(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
        """
        [m] the points that are corners of the hull, shape (n, 3)
        """

class Gap:
    """
    The gap between two shapes a and b.

    `p_WA - p_WB == phi * n_W` and `|n_W| == 1`; `n_W` points from b to a; `phi < 0` is penetration.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    @property
    def F_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 3]"]:
        """
        [1/m] second partials of phi for translations of a against b, shape (3, 3)
        """
    @property
    def n_W(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        unit normal from b to a, shape (3,)
        """
    @property
    def p_WA(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m] witness on a's surface, shape (3,)
        """
    @property
    def p_WB(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m] witness on b's surface, shape (3,)
        """
    @property
    def phi(self) -> float:
        """
        [m] signed distance
        """

class PlacedShape:
    """
    A shape of a model and the joint frame that carries it.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    @property
    def X_LG(self) -> Pose:
        """
        Pose of its frame in its link's
        """
    @property
    def link(self) -> int:
        """
        index of its link in the model's `links`
        """
    @property
    def name(self) -> str:
        """
        the link's name, "#k" added where a link has several
        """
    @property
    def shape(self) -> Sphere | Capsule | Box | Cylinder | HalfSpace | Ellipsoid | Convex:
        """
        one of the classes of `Shape`
        """

class Pair:
    """
    A gap that is watched, of two shapes of a model or of parts of them.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    @property
    def a(self) -> int:
        """
        index in the model's `shapes`
        """
    @property
    def b(self) -> int:
        """
        index in the model's `shapes`
        """
    @property
    def part(self) -> int:
        """
        which of the gaps of these two shapes
        """
    @property
    def touch(self) -> float:
        """
        [m] below this |phi| the shapes touch
        """

class ContactProperties:
    """
    What happens where two materials meet.

    Parameters
    ----------
    restitution : float
        e in [0, 1]: a contact that closes with gap rate u < 0 opens with -e u.
    friction : float
        Coulomb's mu >= 0.

    Raises
    ------
    ModelError
        On values out of their range.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore[assignment]
    def __eq__(self, other: ContactProperties) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        *,
        restitution: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        friction: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def friction(self) -> float: ...
    @property
    def restitution(self) -> float: ...

class JointEffects(enum.Flag):
    """
    What of a joint acts in steps; what does not is kept as information.

    limits
        A stop at each end of the range, without rebound unless its restitution says otherwise.
    damping
        Viscous damping, with armature and spring.
    friction
        Dry friction.
    motors
        Actuators on the joint, and the effort that they are limited to.
    all, none
        Members combine: `JointEffects.limits | JointEffects.damping`.
    """

    all = ...
    damping = ...
    friction = ...
    limits = ...
    motors = ...
    none = ...

class Wrench:
    """
    A force and a torque on a link, held over a step.

    Parameters
    ----------
    force, torque : array_like, shape (3,)
        [N], [N m]
    point : array_like, shape (3,)
        [m] where the force acts, in the link's frame.
    frame : {"world", "body"}
        Whose axes force and torque are in; those of the body turn with it.
    """
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        force: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = (0, 0, 0),
        torque: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = (0, 0, 0),
        *,
        point: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = (0, 0, 0),
        frame: str = "world",
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def force(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [N]
        """
    @property
    def frame(self) -> str: ...
    @property
    def point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m] in the link's frame
        """
    @property
    def torque(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [N m]
        """

class LoopType(enum.Enum):
    """
    What a loop holds of its two ends, frames on two links.

    `point`: their origins are one. `weld`: their axes as well. `distance`: their origins are a fixed
    distance apart. `on_plane`: the origin of a is on the plane through the origin of b that b's z axis
    is normal to. `coupling`: of two joints, see `add_coupling`. `prescribed`: of one, see `set_prescribed`.
    """

    coupling = ...
    distance = ...
    on_plane = ...
    point = ...
    prescribed = ...
    weld = ...

class At:
    """
    A frame on a link: where a spring or a loop is attached.

    Parameters
    ----------
    link : str
    p : array_like, shape (3,)
        [m] its origin in the link's frame.
    R : array_like, shape (3, 3), optional
        Its axes there; those of the link where not given.
    """
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        link: str,
        p: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = (0, 0, 0),
        R: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 3]"] | None = None,
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def R(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 3]"]: ...
    @property
    def link(self) -> str: ...
    @property
    def p(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m]
        """

class State:
    """
    The state of a model: a value. Keep it, compare it, go back to it.

    Its arrays are read-only. Made by `Model.state`, `Stepper.advance` and `Trajectory.state`.

    Parameters
    ----------
    t : float
        [s]
    q : array_like, shape (n_q,)
        [rad | m] coordinates; of ball joints a unit quaternion x y z w.
    p : array_like, shape (n_v,)
        [kg m^2/s | kg m/s] conjugate momenta, p = L_v.
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore[assignment]
    def __copy__(self) -> State: ...
    def __deepcopy__(self, memo: typing.Any) -> State: ...
    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        t: typing.SupportsFloat | typing.SupportsIndex,
        q: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"],
        p: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"],
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def p(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        [kg m^2/s | kg m/s] conjugate momenta, shape (n_v,)
        """
    @property
    def q(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        [rad | m] coordinates, shape (n_q,)
        """
    @property
    def t(self) -> float:
        """
        [s]
        """

class JointType(enum.Enum):
    """
    Kinds of joints and their coordinates.

    planar: x, y, yaw in the plane normal to the axis; spherical: a ball, whose coordinates are a unit
    quaternion x y z w and whose velocities are the angular velocity, both in the parent's axes;
    floating: x, y, z, then a ball; helical: turns and advances by `pitch`.
    """

    continuous = ...
    fixed = ...
    floating = ...
    helical = ...
    planar = ...
    prismatic = ...
    revolute = ...
    spherical = ...

class Coordinate:
    """
    A number of q and what the model's file says of it.

    Limits, damping and friction are kept for the user; the stepper does not apply them.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    @property
    def damping(self) -> float:
        """
        [N m s/rad | N s/m]
        """
    @property
    def effort(self) -> float:
        """
        [N m | N] limit, inf where there is none
        """
    @property
    def friction(self) -> float:
        """
        [N m | N]
        """
    @property
    def joint(self) -> str:
        """
        name of the joint that it belongs to
        """
    @property
    def lower(self) -> float:
        """
        [rad | m] limit, -inf where there is none
        """
    @property
    def name(self) -> str:
        """
        the joint's, `<joint>_x` ... where it has several
        """
    @property
    def unit(self) -> str:
        """
        "m", "rad", or "1" of a quaternion's numbers
        """
    @property
    def upper(self) -> float:
        """
        [rad | m] limit, inf where there is none
        """
    @property
    def velocity(self) -> float:
        """
        [rad/s | m/s] limit, inf where none
        """

class Mimic:
    """
    This joint's displacement is `multiplier * (displacement of joint) + offset`.

    Parameters
    ----------
    joint : str
        Name of the joint to follow; both have one coordinate.
    multiplier : float
    offset : float
        [rad | m]
    """
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        joint: str,
        multiplier: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        offset: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def joint(self) -> str: ...
    @property
    def multiplier(self) -> float: ...
    @property
    def offset(self) -> float:
        """
        [rad | m]
        """

class Link:
    """
    A rigid link of a model.

    It stands for its index wherever one is taken.
    """
    def __index__(self) -> int: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    @property
    def index(self) -> int:
        """
        in the model's `links`
        """
    @property
    def inertia(self) -> BodyInertia:
        """
        BodyInertia: mass [kg], centre of mass c_J [m] and inertia I_J [kg m^2] about it, in the link's frame
        """
    @property
    def mass(self) -> float:
        """
        [kg] its own, without links that are fixed to it
        """
    @property
    def name(self) -> str: ...

class JointInfo:
    """
    A joint of a model, as its author described it.

    It stands for its index in `joints` wherever one is taken.
    """
    def __index__(self) -> int: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    @property
    def X_PJ(self) -> Pose:
        """
        Pose of the joint's frame (the child link's at displacement 0) in the parent's
        """
    @property
    def axis(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"] | None:
        """
        unit, in the joint's frame, shape (3,); None without one
        """
    @property
    def child(self) -> str:
        """
        name of the child link
        """
    @property
    def coordinates(self) -> list[int]:
        """
        indices in q of those that move it
        """
    @property
    def index(self) -> int:
        """
        in the model's `joints`
        """
    @property
    def lower(self) -> float:
        """
        [rad | m] limit, -inf where there is none
        """
    @property
    def mimic(self) -> Mimic | None:
        """
        Mimic: which joint it follows; None for all others
        """
    @property
    def name(self) -> str: ...
    @property
    def parent(self) -> str:
        """
        name of the parent link
        """
    @property
    def pitch(self) -> float:
        """
        [m/rad] of a helical joint
        """
    @property
    def type(self) -> JointType: ...
    @property
    def upper(self) -> float:
        """
        [rad | m] limit, inf where there is none
        """
    @property
    def velocities(self) -> list[int]:
        """
        indices in v and p, likewise
        """

class TreeSolution:
    """
    How steps solve for the velocities of one tree, or of equal ones.

    Equal trees (pendulums of a cradle, bodies that fly alone) may be solved side by side, in lanes of
    vector instructions; `trees` says how many.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    @property
    def depth(self) -> int:
        """
        joints on the longest path from the root
        """
    @property
    def joints(self) -> int:
        """
        of one coordinate each, of one tree
        """
    @property
    def solver(self) -> TreeSolver:
        """
        TreeSolver.lu or TreeSolver.sweep
        """
    @property
    def trees(self) -> int:
        """
        equal ones in lanes; 1: this tree alone
        """

class Gaps:
    """
    Gaps of all m pairs of a model at one configuration.

    `p_WA - p_WB == phi * normal` for every pair. Arrays are read-only views, no copies.
    """
    def __len__(self) -> int: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    @property
    def names(self) -> list[str]:
        """
        "a ~ b", m of them
        """
    @property
    def normal(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
        """
        unit normals from b to a, shape (m, 3)
        """
    @property
    def p_WA(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
        """
        [m] witnesses on a, shape (m, 3)
        """
    @property
    def p_WB(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
        """
        [m] witnesses on b, shape (m, 3)
        """
    @property
    def phi(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        [m] shape (m,)
        """
    @property
    def phi_q(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        [m/rad | 1] shape (m, n_v)
        """
    @property
    def phi_qq(self) -> list[typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]]:
        """
        m arrays of shape (n_v, n_v)
        """

class TriangleMesh:
    """
    A surface of triangles, for pictures: it touches nothing.

    Its arrays are read-only.

    Parameters
    ----------
    vertices : array_like, shape (n, 3)
        [m]
    faces : array_like, shape (m, 3)
        Indices of vertices, counterclockwise seen from outside.

    Raises
    ------
    ModelError
        Where a vertex is not finite, or a face names one that is not there.
    """
    def __getstate__(self) -> tuple[numpy.ndarray, numpy.ndarray]: ...
    def __init__(
        self,
        vertices: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 3]"],
        faces: typing.Annotated[numpy.typing.ArrayLike, numpy.int32, "[m, 3]"],
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def faces(self) -> numpy.ndarray:
        """
        indices of vertices, shape (m, 3)
        """
    @property
    def vertices(self) -> numpy.ndarray:
        """
        [m] shape (n, 3)
        """

class Visual:
    """
    What a link looks like, or a part of it. It has no part in the motion.

    `model.pose(q, visual.link) * visual.X_LG` is where it is; `model.visuals` lists those of a model.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    @property
    def X_LG(self) -> Pose:
        """
        Pose of its frame in the link's
        """
    @property
    def kind(self) -> str:
        """
        "box", "sphere", ..., "mesh"
        """
    @property
    def link(self) -> str:
        """
        name of its link
        """
    @property
    def name(self) -> str:
        """
        as the file has it, "" where it has none
        """
    @property
    def rgba(self) -> typing.Annotated[list[float], "FixedSize(4)"]:
        """
        red, green, blue, opacity, each in [0, 1]
        """
    @property
    def shape(
        self,
    ) -> Sphere | Capsule | Box | Cylinder | HalfSpace | Ellipsoid | Convex | TriangleMesh:
        """
        a TriangleMesh, or one of the classes of `Shape`
        """

class SensorKind(enum.Enum):
    """
    What a sensor measures; names are MuJoCo's where it has one.

    jointpos, jointvel
        [rad | m], [rad/s | m/s] of a joint: one number, or all of a joint of several.
    actuatorfrc
        [N m | N] what an actuator pushes with, after its limits.
    framepos, framequat
        [m] where a point of a link is, in the world; how its frame is turned, x y z w.
    framelinvel, frameangvel
        [m/s], [rad/s] of that frame, in the world's axes.
    velocimeter, gyro
        The same in the frame's own axes.
    accelerometer
        [m/s^2] acceleration of the point less gravity, in the frame's own axes.
    touch
        [N] sum of the normal forces on a link.
    contactforce
        [N] sum of the contact forces on a link, friction included, in the world's axes.
    """

    accelerometer = ...
    actuatorfrc = ...
    contactforce = ...
    frameangvel = ...
    framelinvel = ...
    framepos = ...
    framequat = ...
    gyro = ...
    jointpos = ...
    jointvel = ...
    touch = ...
    velocimeter = ...

class Sensor:
    """
    What a model measures by name; made by `ModelBuilder.add_sensor`.
    """
    def __getstate__(self) -> tuple: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def X(self) -> Pose:
        """
        Pose in the link's frame
        """
    @property
    def kind(self) -> SensorKind: ...
    @property
    def name(self) -> str: ...
    @property
    def of(self) -> str:
        """
        the joint, the actuator, or the link that carries it
        """
    @property
    def other(self) -> str:
        """
        whose contacts count, "": all
        """

class Model:
    """
    A tree of rigid bodies: frozen, checked, cheap to copy.

    Made by `load_urdf` or `ModelBuilder.build`. Where a method takes coordinates, it takes an array of
    shape (n_q,) or a mapping from names to values, others being those of `neutral`; where it takes
    velocities, an array of shape (n_v,) or a mapping, others being 0. In both mappings the name of a
    joint with several numbers stands for all of them: `q={"base": Pose(...)}`, or a position and a
    quaternion, or a SciPy Rotation; `v={"base": ((1, 0, 0), (0, 0, 5))}`.
    """
    @staticmethod
    def _of_description(
        description: dict,
        *,
        collisions: bool = True,
        version: typing.SupportsInt | typing.SupportsIndex = 1,
    ) -> Model:
        """
        The model of `_description`; ModelError with the place of what is wrong in it.
        """
    def __copy__(self) -> Model: ...
    def __deepcopy__(self, memo: typing.Any) -> Model: ...
    def __getstate__(self) -> tuple: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    def __str__(self) -> str: ...
    def _description(self) -> dict:
        """
        All that the model is built of, as plain data: dicts by name, lists, numbers, arrays.
        """
    def _repr_html_(self) -> str: ...
    def accelerations(
        self,
        q: collections.abc.Mapping[str, typing.Any] | numpy.typing.ArrayLike | None,
        v: collections.abc.Mapping[str, numpy.typing.ArrayLike]
        | numpy.typing.ArrayLike
        | None = None,
        forces: collections.abc.Mapping[str, numpy.typing.ArrayLike]
        | numpy.typing.ArrayLike
        | None = None,
        *,
        t: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> numpy.typing.NDArray[numpy.float64]:
        """
        Accelerations: forward dynamics.

        Solves M(q) a + c(q, v) = forces + gravity_forces(q) + those of springs and potentials, c the forces
        of motion alone. Loops and couplings are kept closed and prescribed joints move as they are told:
        the right side has A lambda besides, A the gradients of the loops, so that A^T a is what that takes.
        Contacts, limits, damping, friction, motors and forces that are functions do not act. O(n) for deep
        trees, and one solve more for each row of a loop.

        Parameters
        ----------
        q : array_like, shape (n_q,) or (rows, n_q), or mapping of names to values
            [rad | m]
        v : array_like, shape (n_v,) or (rows, n_v), or mapping of names to values
            [rad/s | m/s] None: at rest.
        forces : array_like, shape (n_v,) or (rows, n_v), or mapping of names to values, optional
            [N m | N] on the coordinates; of free and ball joints in the parent's axes.
        t : float
            [s] of prescribed motions.

        Returns
        -------
        numpy.ndarray, shape (n_v,) or (rows, n_v)
            [rad/s^2 | m/s^2] the rates of v.

        Raises
        ------
        ModelError
            On an unknown name, a wrong shape, or a value that is not finite; where a loop is open at q, or
            opens with v; where a joint moves by a function that does not say the acceleration.
        StepError
            Where the mass matrix is singular, or loops hold no single motion.
        """
    def actuator_forces(
        self,
        q: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"],
        v: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"],
        control: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"],
    ) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        What actuators push with, after their limits and the joints'.

        Parameters
        ----------
        q : array_like, shape (rows, n_q)
            [rad | m]
        v : array_like, shape (rows, n_v)
            [rad/s | m/s]
        control : array_like, shape (rows, n_u)

        Returns
        -------
        numpy.ndarray, shape (rows, n_u)
            [N m | N] of each actuator, before its gear.

        Raises
        ------
        ModelError
            On shapes that do not fit.
        """
    def all_poses(
        self, q: collections.abc.Mapping[str, typing.Any] | numpy.typing.ArrayLike | None
    ) -> numpy.typing.NDArray[numpy.float64]:
        """
        Poses of all links, one pass a row.

        Parameters
        ----------
        q : array_like, shape (n_q,) or (rows, n_q), or mapping of names to values
            [rad | m]

        Returns
        -------
        numpy.ndarray, shape (links, 4, 4) or (rows, links, 4, 4)
            Homogeneous matrices, in the order of `links`.
        """
    def all_shape_poses(
        self, q: collections.abc.Mapping[str, typing.Any] | numpy.typing.ArrayLike | None
    ) -> numpy.typing.NDArray[numpy.float64]:
        """
        Poses of all shapes, one pass a row.

        Parameters
        ----------
        q : array_like, shape (n_q,) or (rows, n_q), or mapping of names to values
            [rad | m]

        Returns
        -------
        numpy.ndarray, shape (shapes, 4, 4) or (rows, shapes, 4, 4)
            Homogeneous matrices, in the order of `shapes`.
        """
    def at(
        self, q: collections.abc.Mapping[str, typing.Any] | numpy.typing.ArrayLike | None = None
    ) -> Frames:
        """
        The kinematics at one configuration, once: poses, Jacobians, dynamics.

        Parameters
        ----------
        q : array_like, shape (n_q,), or mapping of names to values, optional
            [rad | m]; coordinates that are not named are as in `neutral`.

        Returns
        -------
        Frames

        Examples
        --------
        >>> import saltus
        >>> model = saltus.load_urdf(saltus.urdf_dir() / "newtons_cradle_3.urdf")
        >>> frames = model.at({"swing_0": 0.3})
        >>> frames.jacobian("ball_0").shape
        (6, 3)
        """
    def builder(self) -> ModelBuilder:
        """
        A new builder that holds what this model was built of.

        To change a mass, a limit, a material, or to add to it, and build another model.

        Returns
        -------
        ModelBuilder
        """
    def centre_of_mass(
        self, q: collections.abc.Mapping[str, typing.Any] | numpy.typing.ArrayLike | None
    ) -> numpy.typing.NDArray[numpy.float64]:
        """
        Centre of mass of all that moves, in the world.

        Parameters
        ----------
        q : array_like, shape (n_q,) or (rows, n_q), or mapping of names to values
            [rad | m]

        Returns
        -------
        numpy.ndarray, shape (3,) or (rows, 3)
            [m]

        Raises
        ------
        ModelError
            Also where nothing that moves has mass.
        """
    def contact_properties(
        self, pair: typing.SupportsInt | typing.SupportsIndex
    ) -> ContactProperties:
        """
        ContactProperties of the materials that meet in the pair of this number.
        """
    def coordinate(self, name: str) -> int:
        """
        Index of a coordinate in q; ModelError with the names there are.
        """
    def difference(
        self,
        q0: collections.abc.Mapping[str, typing.Any] | numpy.typing.ArrayLike | None,
        q1: collections.abc.Mapping[str, typing.Any] | numpy.typing.ArrayLike | None,
    ) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        The dv with integrate(q0, dv) = q1, the shortest of them.

        It compares orientations: a quaternion and its negative are one, and differ by 0.

        Parameters
        ----------
        q0, q1 : array_like, shape (n_q,), or mapping of names to values
            [rad | m]

        Returns
        -------
        numpy.ndarray, shape (n_v,)
            [rad | m] at most pi for each ball.

        Raises
        ------
        ModelError
            As `state`.
        """
    def gaps(
        self, q: collections.abc.Mapping[str, typing.Any] | numpy.typing.ArrayLike | None
    ) -> Gaps:
        """
        Gaps phi of all pairs with their first and second partials.

        Partials are along velocities: `phi_q @ v` is the rate of phi, and `v @ phi_qq[i] @ v` its second
        derivative where q moves at the constant velocities v.

        Parameters
        ----------
        q : array_like, shape (n_q,), or mapping of names to values
            [rad | m]

        Returns
        -------
        Gaps
        """
    def gravity_forces(
        self, q: collections.abc.Mapping[str, typing.Any] | numpy.typing.ArrayLike | None
    ) -> numpy.typing.NDArray[numpy.float64]:
        """
        What gravity does to the coordinates.

        What is compensated of it (`set_gravity_compensation`) is left out. Holding the model still takes
        the opposite; where there are springs or potentials `inverse_dynamics(q)` has theirs, too.

        Parameters
        ----------
        q : array_like, shape (n_q,) or (rows, n_q), or mapping of names to values
            [rad | m]

        Returns
        -------
        numpy.ndarray, shape (n_v,) or (rows, n_v)
            [N m | N]
        """
    def integrate(
        self,
        q: collections.abc.Mapping[str, typing.Any] | numpy.typing.ArrayLike | None,
        dv: collections.abc.Mapping[str, numpy.typing.ArrayLike] | numpy.typing.ArrayLike | None,
    ) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        Coordinates after motion at constant velocities dv for 1 s.

        Adds dv to the coordinates of joints with one number each; turns a ball by the angle |w| about w, in
        its parent's axes.

        Parameters
        ----------
        q : array_like, shape (n_q,), or mapping of names to values
            [rad | m]
        dv : array_like, shape (n_v,), or mapping of names to values
            [rad | m]

        Returns
        -------
        numpy.ndarray, shape (n_q,)

        Raises
        ------
        ModelError
            As `state`.
        """
    def inverse_dynamics(
        self,
        q: collections.abc.Mapping[str, typing.Any] | numpy.typing.ArrayLike | None,
        v: collections.abc.Mapping[str, numpy.typing.ArrayLike]
        | numpy.typing.ArrayLike
        | None = None,
        a: collections.abc.Mapping[str, numpy.typing.ArrayLike]
        | numpy.typing.ArrayLike
        | None = None,
        *,
        t: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> numpy.typing.NDArray[numpy.float64]:
        """
        Forces that make given accelerations: inverse dynamics.

        M(q) a + c(q, v) - gravity_forces(q) less those of springs and potentials, by the recursion of
        Newton and Euler, O(n). At rest and without acceleration they are what holds the model up.

        Where there are loops, many forces make these accelerations, and the loops take what they differ by.
        Those that are returned are what loops do not take: M times accelerations that keep the loops
        closed. Of prescribed joints they are 0, as what moves these has the rest. `accelerations` makes of
        them the a that was given.

        Parameters
        ----------
        q : array_like, shape (n_q,) or (rows, n_q), or mapping of names to values
            [rad | m]
        v : array_like, shape (n_v,) or (rows, n_v), or mapping of names to values
            [rad/s | m/s] None: at rest.
        a : array_like, shape (n_v,) or (rows, n_v), or mapping of names to values
            [rad/s^2 | m/s^2] the rates of v. None: none.
        t : float
            [s] of prescribed motions.

        Returns
        -------
        numpy.ndarray, shape (n_v,) or (rows, n_v)
            [N m | N] on the coordinates; of free and ball joints in the parent's axes.

        Raises
        ------
        ModelError
            On an unknown name, a wrong shape, or a value that is not finite; where a loop is open at q, or
            opens with v or a; where a joint moves by a function that does not say the acceleration.
        """
    def jacobian(
        self,
        q: collections.abc.Mapping[str, typing.Any] | numpy.typing.ArrayLike | None,
        link: str | int | Link,
        point: numpy.typing.ArrayLike | None = None,
    ) -> numpy.typing.NDArray[numpy.float64]:
        """
        Jacobian J of a link: J v is its velocity.

        Rows are [angular; linear] in world axes: the angular velocity [rad/s] of the link and the velocity
        [m/s] of its frame's origin. With a point there are three rows, the velocity of that point. Columns
        are by velocity; of free and ball joints v is in the parent's axes, so that a free body's first six
        columns are those of its own velocity and angular velocity. J^T takes a wrench [moment about that
        point; force] to forces on the coordinates.

        Parameters
        ----------
        q : array_like, shape (n_q,) or (rows, n_q), or mapping of names to values
            [rad | m]
        link : str, int or Link
        point : array_like, shape (3,), optional
            [m] in the link's frame.

        Returns
        -------
        numpy.ndarray, shape (6, n_v), with a point (3, n_v)
            Of many rows (rows, 6, n_v) or (rows, 3, n_v).

        Raises
        ------
        ModelError
            On an unknown link, a wrong shape, or a value that is not finite.
        """
    def joint(self, name: str) -> JointInfo:
        """
        The JointInfo of this name; ModelError with the names there are.
        """
    def kinetic_energy(self, state: State) -> float:
        """
        [J] at this state.
        """
    def lagrangian(
        self,
        q: collections.abc.Mapping[str, typing.Any] | numpy.typing.ArrayLike | None,
        v: collections.abc.Mapping[str, numpy.typing.ArrayLike] | numpy.typing.ArrayLike | None,
        *,
        out: LagrangianPartials | None = None,
    ) -> LagrangianPartials:
        """
        L = T - V and all its first and second partials.

        V is that of gravity, less what is compensated, of springs, and of potentials that are functions.
        Partials by q are along velocities, of shape (n_v,). Of a ball they are along turns exp(eta) R about
        its parent's axes, with the angular velocity in these axes held: `L_q` is no force then (the torque
        is L_q + w x L_v), and `L_qq` is not symmetric within a ball.

        Parameters
        ----------
        q : array_like, shape (n_q,), or mapping of names to values
            [rad | m]
        v : array_like, shape (n_v,), or mapping of names to values
            [rad/s | m/s]
        out : LagrangianPartials, optional
            One of an earlier call, to be overwritten: what reads its arrays sees the new values. Of large
            models this saves most of the time.

        Returns
        -------
        LagrangianPartials
            `out` where it is given.

        Raises
        ------
        ModelError
            On an unknown name, a wrong shape, or a value that is not finite; where `out` is of another size.
        """
    def link(self, name: str) -> Link:
        """
        The Link of this name; ModelError with the names there are.
        """
    def loop_gaps(
        self,
        q: collections.abc.Mapping[str, typing.Any] | numpy.typing.ArrayLike | None,
        t: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> dict[str, typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]]:
        """
        How far each loop is open.

        Parameters
        ----------
        q : array_like, shape (n_q,), or mapping
        t : float
            [s] of prescribed motions.

        Returns
        -------
        dict of str to numpy.ndarray
            By loop, [m]; of a weld three of the position and three of the orientation (twice the vector of
            the quaternion: [rad] where small).
        """
    def mass_matrix(
        self, q: collections.abc.Mapping[str, typing.Any] | numpy.typing.ArrayLike | None
    ) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        M(q) = L_vv.

        Parameters
        ----------
        q : array_like, shape (n_q,), or mapping of names to values
            [rad | m]

        Returns
        -------
        numpy.ndarray, shape (n_v, n_v)
        """
    def momentum(
        self,
        q: collections.abc.Mapping[str, typing.Any] | numpy.typing.ArrayLike | None,
        v: collections.abc.Mapping[str, numpy.typing.ArrayLike] | numpy.typing.ArrayLike | None,
        *,
        about: numpy.typing.ArrayLike | None = None,
    ) -> numpy.typing.NDArray[numpy.float64]:
        """
        Momentum of all that moves, [angular; linear] in world axes.

        Parameters
        ----------
        q : array_like, shape (n_q,) or (rows, n_q), or mapping of names to values
            [rad | m]
        v : array_like, shape (n_v,) or (rows, n_v), or mapping of names to values
            [rad/s | m/s]
        about : array_like, shape (3,) or (rows, 3), optional
            [m] point in the world that the angular momentum is about; None: the world's origin. With
            `centre_of_mass(q)` it is the centroidal momentum.

        Returns
        -------
        numpy.ndarray, shape (6,) or (rows, 6)
            Angular momentum [kg m^2/s], momentum [kg m/s].
        """
    def neutral(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        Coordinates at rest: 0, but quaternions, which are the identity.

        Returns
        -------
        numpy.ndarray, shape (n_q,)
        """
    def normalized(
        self, q: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]
    ) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        Coordinates with their quaternions made of length 1.

        Parameters
        ----------
        q : array_like, shape (n_q,)

        Returns
        -------
        numpy.ndarray, shape (n_q,)

        Raises
        ------
        ModelError
            On a wrong shape, a value that is not finite, a quaternion of length 0.
        """
    def pair(self, pair: typing.SupportsInt | typing.SupportsIndex) -> Pair:
        """
        The pair of this number, from 0 to `n_pairs` - 1.
        """
    def pair_kinds(self) -> dict[tuple[str, str], int]:
        """
        How many pairs there are of each two kinds of shape, by their names in alphabetical order.
        """
    def pair_name(self, pair: typing.SupportsInt | typing.SupportsIndex) -> str:
        """
        Its name.
        """
    def pose(
        self,
        q: collections.abc.Mapping[str, typing.Any] | numpy.typing.ArrayLike | None,
        link: str | int | Link,
    ) -> Pose:
        """
        Pose of a link in the world; `Model::X_WL` in C++.

        Parameters
        ----------
        q : array_like, shape (n_q,), or mapping of names to values
            [rad | m]
        link : str or int
            Its name or index.

        Returns
        -------
        Pose
            Origin [m] and axes of the link's frame; `.matrix()` is the homogeneous matrix, shape (4, 4).

        Raises
        ------
        ModelError
            On an unknown link or coordinate, a wrong shape, or a value that is not finite.
        """
    def poses(
        self,
        q: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"],
        link: str | int | Link,
    ) -> numpy.typing.NDArray[numpy.float64]:
        """
        Poses of a link at many configurations.

        Parameters
        ----------
        q : array_like, shape (rows, n)
            [rad | m]
        link : str or int
            Its name or index.

        Returns
        -------
        numpy.ndarray, shape (rows, 4, 4)
            Homogeneous matrices.
        """
    def potential_energy(
        self, q: collections.abc.Mapping[str, typing.Any] | numpy.typing.ArrayLike | None
    ) -> float:
        """
        [J] of gravity, zero at the world's origin, and of springs and potentials.
        """
    def random_configuration(
        self, random: typing.Any = None
    ) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        Coordinates drawn at random.

        Quaternions are uniform over all orientations; others are uniform within their limits, and where
        there are none within +-pi rad and +-1 m.

        Parameters
        ----------
        random : int or numpy.random.Generator, optional
            Seed, or where numbers are drawn from.

        Returns
        -------
        numpy.ndarray, shape (n_q,)
        """
    def shape_poses(
        self, q: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"], shape: str | int
    ) -> numpy.typing.NDArray[numpy.float64]:
        """
        As `poses`, for the frame of a shape: its name or index.
        """
    def shape_velocities(
        self,
        q: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"],
        v: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"],
        shape: str | int,
    ) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        As `velocities`, for the frame of a shape: its name or index.
        """
    def state(
        self,
        q: collections.abc.Mapping[str, typing.Any] | numpy.typing.ArrayLike | None = None,
        v: collections.abc.Mapping[str, numpy.typing.ArrayLike]
        | numpy.typing.ArrayLike
        | None = None,
        t: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> State:
        """
        The state with these coordinates and velocities, p = M(q) v.

        Parameters
        ----------
        q : array_like, shape (n_q,), or mapping of names to values, or str
            [rad | m]; coordinates that are not named are as in `neutral`. The name of a state that the
            model has, `state_names`, stands for its coordinates, here and in all functions that take q.
        v : array_like, shape (n_v,), or mapping of names to values
            [rad/s | m/s]; of free and ball joints in the parent's axes. None: 0, or those of the named
            state.
        t : float
            [s]

        Returns
        -------
        State

        Raises
        ------
        ModelError
            On an unknown name, a wrong shape, a value that is not finite, a quaternion that is not of
            length 1 (to 1e-6; within that it is normalised).
        """
    def stiff_joints(
        self,
        h: typing.SupportsFloat | typing.SupportsIndex,
        q: collections.abc.Mapping[str, typing.Any] | numpy.typing.ArrayLike | None = None,
    ) -> list[str]:
        """
        Joints whose damping stops them within a step.

        They have z = h d (M^-1)_ii > 4, d the damping. The midpoint rule would turn their velocity round in
        each step; they get the rule that damps it (positions are of first order then). A smaller h, or less
        damping, makes them exact.

        Parameters
        ----------
        h : float
            [s] the step.
        q : array_like, shape (n_q,), or mapping, optional
            Where; `neutral()` if not given.

        Returns
        -------
        list of str

        Raises
        ------
        ModelError
            Where h is not positive.
        """
    def velocities(
        self,
        q: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"],
        v: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"],
        link: str | int | Link,
    ) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        Velocities of a link at many configurations.

        Parameters
        ----------
        q : array_like, shape (rows, n)
            [rad | m]
        v : array_like, shape (rows, n)
            [rad/s | m/s]
        link : str or int
            Its name or index.

        Returns
        -------
        numpy.ndarray, shape (rows, 6)
            Angular velocity [rad/s] and velocity of the link's origin [m/s], in world axes.
        """
    def velocity(
        self, state: State
    ) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        Velocities v = M(q)^-1 p of a state.

        Returns
        -------
        numpy.ndarray, shape (n_v,)
            [rad/s | m/s]

        Raises
        ------
        ModelError
            On a state that does not fit the model.
        StepError
            Where the mass matrix is singular.
        """
    def velocity_index(self, name: str) -> int:
        """
        Index of a velocity in v and p; ModelError with the names there are.
        """
    def without_collisions(self) -> Model:
        """
        A copy without any pair: bodies pass through each other.
        """
    @property
    def armature(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        [kg m^2 | kg] shape (n_v,)
        """
    @property
    def control_limits(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        range of each control, shape (n_u, 2)
        """
    @property
    def control_names(self) -> list[str]:
        """
        names of the actuators, in the order of controls
        """
    @property
    def coordinate_names(self) -> list[str]: ...
    @property
    def coordinates(self) -> list[Coordinate]: ...
    @property
    def damping(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        [N m s/rad | N s/m] that acts, shape (n_v,)
        """
    @property
    def default_contact(self) -> ContactProperties | None:
        """
        ContactProperties of all pairs that nothing else is said of; None where nothing is said
        """
    @property
    def friction(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        [N m | N] that acts, shape (n_v,)
        """
    @property
    def gravity(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m/s^2] shape (3,)
        """
    @property
    def joint_names(self) -> list[str]: ...
    @property
    def joints(self) -> list[JointInfo]: ...
    @property
    def limit_names(self) -> list[str]:
        """
        names of the joints' stops, which contacts and impacts may be at
        """
    @property
    def link_names(self) -> list[str]: ...
    @property
    def links(self) -> list[Link]: ...
    @property
    def loop_names(self) -> list[str]:
        """
        names of the loops and couplings, in the order of their rows
        """
    @property
    def n_pairs(self) -> int:
        """
        number of pairs
        """
    @property
    def n_q(self) -> int:
        """
        numbers in q: a ball joint has four
        """
    @property
    def n_u(self) -> int:
        """
        number of actuators
        """
    @property
    def n_v(self) -> int:
        """
        numbers in v and p: a ball joint has three
        """
    @property
    def name(self) -> str: ...
    @property
    def pair_names(self) -> list[str]:
        """
        "a ~ b" of every pair, "a[part] ~ b" where shapes have several
        """
    @property
    def pairs(self) -> list[Pair]:
        """
        a list of the pairs; at most 10^6 of them
        """
    @property
    def sensor_names(self) -> list[str]: ...
    @property
    def sensors(self) -> list[Sensor]:
        """
        what it measures by name, see `ModelBuilder.add_sensor`
        """
    @property
    def shapes(self) -> list[PlacedShape]: ...
    @property
    def solvers(self) -> list[TreeSolution]:
        """
        TreeSolutions: how its trees are solved
        """
    @property
    def source(self) -> str:
        """
        the URDF text it was read from, "" for a model built in code
        """
    @property
    def state_names(self) -> list[str]:
        """
        of states that `state` gives by name, see `ModelBuilder.add_state`
        """
    @property
    def velocity_names(self) -> list[str]: ...
    @property
    def visuals(self) -> list[Visual]:
        """
        what its links look like, for pictures
        """
    @property
    def warnings(self) -> list[str]:
        """
        what was understood but is not used
        """

class InertiaCheck(enum.Enum):
    """
    How far the inertia of a link may be from what a body can have.

    strict: not at all. lenient, as of files: with a warning, moments that are possible once none is
    changed by more than 2 % of the greatest, and moments without a mass of what is welded or fixed.
    as_given: moments may be anything.
    """

    as_given = ...
    lenient = ...
    strict = ...

class AdjacentLinks(enum.Enum):
    """
    Whether gaps are watched between links on both sides of one joint, which often overlap there.

    Default: excluded. Floating and planar joints do not make their links adjacent.
    """

    excluded = ...
    watched = ...

class ForceMoment:
    """
    When and where a force is asked for: the middle of an arc.

    Attributes
    ----------
    t : float
        [s]
    q : numpy.ndarray, shape (n_q,)
    v : numpy.ndarray, shape (n_v,)
        Read-only, both.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    @property
    def q(self) -> numpy.ndarray:
        """
        shape (n_q,)
        """
    @property
    def t(self) -> float: ...
    @property
    def v(self) -> numpy.ndarray:
        """
        shape (n_v,)
        """

class ModelBuilder:
    """
    Describes a model link by link; `build` checks it and makes the model.

    All methods return the builder, so that calls can be chained. Local mistakes raise ModelError at
    once; mistakes of the whole (unknown parents, cycles, joints that move no mass) raise it in `build`.

    Parameters
    ----------
    name : str
        Name of the model.
    root : str
        Name of the link that is fixed to the world; its frame is the world frame.
    """
    def __init__(self, name: str = "model", root: str = "world") -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def add(
        self,
        other: ModelBuilder | Model,
        prefix: str = "",
        *,
        parent: str | None = None,
        X: Pose = ...,
        own_materials: bool = False,
    ) -> ModelBuilder:
        """
        Copies another model into this one: two robots in one world.

        The other's root link is fixed to a link of this one. Half-spaces with the same plane are merged. A
        default contact that only one of the two has applies to both. Materials with the same name are the
        same material. Gravity and solver are those of this builder. A `Model` is added as it was built,
        with its collisions.

        Parameters
        ----------
        other : ModelBuilder or Model
            It is not changed.
        prefix : str
            Put before all names of the other: links, joints (and so coordinates), half-spaces, groups.
        parent : str, optional
            Link that carries the other's root link; default: the root link of this builder.
        X : Pose
            Pose of the other's root link in the parent's frame.
        own_materials : bool
            True: the other's materials get the prefix too, and so differ from those of this builder.

        Raises
        ------
        ModelError
            On duplicate names (the message proposes a prefix), on half-spaces that would move, and on
            contradictions in default contacts, contacts of materials, floors, or gaps between adjacent
            links. Nothing is added then.
        """
    def add_actuator(
        self,
        name: str,
        *,
        joints: collections.abc.Mapping[str, typing.SupportsFloat | typing.SupportsIndex],
        gain: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        bias: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"
        ] = (0.0, 0.0, 0.0),
        effort: typing.SupportsFloat | typing.SupportsIndex = ...,
        control: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(2)"
        ] = ...,
    ) -> ModelBuilder:
        """
        Adds an actuator that is affine in what it moves, as MuJoCo's `general`.

        With l the sum of ratio times coordinate over `joints` it pushes each joint by its ratio times
        `clip(gain clip(control) + bias[0] + bias[1] l + bias[2] dl/dt)`.

        Parameters
        ----------
        name : str
        joints : mapping of str to float
            Joints of one coordinate and their ratios.
        gain : float
        bias : (float, float, float)
        effort : float
            Of the force, before ratios, at most.
        control : (float, float), optional
            Range of the control; beyond it the nearest value acts.

        Returns
        -------
        ModelBuilder
            The builder itself.

        Raises
        ------
        ModelError
            As `add_motor`.
        """
    def add_body(
        self,
        name: str,
        shape: Sphere | Capsule | Box | Cylinder | HalfSpace | Ellipsoid | Convex,
        *,
        mass: typing.SupportsFloat | typing.SupportsIndex | None = None,
        density: typing.SupportsFloat | typing.SupportsIndex | None = None,
        X: Pose = ...,
        joint: JointType | str = ...,
        parent: str | None = None,
        joint_name: str | None = None,
        axis: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = (1, 0, 0),
    ) -> ModelBuilder:
        """
        Adds a homogeneous solid: a link, its shape and its joint.

        The three have the same frame, and the inertia follows from the shape (`solid_inertia`).

        Parameters
        ----------
        name : str
            Of the link.
        shape : Shape
        mass : float, optional
            [kg] give this or `density`; a body on a fixed joint may have neither.
        density : float, optional
            [kg/m^3]
        X : Pose
            Pose of the body in the parent link's frame at displacement 0.
        joint : JointType or str
            Floating: a free body. Fixed: the body moves with its parent; with the root it never moves.
        parent : str, optional
            Parent link; default: the root link. It may be added later.
        joint_name : str, optional
            Default: the body's name, so that the coordinates of a free body "cube" are "cube_x" and so on.
        axis : array_like, shape (3,)
            Of a joint with an axis, in the body's frame. `add_joint` has further properties of joints.

        Raises
        ------
        ModelError
            On duplicate names, a half-space, a size or mass that is not finite and positive, and if neither
            or both of mass and density are given. Nothing is added then.
        """
    def add_body_exclusion(self, link_a: str, link_b: str) -> ModelBuilder:
        """
        As `add_exclusion`, but half-spaces of these links stay watched.

        Parameters
        ----------
        link_a, link_b : str
        """
    def add_coupling(
        self,
        joint: str,
        *,
        of: str,
        polynomial: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex],
    ) -> ModelBuilder:
        """
        Makes the displacement of a joint a polynomial of another's.

        A joint that mimics another (`mimic`) is the same of degree 1, and costs nothing: it has no
        coordinate. The coupling is named "<joint> coupling" where loops are listed.

        Parameters
        ----------
        joint, of : str
            Both of one coordinate.
        polynomial : array_like
            Coefficients by rising powers: (0, 1, 0.1) is x + 0.1 x^2.

        Returns
        -------
        ModelBuilder
        """
    def add_exclusion(self, link_a: str, link_b: str) -> ModelBuilder:
        """
        Lets two links pass through each other: no gap is watched between them.

        Half-spaces belong to the root link.

        Parameters
        ----------
        link_a, link_b : str
        """
    def add_floor(
        self,
        name: str = "floor",
        *,
        normal: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = (0, 0, 1),
        offset: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        restitution: typing.SupportsFloat | typing.SupportsIndex | None = None,
        friction: typing.SupportsFloat | typing.SupportsIndex | None = None,
        material: str | None = None,
    ) -> ModelBuilder:
        """
        Adds the solid below the plane normal.x = offset, fixed to the world, of a material of its own.

        The first of these that is set gives restitution and friction of a floor and a body: `set_contact`
        of their two materials, this floor's own properties, `set_default_contact`.

        Parameters
        ----------
        name : str
            As in names of pairs.
        normal : array_like, shape (3,)
            Out of the solid, of any length but 0.
        offset : float
            [m]
        restitution, friction : float, optional
            Of contacts with all bodies without a `set_contact`. If only one of the two is given, the other
            is 0; if none is, the default contact applies.
        material : str, optional
            For `set_contact`; default: the floor's name.

        Raises
        ------
        ModelError
            On a duplicate name, a plane that already has a half-space, and values out of their range.
            Nothing is added then.
        """
    def add_force(
        self,
        name: str,
        function: collections.abc.Callable[[ForceMoment], typing.Any],
        *,
        coordinates: collections.abc.Sequence[str] = (),
    ) -> ModelBuilder:
        """
        Adds a force that is a function of t, q and v.

        The function is called inside each step, in the middle of each arc, several times: it must return
        the same for the same arguments. An exception in it ends the step, whose state stays as it was. The
        work of the force is part of `run.work["applied"]`. A model that has such a force cannot be
        pickled, nor added to another.

        Parameters
        ----------
        name : str
        function : callable
            `function(now)`, `now` a ForceMoment with t, q and v. Returns Q, an array of one number for each
            of `coordinates`, or the tuple `(Q, Q_q, Q_v)`, the last two of shape (coordinates, n_v) or
            None. Derivatives by q are along velocities, as in LagrangianPartials. With Q alone steps take
            more iterations, to the same answer.
        coordinates : sequence of str, optional
            Names of the velocities that it pushes, of a joint of one coordinate the joint's; all by
            default.

        Returns
        -------
        ModelBuilder
            The builder itself.

        Raises
        ------
        ModelError
            On a name that is taken; `build` on coordinates that do not exist. Steps where the function
            returns something else, or numbers that are not finite, and the first one of a model where Q_q
            or Q_v is not the derivative (`check_derivatives` looks at more places).
        """
    def add_group_exclusion(self, group_a: str, group_b: str) -> ModelBuilder:
        """
        Lets the links of two groups pass through each other.

        Parameters
        ----------
        group_a, group_b : str
            They may be the same group; its links then pass through each other.
        """
    def add_half_space(
        self,
        name: str,
        normal: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"],
        offset: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> ModelBuilder:
        """
        Adds the solid below the plane normal.x = offset, fixed to the world.

        Parameters
        ----------
        name : str
            As in names of pairs.
        normal : array_like, shape (3,)
            Out of the solid, of any length but 0.
        offset : float
            [m]
        """
    def add_joint(
        self,
        name: str,
        type: JointType | str,
        *,
        parent: str,
        child: str,
        X_PJ: Pose = ...,
        axis: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = (1, 0, 0),
        pitch: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        mimic: Mimic | None = None,
        lower: typing.SupportsFloat | typing.SupportsIndex = ...,
        upper: typing.SupportsFloat | typing.SupportsIndex = ...,
        velocity: typing.SupportsFloat | typing.SupportsIndex = ...,
        effort: typing.SupportsFloat | typing.SupportsIndex = ...,
        damping: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        friction: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> ModelBuilder:
        """
        Adds a joint between two links.

        Parameters
        ----------
        name : str
        type : JointType or str
        parent, child : str
            Links; they may be added later.
        X_PJ : Pose
            The joint's frame, which is the child's, in the parent link's frame at displacement 0.
        axis : array_like, shape (3,)
            In the joint's frame, of any length but 0.
        pitch : float
            [m/rad] helical joints only.
        mimic : Mimic, optional
            The joint that this one follows.
        lower, upper : float
            [rad | m] limits, which a step holds.
        velocity : float
            [rad/s | m/s] limit; for you to read, no step holds it.
        effort : float
            [N m | N] limit of what the joint's actuators push with.
        damping, friction : float
            [N m s/rad | N s/m], [N m | N]; viscous damping and dry friction, which act in a step.

        Raises
        ------
        ModelError
            On a duplicate name, a zero axis, limits in the wrong order, and NaN or infinite values.
        """
    def add_joint_spring(
        self,
        joint: str,
        *,
        stiffness: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        rest: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        curve: tuple[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex],
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex],
        ]
        | None = None,
        slopes: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(2)"
        ]
        | None = None,
    ) -> ModelBuilder:
        """
        Adds a spring to a joint of one coordinate, or replaces it.

        Either V = stiffness (q - rest)^2 / 2, or a curve: the spring resists with `forces` at the
        displacements `angles`, with a cubic spline between them and a line beyond its ends. V is the
        integral of the curve from its first point, so that the joint feels minus the curve.

        Parameters
        ----------
        joint : str
        stiffness : float
            [N m/rad | N/m] at least 0.
        rest : float
            [rad | m]
        curve : tuple of two array_like, shape (k,), optional
            `(angles, forces)`, [rad | m] ascending and [N m | N]; k is 2 at least.
        slopes : tuple of two floats, optional
            [N m/rad | N/m] of the curve at its ends. Without them the ends are natural: not bent.

        Returns
        -------
        ModelBuilder
            The builder itself.

        Raises
        ------
        ModelError
            On a joint that does not exist or has several coordinates, numbers that are negative or not
            finite, angles that do not ascend.
        """
    def add_link(
        self, name: str, inertia: BodyInertia = ..., *, check: InertiaCheck | str = ...
    ) -> ModelBuilder:
        """
        Adds a link.

        Parameters
        ----------
        name : str
        inertia : BodyInertia
            In the link's frame; without it the link has no mass.
        check : InertiaCheck or str
            How far it may be from what a body can have.

        Raises
        ------
        ModelError
            On a duplicate name and on an inertia that no body can have.
        """
    def add_loop(
        self,
        name: str,
        type: LoopType | str,
        *,
        a: At | str,
        b: At | str,
        distance: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> ModelBuilder:
        """
        Holds two links together beyond the tree, as the last pin of a four-bar.

        The loop is exact: a step ends with it closed to rounding, impacts respect it, and its forces are
        in `Stepper.report.loops`. Loops that say the same twice share the load. No gap is watched
        between links that a `point` or `weld` holds together. A run starts from a configuration that
        closes all loops: `close_loops` finds one. (RATTLE, as Hairer, Lubich, Wanner, VII.1.)

        Parameters
        ----------
        name : str
        type : LoopType or str
            "point", "weld", "distance" or "on_plane".
        a, b : At or str
            Its ends, frames on two links, or links for their own frames.
        distance : float
            [m] of type "distance".

        Returns
        -------
        ModelBuilder

        Raises
        ------
        ModelError
            On a name that another loop has, ends on one link, and a distance that is none.
        """
    def add_motor(
        self,
        name: str,
        *,
        joint: str,
        gear: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        effort: typing.SupportsFloat | typing.SupportsIndex = ...,
    ) -> ModelBuilder:
        """
        Adds a motor; the control is its torque [N m], or force [N].

        Parameters
        ----------
        name : str
        joint : str
            Of one coordinate.
        gear : float
            The joint gets `gear` times the motor's torque.
        effort : float
            Of the motor at most; it is also the range of the control.

        Returns
        -------
        ModelBuilder
            The builder itself.

        Raises
        ------
        ModelError
            On a joint that does not exist or has several coordinates, a name that is taken, an effort that
            is not positive.
        """
    def add_position_servo(
        self,
        name: str,
        *,
        joint: str,
        kp: typing.SupportsFloat | typing.SupportsIndex,
        kd: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        effort: typing.SupportsFloat | typing.SupportsIndex = ...,
    ) -> ModelBuilder:
        """
        Adds a servo, kp (control - q) - kd v; the control is the position to reach.

        The servo acts inside the step, which is stable at any gain that rounding leaves sense: kp h^2 and
        kd h up to 1e12 times what they move.

        Parameters
        ----------
        name : str
        joint : str
            Of one coordinate.
        kp : float
            [N m/rad | N/m]
        kd : float
            [N m s/rad | N s/m]
        effort : float
            [N m | N] at most.

        Returns
        -------
        ModelBuilder
            The builder itself.

        Raises
        ------
        ModelError
            As `add_motor`.
        """
    def add_potential(
        self,
        name: str,
        value: collections.abc.Callable[
            [typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]], typing.Any
        ],
        gradient: collections.abc.Callable[
            [typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]], typing.Any
        ],
        hessian: collections.abc.Callable[
            [typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]], typing.Any
        ],
    ) -> ModelBuilder:
        """
        Adds a potential V(q), by three functions of q.

        It is part of the Lagrangian: of `lagrangian`, the energies, `inverse_dynamics`, and of steps, which
        conserve the energy with it. The law `compensated` needs third derivatives and refuses it. A model
        that has one cannot be pickled, nor added to another.

        Parameters
        ----------
        name : str
        value : callable
            q (n_q,) to V [J].
        gradient : callable
            q to the derivatives of V along velocities, shape (n_v,) [N m | N].
        hessian : callable
            q to the derivatives of the gradient along velocities, shape (n_v, n_v).

        Returns
        -------
        ModelBuilder
            The builder itself.

        Raises
        ------
        ModelError
            On a name that is taken. Whatever asks for the potential, where a function returns another
            shape, or numbers that are not finite; the first step of a model, and `equilibrium`, where
            gradient or Hessian is not the derivative (`check_derivatives` looks at more places).
        """
    def add_sensor(
        self,
        name: str,
        kind: SensorKind | str,
        *,
        joint: str | None = None,
        actuator: str | None = None,
        link: str | None = None,
        other: str | None = None,
        X: Pose = ...,
    ) -> ModelBuilder:
        """
        Adds a sensor: `run.sensor(name)` reads it from recorded rows.

        It has no part in the motion. A policy has it as `now.sensors[name]`.

        Parameters
        ----------
        name : str
        kind : SensorKind or str
        joint : str, optional
            Of jointpos and jointvel.
        actuator : str, optional
            Of actuatorfrc.
        link : str, optional
            Of all others: the link that carries it.
        other : str, optional
            Of touch and contactforce: the link or half-space whose contacts count; None: all.
        X : Pose
            Where on the link it is, and how it is turned; of touch and contactforce it has no meaning.

        Returns
        -------
        ModelBuilder
            The builder itself.

        Raises
        ------
        ModelError
            On a name that is taken, and on what it is of where that does not exist or is of another kind.

        Examples
        --------
        >>> import saltus
        >>> builder = saltus.ModelBuilder()
        >>> builder = builder.add_body("stone", saltus.Sphere(0.1), mass=1.0)
        >>> model = builder.add_sensor("imu", "accelerometer", link="stone").build()
        >>> model.sensors
        [Sensor('imu', accelerometer of link 'stone')]
        """
    def add_shape(
        self,
        link: str,
        shape: Sphere | Capsule | Box | Cylinder | HalfSpace | Ellipsoid | Convex,
        X_LG: Pose = ...,
    ) -> ModelBuilder:
        """
        Adds a collision shape.

        It has the name of its link; the second shape of a link has "#2" added, and so on.

        Parameters
        ----------
        link : str
        shape : Shape
        X_LG : Pose
            The shape's frame in the link's frame.

        Raises
        ------
        ModelError
            On sizes that are not finite and positive, and on a half-space of a link other than the root.
        """
    def add_spring(
        self,
        name: str,
        *,
        a: At | str,
        b: At | str,
        stiffness: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        length: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        damping: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> ModelBuilder:
        """
        Adds a spring and a damper side by side between two points.

        With d the distance of the points, V = stiffness (d - length)^2 / 2, and the damper pulls with
        -damping dd/dt along the line between them. The spring is a potential: it is in `lagrangian`, in the
        energies and in `inverse_dynamics`. The damper acts in steps, and its work is part of
        `run.work["damping"]`.

        Parameters
        ----------
        name : str
        a, b : At or str
            A point of a link, or a link for its origin; of two bodies.
        stiffness : float
            [N/m] at least 0.
        length : float
            [m] where the spring pulls no more. A spring of length 0 is smooth where its ends meet; of any
            other the force has no direction there, and a step that comes to it is a StepError.
        damping : float
            [N s/m] at least 0.

        Returns
        -------
        ModelBuilder
            The builder itself.

        Raises
        ------
        ModelError
            On a link that does not exist, a number that is negative or not finite, a name that is taken;
            `build` where both points are on one body.
        """
    def add_state(
        self,
        name: str,
        q: collections.abc.Mapping[str, typing.Any] | None = None,
        v: collections.abc.Mapping[str, typing.Any] | None = None,
    ) -> ModelBuilder:
        """
        Adds a state by name, as MuJoCo's keyframes and SRDF's group states.

        `model.state("home")` gives it, and wherever a function takes `q` it takes the name.

        Parameters
        ----------
        name : str
        q : mapping of joints' names to values, optional
            [rad | m] one number, or for joints of several a sequence or a Pose. Other joints are as in
            `Model.neutral`.
        v : mapping of joints' names to values, optional
            [rad/s | m/s] 0 of other joints.

        Returns
        -------
        ModelBuilder
            The builder itself.

        Raises
        ------
        ModelError
            On a name that is taken, joints that do not exist, are fixed or mimic others, values that are
            not finite, too many, or outside of limits that act.

        Examples
        --------
        >>> import saltus
        >>> builder = saltus.read_urdf(saltus.urdf_dir() / "newtons_cradle_3.urdf")
        >>> model = builder.add_state("lifted", q={"swing_0": 0.3}).build()
        >>> float(model.state("lifted").q[0])
        0.3
        """
    def add_velocity_servo(
        self,
        name: str,
        *,
        joint: str,
        kv: typing.SupportsFloat | typing.SupportsIndex,
        effort: typing.SupportsFloat | typing.SupportsIndex = ...,
    ) -> ModelBuilder:
        """
        Adds a servo, kv (control - v); the control is the rate to reach.

        Parameters
        ----------
        name : str
        joint : str
            Of one coordinate.
        kv : float
            [N m s/rad | N s/m]
        effort : float
            [N m | N] at most.

        Returns
        -------
        ModelBuilder
            The builder itself.

        Raises
        ------
        ModelError
            As `add_motor`.
        """
    def add_visual(
        self,
        link: str,
        shape: Sphere | Capsule | Box | Cylinder | HalfSpace | Ellipsoid | Convex | TriangleMesh,
        X_LG: Pose = ...,
        *,
        rgba: typing.Annotated[
            collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(4)"
        ] = (0.7, 0.7, 0.7, 1),
        name: str = "",
    ) -> ModelBuilder:
        """
        Adds what a link looks like, or a part of it; it touches nothing.

        Parameters
        ----------
        link : str
        shape : Shape or TriangleMesh
        X_LG : Pose
            Its frame in the link's frame.
        rgba : array_like, shape (4,)
            Red, green, blue and opacity, each in [0, 1].
        name : str

        Raises
        ------
        ModelError
            On sizes that are not finite and positive, a half-space, and numbers that are no colour.
        """
    def add_warning(self, text: str) -> ModelBuilder:
        """
        Adds to the model's `warnings`; returns the builder.
        """
    def build(self) -> Model:
        """
        Checks the description and makes the model.

        Returns
        -------
        Model
            Its `warnings` are also issued as `ModelWarning`.

        Raises
        ------
        ModelError
            With `element` and `name` of the culprit.
        """
    def check(self) -> None:
        """
        The checks of `build` alone; raises ModelError.
        """
    def joint(self, name: str) -> BuilderJoint:
        """
        A joint by name, to read and to change.

        Parameters
        ----------
        name : str

        Returns
        -------
        BuilderJoint

        Raises
        ------
        ModelError
            On an unknown name; lists the names there are.
        """
    def link(self, name: str) -> BuilderLink:
        """
        A link by name, to read and to change.

        Parameters
        ----------
        name : str

        Returns
        -------
        BuilderLink

        Raises
        ------
        ModelError
            On an unknown name; lists the names there are.

        Examples
        --------
        >>> import saltus
        >>> builder = saltus.read_urdf(saltus.urdf_dir() / "newtons_cradle_3.urdf")
        >>> builder.link("ball_0").mass = 2.0
        >>> builder.build().link("ball_0").mass
        2.0
        """
    def set_adjacent_links(self, adjacent: AdjacentLinks | str) -> ModelBuilder:
        """
        Sets whether links on both sides of one joint may collide.

        Links that are welded together never collide.

        Parameters
        ----------
        adjacent : AdjacentLinks or str
        """
    def set_armature(
        self, joint: str, armature: typing.SupportsFloat | typing.SupportsIndex
    ) -> ModelBuilder:
        """
        [kg m^2 | kg] of a motor's rotor, as the joint feels it; returns the builder.
        """
    def set_contact(
        self,
        material_a: str,
        material_b: str,
        *,
        restitution: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        friction: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> ModelBuilder:
        """
        Sets restitution and friction of two materials; the last call applies.

        Parameters
        ----------
        material_a, material_b : str
            In any order; they may be the same.
        restitution : float
            e in [0, 1]: a contact that closes with gap rate u < 0 opens with -e u.
        friction : float
            Coulomb's mu >= 0: the friction force is at most mu times the normal force.

        Raises
        ------
        ModelError
            On values out of their range; `build` raises it on materials that no link has.
        """
    def set_damping(
        self, joint: str, damping: typing.SupportsFloat | typing.SupportsIndex
    ) -> ModelBuilder:
        """
        [N m s/rad | N s/m] viscous; returns the builder. Of a floating or spherical joint it acts on the angular velocity.
        """
    def set_default_contact(
        self,
        *,
        restitution: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        friction: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> ModelBuilder:
        """
        Sets restitution and friction of all pairs for which nothing else is set.

        `set_contact` of their materials takes precedence, then the properties of a floor (`add_floor`). The
        default is elastic and frictionless. Parameters as in `set_contact`.
        """
    def set_effects(self, effects: JointEffects | str, joint: str | None = None) -> ModelBuilder:
        """
        Sets what of joints acts in steps.

        Parameters
        ----------
        effects : JointEffects or str
        joint : str, optional
            None: all joints that there are now.

        Returns
        -------
        ModelBuilder
            The builder itself.
        """
    def set_friction(
        self, joint: str, friction: typing.SupportsFloat | typing.SupportsIndex
    ) -> ModelBuilder:
        """
        [N m | N] dry; returns the builder.
        """
    def set_gravity(
        self, gravity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]
    ) -> ModelBuilder:
        """
        Sets gravity; default: (0, 0, -9.81).

        Parameters
        ----------
        gravity : array_like, shape (3,)
            [m/s^2]
        """
    def set_gravity_compensation(
        self, link: str, part: typing.SupportsFloat | typing.SupportsIndex = 1.0
    ) -> ModelBuilder:
        """
        Something carries a part of a link's weight.

        Gravity pulls at the rest alone: V = -(1 - part) m g.c. The inertia stays. `gravity_forces`, the
        energies and steps have it.

        Parameters
        ----------
        link : str
        part : float
            1 is all of it, 0 nothing.

        Returns
        -------
        ModelBuilder
            The builder itself.

        Raises
        ------
        ModelError
            On a link that does not exist, or a part that is not finite.
        """
    def set_group(self, link: str, group: str) -> ModelBuilder:
        """
        Puts a link into a group; a link is in one group at most.

        Parameters
        ----------
        link : str
        group : str
            Any name, for `add_group_exclusion`.
        """
    def set_limit(
        self,
        joint: str,
        lower: typing.SupportsFloat | typing.SupportsIndex,
        upper: typing.SupportsFloat | typing.SupportsIndex,
        *,
        restitution: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> ModelBuilder:
        """
        Sets the range of a joint of one coordinate.

        Parameters
        ----------
        joint : str
        lower, upper : float
            [rad | m] infinite where there is no limit.
        restitution : float
            At the stops, in [0, 1].

        Returns
        -------
        ModelBuilder
            The builder itself.

        Raises
        ------
        ModelError
            On a joint that does not exist or has several coordinates, lower > upper, a restitution outside
            of [0, 1].
        """
    def set_material(self, link: str, material: str) -> ModelBuilder:
        """
        Sets the material of all shapes of a link; `set_contact` gives it its properties.

        Parameters
        ----------
        link : str
            The root link's material is that of its half-spaces too; `add_floor` gives a floor its own.
        material : str
            Any name.
        """
    def set_prescribed(
        self,
        joint: str,
        times: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] | None = None,
        values: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] | None = None,
        *,
        function: collections.abc.Callable[[float], typing.Any] | None = None,
    ) -> ModelBuilder:
        """
        Makes a joint move as it is told, whatever that takes.

        The joint goes by a cubic spline through the values, whose ends are not bent and go on as lines, or
        by a function. Its arcs go by the secant of the motion, its rate at nodes is that of the motion.
        Impacts find it infinitely heavy. What moves it does work: part of `run.work["applied"]`. A run
        starts where the motion is: `close_loops(model, t=t)` gives that state. The joint is named "<joint>
        prescribed" where loops are listed.

        Parameters
        ----------
        joint : str
            Of one coordinate. The link that it moves may be without mass of
            its own, where what hangs on it leaves the mass matrix regular.
        times, values : array_like, shape (k,), optional
            [s] ascending, [rad | m]; k is 2 at least.
        function : callable, optional
            function(t) returns the displacement [rad | m] and its rate, or the acceleration as well, which
            `accelerations` and `inverse_dynamics` ask for. A model that has one cannot be pickled, and files
            do not hold it.

        Returns
        -------
        ModelBuilder
        """
    def set_solver(self, solver: TreeSolver | str) -> ModelBuilder:
        """
        Sets the linear solver of the steps, for all trees.

        It changes the speed, and results by rounding only. The default, TreeSolver.automatic, depends on
        the shape of each tree; `Model.solvers` has the solvers in use.

        Parameters
        ----------
        solver : TreeSolver or str
        """
    @property
    def joint_names(self) -> list[str]: ...
    @property
    def link_names(self) -> list[str]: ...
    @property
    def warnings(self) -> list[str]: ...

class BuilderLink:
    """
    A link of a builder: what is set here is checked and kept at once.

    Made by `ModelBuilder.link`. Models that were built before do not change.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    @property
    def inertia(self) -> BodyInertia:
        """
        BodyInertia: mass, centre of mass and inertia about it, in the link's frame
        """
    @inertia.setter
    def inertia(self, arg1: BodyInertia) -> None: ...
    @property
    def mass(self) -> float:
        """
        [kg] When it is set the centre of mass stays, and the inertia about it grows with it
        """
    @mass.setter
    def mass(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def material(self) -> str | None:
        """
        what its shapes are made of, see `set_contact`; None where nothing is said
        """
    @material.setter
    def material(self, arg1: str) -> None: ...
    @property
    def name(self) -> str: ...

class BuilderJoint:
    """
    A joint of a builder: what is set here is checked and kept at once.

    Made by `ModelBuilder.joint`. Models that were built before do not change.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    @property
    def X_PJ(self) -> Pose:
        """
        Pose of the joint's frame in the parent link's
        """
    @X_PJ.setter
    def X_PJ(self, arg0: Pose) -> None: ...
    @property
    def axis(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        in the joint's frame, of any length but 0, shape (3,)
        """
    @axis.setter
    def axis(
        self, arg0: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]
    ) -> None: ...
    @property
    def child(self) -> str: ...
    @property
    def damping(self) -> float:
        """
        [N m s/rad | N s/m]
        """
    @damping.setter
    def damping(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def effort(self) -> float:
        """
        [N m | N] limit, inf where there is none
        """
    @effort.setter
    def effort(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def friction(self) -> float:
        """
        [N m | N]
        """
    @friction.setter
    def friction(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def lower(self) -> float:
        """
        [rad | m] limit, -inf where there is none
        """
    @lower.setter
    def lower(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def mimic(self) -> Mimic | None:
        """
        Mimic or None
        """
    @mimic.setter
    def mimic(self, arg0: Mimic | None) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def parent(self) -> str: ...
    @property
    def pitch(self) -> float:
        """
        [m/rad] helical joints only
        """
    @pitch.setter
    def pitch(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def type(self) -> JointType: ...
    @property
    def upper(self) -> float:
        """
        [rad | m] limit, inf where there is none
        """
    @upper.setter
    def upper(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def velocity(self) -> float:
        """
        [rad/s | m/s] limit, inf where there is none
        """
    @velocity.setter
    def velocity(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class Frames:
    """
    A model at one configuration: its kinematics once, then what follows.

    Made by `Model.at`. `set` moves it on without new memory, which a loop over configurations wants; to
    have many at once, the methods of `Model` take arrays of shape (rows, n_q). World axes and
    [angular; linear] throughout. Not for two threads at once.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def accelerations(
        self,
        v: collections.abc.Mapping[str, numpy.typing.ArrayLike]
        | numpy.typing.ArrayLike
        | None = None,
        forces: collections.abc.Mapping[str, numpy.typing.ArrayLike]
        | numpy.typing.ArrayLike
        | None = None,
        *,
        t: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        As `Model.accelerations`, here.

        Parameters
        ----------
        v : array_like, shape (n_v,), or mapping of names to values
            [rad/s | m/s]
        forces : array_like, shape (n_v,), or mapping of names to values, optional
            [N m | N]
        t : float
            [s] of prescribed motions.

        Returns
        -------
        numpy.ndarray, shape (n_v,)
        """
    def all_poses(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Homogeneous matrices of all links, shape (links, 4, 4).
        """
    def all_shape_poses(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Homogeneous matrices of all shapes, shape (shapes, 4, 4).
        """
    def centre_of_mass(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        [m] of all that moves, in the world, shape (3,).
        """
    def gaps(self) -> Gaps:
        """
        Gaps of all pairs, as `Model.gaps`.
        """
    def gravity_forces(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        What gravity does to the coordinates [N m | N], shape (n_v,); see `Model`.
        """
    def inverse_dynamics(
        self,
        v: collections.abc.Mapping[str, numpy.typing.ArrayLike]
        | numpy.typing.ArrayLike
        | None = None,
        a: collections.abc.Mapping[str, numpy.typing.ArrayLike]
        | numpy.typing.ArrayLike
        | None = None,
        *,
        t: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        As `Model.inverse_dynamics`, here.

        Parameters
        ----------
        v : array_like, shape (n_v,), or mapping of names to values
            [rad/s | m/s]
        a : array_like, shape (n_v,), or mapping of names to values
            [rad/s^2 | m/s^2]
        t : float
            [s] of prescribed motions.

        Returns
        -------
        numpy.ndarray, shape (n_v,)
        """
    def jacobian(
        self, link: str | int | Link, point: numpy.typing.ArrayLike | None = None
    ) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        As `Model.jacobian`, here.

        Parameters
        ----------
        link : str, int or Link
        point : array_like, shape (3,), optional
            [m] in the link's frame.

        Returns
        -------
        numpy.ndarray, shape (6, n_v), with a point (3, n_v)
        """
    def mass_matrix(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        M(q), shape (n_v, n_v).
        """
    def momentum(
        self,
        v: collections.abc.Mapping[str, numpy.typing.ArrayLike] | numpy.typing.ArrayLike | None,
        *,
        about: numpy.typing.ArrayLike | None = None,
    ) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[6, 1]"]:
        """
        As `Model.momentum`, here.

        Parameters
        ----------
        v : array_like, shape (n_v,), or mapping of names to values
            [rad/s | m/s]
        about : array_like, shape (3,), optional
            [m] point in the world; None: its origin.

        Returns
        -------
        numpy.ndarray, shape (6,)
        """
    def pose(self, link: str | int | Link) -> Pose:
        """
        Pose of a link in the world.

        Parameters
        ----------
        link : str, int or Link

        Returns
        -------
        Pose
        """
    def set(
        self, q: collections.abc.Mapping[str, typing.Any] | numpy.typing.ArrayLike | None
    ) -> Frames:
        """
        Moves to another configuration and returns itself.

        Parameters
        ----------
        q : array_like, shape (n_q,), or mapping of names to values
            [rad | m]

        Returns
        -------
        Frames
        """
    def shape_pose(self, shape: str | int) -> Pose:
        """
        Pose of a shape in the world.

        Parameters
        ----------
        shape : str or int
            Its name, as in pairs, or index.

        Returns
        -------
        Pose
        """
    @property
    def mass(self) -> float:
        """
        [kg] of all that moves
        """
    @property
    def model(self) -> Model: ...
    @property
    def q(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        [rad | m] shape (n_q,)
        """

class MeshUse(enum.Enum):
    """
    What becomes of collision meshes: convex solids around them, or nothing.
    """

    hull = ...
    none = ...

class InertiaUse(enum.Enum):
    """
    Where the inertias of a file's links come from.

    checked: from the file; moments that no body can have are refused, unless a change of 2 % of the
    greatest makes them possible, which is a warning. as_given: from the file, whatever they are.
    from_shapes: so, too, and links without a mass get that of their collision shapes, or where there are
    none of their visuals, filled with water (1000 kg/m^3); a mesh is filled to its convex hull.
    """

    as_given = ...
    checked = ...
    from_shapes = ...

class ImpactLaw(enum.IntEnum):
    """
    Which energy an impact conserves.

    nodal_energy
        H(q, p+) = H(q, p-) at the impact, lambda = -2u/G in closed form; always solvable.
    discrete_energy
        that of the arcs on both sides, (11c); the step is exactly symplectic.
    shadow_energy
        H - h^2 kappa / 24 at both ends of the step, which steps without impacts conserve.
    compensated
        (11c) of arcs with L + (h^2 - tau^2) kappa / 24; exactly symplectic, energy of order h^4.
    custom
        a function that was given as the law.

    (11c) is Seghete and Murphey, "Multiple Instantaneous Collisions in a Variational Framework".
    """

    compensated = ...
    custom = ...
    discrete_energy = ...
    nodal_energy = ...
    shadow_energy = ...

class ImpactOrder(enum.Enum):
    """
    Which of the approaching contacts is next.

    fastest: the most negative u / sqrt(G), ties go to the lowest index. index: the lowest index.
    symmetric: all of them together, a reflection in the nearest face of their cone; keeps mirror
    symmetry (D. Kaufman et al., "Reflections on Simultaneous Impact", SIGGRAPH 2012).
    """

    fastest = ...
    index = ...
    symmetric = ...

class ImpactProblem:
    """
    An impact, as a custom law sees it: all closed contacts.

    Attributes
    ----------
    t : float
        [s]
    q : numpy.ndarray, shape (n_q,)
    p, v : numpy.ndarray, shape (n_v,)
        Before the impact; v = M^-1 p.
    M : numpy.ndarray, shape (n_v, n_v)
        Mass matrix at q.
    N : numpy.ndarray, shape (m, n_v)
        Rows are gradients of the gaps.
    u : numpy.ndarray, shape (m,)
        [m/s] gap rates N v, negative for an approaching contact.
    restitution, friction : numpy.ndarray, shape (m,)
        Of each pair's materials.
    pairs : list of int
        Indices of the pairs, as in `Model.pair_name`.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    @property
    def M(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]: ...
    @property
    def N(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]: ...
    @property
    def friction(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...
    @property
    def p(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...
    @property
    def pairs(self) -> list[int]: ...
    @property
    def q(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...
    @property
    def restitution(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...
    @property
    def t(self) -> float: ...
    @property
    def u(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...
    @property
    def v(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...

class StepOptions:
    """
    Options of a step.

    Parameters
    ----------
    h : float
        [s] time step.
    law : ImpactLaw, str or callable
        A callable takes an `ImpactProblem` and returns the momenta after, shape (n_v,).
    collisions : bool
        False: bodies pass through each other.
    order : ImpactOrder or str
        Which of several approaching contacts takes the next impulse.
    certify : bool
        Reports for each impact on several contacts whether its outcome is unique (`classify_impact`).
    max_iterations : int
        Newton iterations per arc; 2 to 4 are usual.
    max_impacts : int
        Impacts per step; with more a body bounces faster than h can follow. Also the bound of arcs
        without an impact, but at most 100 of these.
    max_halvings : int
        How often a failed step is repeated with arcs of half the duration: by default down to h / 64;
        0: never. `StepReport.fallbacks` reports it.
    max_impulses : int
        Impulses per impact.
    rest : float
        A contact with a gap rate below this fraction of sqrt(2 E G) is at rest, not approaching.
    simultaneous : float
        A contact that would close within this part of h joins an impact.
    strict : bool
        True: a step that neither whole nor halved arcs make is a `StepError`. Else its contacts are
        resolved by time stepping, which loses order and energy; `StepReport.fallbacks` tells.
    """
    def __getstate__(self) -> tuple: ...
    def __init__(
        self,
        h: typing.SupportsFloat | typing.SupportsIndex = 0.01,
        law: ImpactLaw
        | str
        | collections.abc.Callable[[ImpactProblem], numpy.typing.ArrayLike] = ...,
        collisions: bool = True,
        *,
        order: ImpactOrder | str = ...,
        certify: bool = False,
        max_iterations: typing.SupportsInt | typing.SupportsIndex = 40,
        max_impacts: typing.SupportsInt | typing.SupportsIndex = 1000,
        max_halvings: typing.SupportsInt | typing.SupportsIndex = 6,
        max_impulses: typing.SupportsInt | typing.SupportsIndex = 100000,
        rest: typing.SupportsFloat | typing.SupportsIndex = 1e-10,
        simultaneous: typing.SupportsFloat | typing.SupportsIndex = 1e-09,
        strict: bool = False,
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, arg0: tuple) -> None: ...
    @property
    def certify(self) -> bool: ...
    @property
    def collisions(self) -> bool: ...
    @property
    def h(self) -> float:
        """
        [s]
        """
    @property
    def law(self) -> ImpactLaw:
        """
        `ImpactLaw.custom` for a function
        """
    @property
    def max_halvings(self) -> int: ...
    @property
    def max_impacts(self) -> int: ...
    @property
    def max_impulses(self) -> int: ...
    @property
    def max_iterations(self) -> int: ...
    @property
    def order(self) -> ImpactOrder: ...
    @property
    def rest(self) -> float: ...
    @property
    def simultaneous(self) -> float: ...
    @property
    def strict(self) -> bool: ...

class ImpactOutcome:
    """
    Velocity after an impact, and the impulses that led there, in order.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    @property
    def impulses(self) -> numpy.ndarray:
        """
        structured array: "pair" (row of N), "lambda" [N s]
        """
    @property
    def v(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        velocity after, shape (n,)
        """

class FrictionOutcome:
    """
    Velocity after an impact with friction, and the impulses that led there, in order.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    @property
    def impulses(self) -> typing.Any:
        """
        structured array: "pair" (row of N), "lambda" [N s], "tangential" [N s] along the contact's two rows of T
        """
    @property
    def v(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        velocity after, shape (n,)
        """

class ImpactKind(enum.Enum):
    """
    What can be said of an impact for all velocities at once.

    unique: the velocity after does not depend on the order of the impulses. order_dependent: for some
    velocities it does, and any single answer is a convention. jammed: no velocity opens all gaps;
    impulses need not end.
    """

    jammed = ...
    order_dependent = ...
    unique = ...

class ImpactCertificate:
    """
    Whether the outcome of an impact is unique, and why.

    Attributes
    ----------
    kind : ImpactKind
    type : str
        If unique, the groups of contacts that affect each other, as finite reflection groups: "A3 x
        A1"; "plastic" if all restitutions are 0. Else empty.
    impulses : int or None
        Upper bound of their number; None if no bound is known.
    angles : ndarray, shape (m, m)
        [rad] Wedge angles, `cos angles[i, j] = -G[i, j] / sqrt(G[i, i] G[j, j])`; pi on the diagonal.
    interior : float
        How fast all gaps can open at once: the largest d with `N w >= d sqrt(diag G)`, `w . M w = 1`;
        0 if none is positive.
    same : list of int
        The first contact with each one's normal, mostly the contact itself: equal normals count once.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __str__(self) -> str: ...
    @property
    def angles(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        [rad] wedge angles, shape (m, m)
        """
    @property
    def impulses(self) -> int | None:
        """
        the greatest number, if known
        """
    @property
    def interior(self) -> float:
        """
        how fast all gaps can open at once
        """
    @property
    def kind(self) -> ImpactKind: ...
    @property
    def same(self) -> list[int]:
        """
        the first contact with each one's normal
        """
    @property
    def type(self) -> str:
        """
        the groups of contacts, if unique
        """

class ImpactOutcomes:
    """
    All outcomes of an impact, over every order of the impulses.

    Attributes
    ----------
    outcomes : list of ImpactOutcome
        With one order of impulses for each. The first is that of `ImpactOrder.index`.
    spread : float
        [sqrt(J)] The largest distance of two outcomes in the kinetic metric, `sqrt(d . M d)`.
    relative_spread : float
        Of the velocity's own size in this metric; at most 2.
    states : int
        Number of velocities on the way.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    @property
    def outcomes(self) -> list[ImpactOutcome]:
        """
        with one order of impulses for each
        """
    @property
    def relative_spread(self) -> float:
        """
        of the velocity's own size
        """
    @property
    def spread(self) -> float:
        """
        [sqrt(J)] largest distance of two
        """
    @property
    def states(self) -> int:
        """
        velocities met on the way
        """

class Impact:
    """
    All impulses at one instant, with pairs by name.

    Attributes
    ----------
    t : float
        [s]
    pairs : list of str
        Names of the pairs, in the order of the impulses; a pair may occur more than once.
    lambdas : numpy.ndarray, shape (impulses,)
        [N s] the impulses, `p += lambda * phi_q`.
    tangentials : numpy.ndarray, shape (impulses, 3)
        [N s] friction impulses on the pair's first shape, in the world frame; 0 without friction.
    points : numpy.ndarray, shape (impulses, 3)
        [m] where each impulse acts, in the world frame: halfway between the nearest points of the two
        shapes. NaN in runs from older files without points.
    normals : numpy.ndarray, shape (impulses, 3)
        Unit normal of each contact, in the world frame, from the pair's second shape to the first, on
        which `lambda * normal + tangential` acts. NaN as `points`.
    contacts : int
        Closed contacts.
    law : ImpactLaw
        The law that was used.
    fallback : bool
        nodal_energy replaced the chosen law, because an impulse was too weak for it.
    certificate : str
        Whether the outcome is unique, "unique, A2, at most 3 impulses"; "" where that was not asked for
        (`certify`), and of a single contact. With friction whether another order of these impulses was
        possible: "order_dependent", else "unique", or "unique, plastic" where all restitutions are 0.
    """
    def __init__(
        self,
        t: typing.SupportsFloat | typing.SupportsIndex,
        pairs: collections.abc.Sequence[str],
        lambdas: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"],
        *,
        contacts: typing.SupportsInt | typing.SupportsIndex,
        law: ImpactLaw | str,
        fallback: bool,
        certificate: str = "",
        tangentials: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"]
        | None = None,
        points: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"] | None = None,
        normals: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"] | None = None,
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __str__(self) -> str: ...
    def _repr_html_(self) -> str: ...
    @property
    def certificate(self) -> str: ...
    @property
    def contacts(self) -> int: ...
    @property
    def fallback(self) -> bool: ...
    @property
    def lambdas(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...
    @property
    def law(self) -> ImpactLaw: ...
    @property
    def normals(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]: ...
    @property
    def pairs(self) -> list[str]: ...
    @property
    def points(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]: ...
    @property
    def t(self) -> float: ...
    @property
    def tangentials(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]: ...

class ContactImpulse:
    """
    The impulse that held a contact closed over a step: a sum, without impulses of impacts.

    `impulse * normal + tangential` acts on the pair's first shape at `point`, the opposite on the
    second. Divided by the time step `h` these are mean forces. The summed impulses act at the place of
    the contact at the start of each arc of the step, and at its end; `point` and `normal` are their
    mean, weighted by the impulses. For a body that slides on a plane the sum also has the moment of
    its parts.

    Attributes
    ----------
    pair : str
        Name of the pair.
    impulse : float
        [N s] normal impulse, >= 0.
    tangential : numpy.ndarray, shape (3,)
        [N s] friction impulse, across the normal, in the world frame; 0 without friction.
    point : numpy.ndarray, shape (3,)
        [m] in the world frame, halfway between the nearest points of the two shapes.
    normal : numpy.ndarray, shape (3,)
        Unit normal in the world frame, from the pair's second shape to the first.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    @property
    def impulse(self) -> float: ...
    @property
    def normal(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]: ...
    @property
    def pair(self) -> str: ...
    @property
    def point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]: ...
    @property
    def tangential(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]: ...

class StepReport:
    """
    The report of a step.

    Attributes
    ----------
    iterations : int
        Newton iterations over all arcs tried.
    arcs : int
        Arcs of the step; 1 without impacts.
    sustained : int
        Contacts held closed by a force, summed over the arcs.
    residual : float
        [largest momentum] of the worst arc.
    friction_residual : float
        [largest impulse or rate] residual of Coulomb's law, the worst of the arcs and of the closing
        half kicks. Up to 1e-9 is rounding; more than 1e-6 is a `StepError`. 0 without friction.
    impacts : list of Impact
    settlings : list of (float, str)
        Time [s] and name of each pair that bounced ever lower and has come to rest.
    fallbacks : list of (float, float, str, float, str)
        Empty as a rule. What could not be made as it should: its start [s], the duration of its arcs
        [s], how, what that changed of the energy [J], and the pair that took the largest impulse.
        "halved": the step, by arcs of half of it, a quarter, ...; as exact as with a smaller h.
        "unlocated": one arc, by time stepping: contacts do not rebound in it. "stopped": one arc that
        bodies in contact stand still in.
    contacts : list of ContactImpulse
        Impulses that held contacts closed over the step, each pair once, without those of impacts.
    work : dict of str to float
        [J] done on the model in the step: by each actuator, by "damping" of joints and dampers, by dry
        "friction", and by "applied" forces, those that are functions included.
    loops : dict of str to numpy.ndarray
        [N s | N m s] what each loop pushed in the step, by its rows (`Model.loop_gaps`), without
        impacts; divided by the step `h` it is the mean force on its end a.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    @property
    def arcs(self) -> int: ...
    @property
    def contacts(self) -> list[ContactImpulse]: ...
    @property
    def fallbacks(self) -> list[tuple[float, float, str, float, str]]: ...
    @property
    def friction_residual(self) -> float: ...
    @property
    def impacts(self) -> list[Impact]: ...
    @property
    def iterations(self) -> int: ...
    @property
    def loops(
        self,
    ) -> dict[str, typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]]: ...
    @property
    def residual(self) -> float: ...
    @property
    def settlings(self) -> list[tuple[float, str]]: ...
    @property
    def sustained(self) -> int: ...
    @property
    def work(self) -> dict[str, float]: ...

class Smoothness(enum.Enum):
    """
    What the derivative of a step is worth.

    smooth: one derivative in all directions. selection: several contacts closed at one instant, and
    their order changes it; it is that of the order that was taken, others differ by `spread`.
    one_sided: contacts touch without pushing, or an impact is at an end of the step, and it holds while
    `weak` pairs keep opening; or a contact is at the edge of its friction cone, and it holds while that
    sticks. order_dependent: the outcome itself depends on the order, and the
    derivative is of one side of a jump. grazing: an impact so weak that it is lost by a change of the
    start as small as `depth`.
    """

    grazing = ...
    one_sided = ...
    order_dependent = ...
    selection = ...
    smooth = ...

class StepDirection:
    """
    A direction of what a step is made from, or a covector of it.

    Attributes
    ----------
    q, p : numpy.ndarray, shape (n_v,)
        Of the state at the step's start; q along velocities, of a ball R -> exp(eta) R.
    control : numpy.ndarray, shape (n_u,)
        Of the actuators.
    qfrc : numpy.ndarray, shape (n_v,)
        [N m | N] of forces on the coordinates.
    h : float
        [s] of the step's duration.
    restitution : numpy.ndarray, shape (impacts,)
        Of each impact's restitution.
    friction : numpy.ndarray, shape (rubbing,)
        Of the coefficient of each pair in `StepDerivative.rubbing`.
    forces, torques : numpy.ndarray, shape (wrenches, 3)
        [N], [N m] of each wrench that was applied, in their order and in the axes that each has.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    @property
    def control(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...
    @property
    def forces(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]: ...
    @property
    def friction(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...
    @property
    def h(self) -> float: ...
    @property
    def p(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...
    @property
    def q(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...
    @property
    def qfrc(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...
    @property
    def restitution(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...
    @property
    def torques(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]: ...

class ModelGradient:
    """
    A covector of what a model is made of.

    Attributes
    ----------
    inertia : numpy.ndarray, shape (links, 10)
        By each link's own mass, first moment `mass * c` and inertia about its frame's origin, xx xy xz
        yy yz zz, in its frame. 0 of links fixed to the world. What compensates gravity stays as it is.
    stiffness, rest : numpy.ndarray, shape (n_v,)
        By the joints' linear springs.
    damping, armature : numpy.ndarray, shape (n_v,)
        By the joints' own.
    actuators : numpy.ndarray, shape (n_u, 4)
        By gain, bias, bias_l and bias_v of each, whose force is gain u + bias + bias_l l + bias_v l'
        with its length l; 0 where it pushes all it can. By kp of a position servo, whose gain is kp and
        bias_l -kp: the first less the third; by its kd: less the last.
    restitution, friction : dict of str to float
        By what happens between the two shapes of a pair, by the pair's name: of the pairs that rebounded
        and of those that slid. Of all others it is 0. By one number that all pairs have it is the sum.
        A pair whose restitution is 0 does not rebound, and is none of these.
    springs : dict of str to tuple of float
        By stiffness and length of each spring between two points, by its name.
    dampers : dict of str to float
        By the damping of each damper between two points, likewise.
    placements : dict of str to numpy.ndarray, shape (3,)
        [1/m] By where the frame of each joint that moves is in its parent link, `X_PJ.p`, by the joint's
        name; forces that are functions stay as they are. Those of fixed joints are not told.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    @property
    def actuators(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]: ...
    @property
    def armature(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...
    @property
    def dampers(self) -> dict[str, float]: ...
    @property
    def damping(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...
    @property
    def friction(self) -> dict[str, float]: ...
    @property
    def inertia(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]: ...
    @property
    def placements(
        self,
    ) -> dict[str, typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]]: ...
    @property
    def rest(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...
    @property
    def restitution(self) -> dict[str, float]: ...
    @property
    def springs(self) -> dict[str, tuple[float, float]]: ...
    @property
    def stiffness(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...

class ImpactDerivative:
    """
    An impact as the derivative of its step sees it.

    Attributes
    ----------
    t : float
        [s]
    pairs : list of str
        Names of the pairs, in the order of the impulses.
    spread : float
        How far the derivative by another order is from that by this one, relative to its largest entry.
    depth : float
        [m] How far the gap of the weakest impulse would close without it, u^2 / (2 |phi''|): the
        derivative holds for changes of gaps far below.
    weak : list of str
        Pairs that touch and are at rest along their normal before the impact or after it.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    @property
    def depth(self) -> float: ...
    @property
    def pairs(self) -> list[str]: ...
    @property
    def spread(self) -> float: ...
    @property
    def t(self) -> float: ...
    @property
    def weak(self) -> list[str]: ...

class Selection:
    """
    The derivative of a step by one order of the impulses of an impact.

    Attributes
    ----------
    impact : int
        Its index in `StepDerivative.impacts`.
    pairs : list of str
        Names of the pairs in that order.
    p : numpy.ndarray, shape (n_v,)
        Momenta after the impact.
    A : numpy.ndarray, shape (2 n_v, 2 n_v)
        Empty where the momenta are not those of the step.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    @property
    def A(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]: ...
    @property
    def impact(self) -> int: ...
    @property
    def p(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...
    @property
    def pairs(self) -> list[str]: ...

class StepDerivative:
    """
    The dense derivative of a step.

    Rows are q, then p, of the state that the step ends in; n_v of them each. Directions of q are along
    velocities, of a ball R -> exp(eta) R in its parent's axes.

    Attributes
    ----------
    A : numpy.ndarray, shape (2 n_v, 2 n_v)
        By q and p of the start.
    B : numpy.ndarray, shape (2 n_v, n_u)
        By the controls.
    qfrc : numpy.ndarray, shape (2 n_v, n_v)
        By forces on the coordinates.
    h : numpy.ndarray, shape (2 n_v,)
        By the duration. Empty where forces are functions, whose derivatives by time nobody tells.
    restitution : numpy.ndarray, shape (2 n_v, impacts)
        By each impact's restitution.
    friction : numpy.ndarray, shape (2 n_v, rubbing)
        By the coefficient of friction of each pair in `rubbing`; 0 where it sticks.
    rubbing : list of str
        Names of the pairs that pushed with friction, in arcs or impacts.
    forces, torques : numpy.ndarray, shape (2 n_v, 3 wrenches)
        By each wrench that was applied, in their order and in the axes that each has.
    smoothness : Smoothness
    impacts : list of ImpactDerivative
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    @property
    def A(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]: ...
    @property
    def B(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]: ...
    @property
    def forces(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]: ...
    @property
    def friction(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]: ...
    @property
    def h(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...
    @property
    def impacts(self) -> list[ImpactDerivative]: ...
    @property
    def qfrc(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]: ...
    @property
    def restitution(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]: ...
    @property
    def rubbing(self) -> list[str]: ...
    @property
    def smoothness(self) -> Smoothness: ...
    @property
    def torques(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]: ...

class Stepper:
    """
    The variational impact stepper: one step of size h with all impacts inside it.

    Deterministic: the same sequence of states in gives the same bits out. A stepper that several
    threads use serves them one after the other; make one a thread.

    Parameters
    ----------
    model : Model
    h : float
        [s] step.
    law : ImpactLaw, str or callable
        As in `StepOptions`.
    collisions, order, certify, max_iterations, max_impacts, max_halvings, max_impulses, rest,
    simultaneous
        As in `StepOptions`.
    record : bool
        Whether steps record what `jvp`, `vjp` and `derivative` are made of.

    Raises
    ------
    ModelError
        Where an option is out of its range.
    """
    def __init__(
        self,
        model: Model,
        h: typing.SupportsFloat | typing.SupportsIndex = 0.01,
        law: ImpactLaw
        | str
        | collections.abc.Callable[[ImpactProblem], numpy.typing.ArrayLike] = ...,
        *,
        collisions: bool = True,
        order: ImpactOrder | str = ...,
        certify: bool = False,
        max_iterations: typing.SupportsInt | typing.SupportsIndex = 40,
        max_impacts: typing.SupportsInt | typing.SupportsIndex = 1000,
        max_halvings: typing.SupportsInt | typing.SupportsIndex = 6,
        max_impulses: typing.SupportsInt | typing.SupportsIndex = 100000,
        rest: typing.SupportsFloat | typing.SupportsIndex = 1e-10,
        simultaneous: typing.SupportsFloat | typing.SupportsIndex = 1e-09,
        strict: bool = False,
        record: bool = False,
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def advance(
        self,
        state: State,
        *,
        control: typing.Any = None,
        forces: collections.abc.Mapping[str, Wrench] | None = None,
        qfrc: collections.abc.Mapping[str, numpy.typing.ArrayLike]
        | numpy.typing.ArrayLike
        | None = None,
    ) -> State:
        """
        The state h later; `state` is not changed.

        Parameters
        ----------
        state : State
        control : mapping of names to values, or array_like, shape (n_u,), optional
            Of the actuators over the step; those not named are 0.
        forces : mapping of links' names to Wrench, optional
            Forces and torques on links over the step.
        qfrc : mapping of names to values, or array_like, shape (n_v,), optional
            [N m | N] forces on the coordinates over the step.

        Returns
        -------
        State

        Raises
        ------
        ModelError
            On a state that does not fit the model or overlaps; names pairs and depths.
        StepError
            When an arc does not converge or the impacts of the step do not end.
        JammedError
            When the impulses at one instant do not end.
        """
    def derivative(self) -> StepDerivative:
        """
        The dense derivative of the last step, and what it is worth.

        2 n_v + n_u products of `jvp`. Needs `record=True`.

        Returns
        -------
        StepDerivative

        Raises
        ------
        ModelError
            As `jvp`.
        """
    def directional(
        self,
        dq: collections.abc.Mapping[str, numpy.typing.ArrayLike]
        | numpy.typing.ArrayLike
        | None = None,
        dp: collections.abc.Mapping[str, numpy.typing.ArrayLike]
        | numpy.typing.ArrayLike
        | None = None,
        du: typing.Any = None,
        *,
        dqfrc: collections.abc.Mapping[str, numpy.typing.ArrayLike]
        | numpy.typing.ArrayLike
        | None = None,
        dh: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        drestitution: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"]
        | None = None,
        dfriction: typing.SupportsFloat | numpy.typing.ArrayLike = 0.0,
        dforces: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"] | None = None,
        dtorques: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"] | None = None,
    ) -> tuple[
        typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"],
        typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"],
    ]:
        """
        The one-sided derivative of the last step along a direction.

        Where several contacts close at one instant, a trajectory near by resolves them one after the other,
        in an order that depends on the direction: this takes that order. Else it is `jvp`.

        Parameters
        ----------
        dq, dp, du, dqfrc, dh, drestitution, dfriction, dforces, dtorques
            As in `jvp`.

        Returns
        -------
        tuple of numpy.ndarray, shape (n_v,)
            Of q, along velocities, and of p.

        Raises
        ------
        ModelError
            As `jvp`.
        """
    def hessian(
        self,
        q_hat: collections.abc.Mapping[str, numpy.typing.ArrayLike] | numpy.typing.ArrayLike | None,
        p_hat: collections.abc.Mapping[str, numpy.typing.ArrayLike] | numpy.typing.ArrayLike | None,
    ) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        The Hessian of a cost of the last step's end, by all directions.

        `hvp` for each. Needs `record=True`.

        Parameters
        ----------
        q_hat, p_hat : mapping of names to values, or array_like, shape (n_v,)
            As in `vjp`.

        Returns
        -------
        numpy.ndarray, shape (2 n_v + n_u + 1, 2 n_v + n_u + 1)
            By q, p, the controls and the step's duration; symmetric.

        Raises
        ------
        ModelError
            As `hvp`.
        """
    def hvp(
        self,
        q_hat: collections.abc.Mapping[str, numpy.typing.ArrayLike] | numpy.typing.ArrayLike | None,
        p_hat: collections.abc.Mapping[str, numpy.typing.ArrayLike] | numpy.typing.ArrayLike | None,
        dq: collections.abc.Mapping[str, numpy.typing.ArrayLike]
        | numpy.typing.ArrayLike
        | None = None,
        dp: collections.abc.Mapping[str, numpy.typing.ArrayLike]
        | numpy.typing.ArrayLike
        | None = None,
        du: typing.Any = None,
        *,
        dqfrc: collections.abc.Mapping[str, numpy.typing.ArrayLike]
        | numpy.typing.ArrayLike
        | None = None,
        dh: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> StepDirection:
        """
        The second derivative of a cost of the last step's end along a direction.

        What `vjp(q_hat, p_hat)` changes by as the step's inputs move, with q_hat and p_hat held: the product
        of the Hessian of q_hat.q + p_hat.p with a direction, in O(n), to rounding. Of smooth steps, one arc
        without impacts and contacts, and of models without ball and free joints. Needs `record=True`.

        Parameters
        ----------
        q_hat, p_hat : mapping of names to values, or array_like, shape (n_v,)
            As in `vjp`.
        dq, dp, du, dqfrc, dh
            As in `jvp`.

        Returns
        -------
        StepDirection
            Without impacts, frictions and wrenches.

        Raises
        ------
        ModelError
            As `jvp`; and names what of the step or the model has no second derivative.
        """
    def jvp(
        self,
        dq: collections.abc.Mapping[str, numpy.typing.ArrayLike]
        | numpy.typing.ArrayLike
        | None = None,
        dp: collections.abc.Mapping[str, numpy.typing.ArrayLike]
        | numpy.typing.ArrayLike
        | None = None,
        du: typing.Any = None,
        *,
        dqfrc: collections.abc.Mapping[str, numpy.typing.ArrayLike]
        | numpy.typing.ArrayLike
        | None = None,
        dh: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        drestitution: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"]
        | None = None,
        dfriction: typing.SupportsFloat | numpy.typing.ArrayLike = 0.0,
        dforces: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"] | None = None,
        dtorques: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"] | None = None,
    ) -> tuple[
        typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"],
        typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"],
    ]:
        """
        The direction of the state that the last step ended in, in O(n).

        The exact derivative, through all impacts of the step in their order; `derivative` tells what it is
        worth. Needs `record=True`.

        Parameters
        ----------
        dq, dp : mapping of names to values, or array_like, shape (n_v,), optional
            Of the state at the step's start; dq along velocities.
        du : mapping of names to values, or array_like, shape (n_u,), optional
            Of the controls.
        dqfrc : mapping of names to values, or array_like, shape (n_v,), optional
            [N m | N] of forces on the coordinates.
        dh : float
            [s] of the step's duration.
        drestitution : array_like, shape (impacts,), optional
            Of each impact's restitution.
        dfriction : float or array_like, shape (rubbing,)
            Of all coefficients of friction alike, or of that of each pair in `StepDerivative.rubbing`.
        dforces, dtorques : array_like, shape (wrenches, 3), optional
            [N], [N m] of each wrench that was applied, in their order and in the axes that each has.

        Returns
        -------
        tuple of numpy.ndarray, shape (n_v,)
            Of q, along velocities, and of p.

        Raises
        ------
        ModelError
            Where an array does not fit; where no step was recorded; where the step has something that is
            not differentiated: names it.
        """
    def model_gradient(
        self,
        q_hat: collections.abc.Mapping[str, numpy.typing.ArrayLike] | numpy.typing.ArrayLike | None,
        p_hat: collections.abc.Mapping[str, numpy.typing.ArrayLike] | numpy.typing.ArrayLike | None,
    ) -> ModelGradient:
        """
        The gradient of a cost of the last step's end by the model, in O(n).

        What `vjp` is for the inputs of the step. Needs `record=True`.

        Parameters
        ----------
        q_hat, p_hat : mapping of names to values, or array_like, shape (n_v,)
            As in `vjp`. p is held at the step's start, not v.

        Returns
        -------
        ModelGradient

        Raises
        ------
        ModelError
            As `jvp`.
        """
    def selections(self, most: typing.SupportsInt | typing.SupportsIndex = 1000) -> list[Selection]:
        """
        The derivative by every order of the impacts of one instant.

        Depth first: a contact that does not approach cannot be next. The step's own order comes first.

        Parameters
        ----------
        most : int
            Orders of each impact; what is beyond is left out.

        Returns
        -------
        list of Selection
            None where no impact has several contacts.

        Raises
        ------
        ModelError
            As `jvp`.
        """
    def vjp(
        self,
        q_hat: collections.abc.Mapping[str, numpy.typing.ArrayLike] | numpy.typing.ArrayLike | None,
        p_hat: collections.abc.Mapping[str, numpy.typing.ArrayLike] | numpy.typing.ArrayLike | None,
    ) -> StepDirection:
        """
        The covector of all that the last step was made from, in O(n).

        The transpose of `jvp`: q_hat.dq_next + p_hat.dp_next for every direction at once. Needs
        `record=True`.

        Parameters
        ----------
        q_hat, p_hat : mapping of names to values, or array_like, shape (n_v,)
            The gradient of a cost by the state that the step ended in, q along velocities.

        Returns
        -------
        StepDirection

        Raises
        ------
        ModelError
            As `jvp`.
        """
    @property
    def model(self) -> Model: ...
    @property
    def options(self) -> StepOptions: ...
    @property
    def report(self) -> StepReport:
        """
        StepReport of the step before.
        """

class Trajectory:
    """
    The arrays of a run, as read-only views; `saltus.Trajectory` wraps this.
    """
    @staticmethod
    def from_states(
        model: Model,
        t: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"],
        q: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"],
        rows: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"],
        momenta: bool,
        h: typing.SupportsFloat | typing.SupportsIndex,
    ) -> Trajectory:
        """
        A run of given rows: `rows` are velocities or `momenta`.
        """
    def __init__(self, model: Model) -> None:
        """
        Of no rows; `simulate` writes to it.
        """
    def __reduce__(self) -> tuple: ...
    @property
    def certificates(self) -> list[str]:
        """
        a text an impact, none unless asked for
        """
    @property
    def complete(self) -> bool: ...
    @property
    def contacts(self) -> typing.Any:
        """
        structured array: row, t, impact (-1: held), and as impulses; None where they were not recorded
        """
    @property
    def control(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        shape (rows, n_u)
        """
    @property
    def energy_error(self) -> float: ...
    @property
    def fallbacks(self) -> typing.Any:
        """
        structured array: t, tau, rung, energy, pair
        """
    @property
    def impacts(self) -> typing.Any:
        """
        structured array: t, first, count, contacts, law, fallback
        """
    @property
    def impulses(self) -> typing.Any:
        """
        structured array: pair, lambda, tangential, point, normal
        """
    @property
    def iterations(self) -> int: ...
    @property
    def kinetic(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        [J] shape (rows,)
        """
    @property
    def model(self) -> Model: ...
    @property
    def options(self) -> StepOptions: ...
    @property
    def p(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        shape (rows, n)
        """
    @property
    def potential(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        [J] shape (rows,)
        """
    @property
    def q(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        [rad | m] shape (rows, n)
        """
    @property
    def residual(self) -> float: ...
    @property
    def settlings(self) -> typing.Any:
        """
        structured array: t, pair
        """
    @property
    def shadow(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        [J] shape (rows,)
        """
    @property
    def t(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        [s] shape (rows,)
        """
    @property
    def total(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        [J] shape (rows,)
        """
    @property
    def v(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        [rad/s | m/s] shape (rows, n)
        """
    @property
    def work(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        [J] shape (rows, n_u + 3): of actuators, damping, friction, applied forces
        """

class Energies:
    """
    Energies of one state.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    @property
    def kinetic(self) -> float:
        """
        [J]
        """
    @property
    def potential(self) -> float:
        """
        [J]
        """
    @property
    def shadow(self) -> float:
        """
        [J] H - h^2 kappa / 24
        """

class OnFailure(enum.Enum):
    """
    What becomes of the other runs of a batch where one fails.

    go_on
        They go on; `failures` of the batch holds the message.
    stop
        The batch stops and raises the run's error, with "run <index>: " before it.
    """

    go_on = ...
    stop = ...

class BatchTrajectory:
    """
    The arrays of a batch, as read-only views; `saltus.BatchTrajectory` wraps this.
    """
    def __init__(self, model: Model) -> None:
        """
        Of no runs; `simulate_batch` writes to it.
        """
    def __reduce__(self) -> tuple: ...
    def run(self, index: typing.SupportsInt | typing.SupportsIndex) -> Trajectory:
        """
        One run as a Trajectory of its own.
        """
    @property
    def complete(self) -> numpy.ndarray:
        """
        shape (runs,)
        """
    @property
    def control(self) -> typing.Any:
        """
        shape (runs, rows, n_u)
        """
    @property
    def energy_error(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        shape (runs,)
        """
    @property
    def failures(self) -> dict[int, str]:
        """
        message of each run that failed
        """
    @property
    def impacts(self) -> numpy.ndarray:
        """
        number of impacts, shape (runs,)
        """
    @property
    def kinetic(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        [J] shape (runs, rows)
        """
    @property
    def model(self) -> Model: ...
    @property
    def options(self) -> StepOptions: ...
    @property
    def p(self) -> typing.Any:
        """
        shape (runs, rows, n)
        """
    @property
    def potential(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        [J] shape (runs, rows)
        """
    @property
    def q(self) -> typing.Any:
        """
        [rad | m] shape (runs, rows, n)
        """
    @property
    def rows(self) -> numpy.ndarray:
        """
        number of rows that were reached, shape (runs,)
        """
    @property
    def shadow(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        [J] shape (runs, rows)
        """
    @property
    def stepped(self) -> list[int]:
        """
        runs with arcs by time stepping
        """
    @property
    def t(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        [s] shape (rows,)
        """
    @property
    def v(self) -> typing.Any:
        """
        [rad/s | m/s] shape (runs, rows, n)
        """
    @property
    def work(self) -> typing.Any:
        """
        [J] shape (runs, rows, n_u + 3)
        """

def adjoint(
    model: Model,
    options: StepOptions,
    t: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"],
    q: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"],
    p: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"],
    control: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"],
    q_hat: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"],
    p_hat: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"],
    forces: collections.abc.Mapping[str, Wrench] | None = None,
    qfrc: collections.abc.Mapping[str, numpy.typing.ArrayLike]
    | numpy.typing.ArrayLike
    | None = None,
    *,
    every: typing.SupportsInt | typing.SupportsIndex = 1,
    steps: typing.SupportsInt | typing.SupportsIndex = 0,
    by_step: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"] | None = None,
) -> tuple[
    typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"],
    typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"],
    typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"],
    typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"],
    typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"],
    typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"],
    float,
    ModelGradient,
]:
    """
    The gradient of a cost of a run, as `Trajectory.gradient` gives it.

    Parameters
    ----------
    model : Model
    options : StepOptions
    t : numpy.ndarray, shape (rows,)
        [s] of the start, of each so many steps, and of the end.
    q, p, control : numpy.ndarray, shape (rows, n_q), (rows, n_v), (rows, n_u)
    q_hat, p_hat : numpy.ndarray, shape (rows, n_v)
        The cost by each row's state.
    forces : mapping of links' names to Wrench, optional
    qfrc : mapping of names to values, or array_like, shape (n_v,), optional
        What was applied in all steps.
    every, steps : int
        Steps from row to row, and of the run; 0: as many as rows make.
    by_step : numpy.ndarray, shape (steps, n_u), optional
        The controls of each step, where rows do not tell them.

    Returns
    -------
    tuple
        By the start's q and p (n_v,), by control (rows - 1, n_u), or (steps, n_u), and qfrc
        (rows - 1, n_v), by forces and torques (rows - 1, 3 wrenches), by h, and a ModelGradient.

    Raises
    ------
    ModelError
        Where shapes do not fit, and where a step has no derivative: which, and why.
    StepError, JammedError
        As `Stepper.advance`.
    """

def check_derivatives(
    force: str | collections.abc.Callable[[ForceMoment], typing.Any],
    model: Model,
    *,
    coordinates: collections.abc.Sequence[str] = (),
) -> None:
    """
    Compares derivatives that a user wrote with differences.

    At three random configurations and rates, the same each time: Q_q and Q_v of a force, gradient and
    Hessian of a potential, each entry against central differences of two sizes.

    Parameters
    ----------
    force : str or callable
        The name of a force or a potential of the model, or a function as `ModelBuilder.add_force`
        takes it.
    model : Model
    coordinates : sequence of str, optional
        Of a function, as in `ModelBuilder.add_force`.

    Raises
    ------
    ModelError
        Where one is wrong: names the worst entry, what the function says, what differences say, and the
        order in which the two approach each other as differences are refined, 2 where it is right.
        And where a force returns Q alone: there is nothing to compare.

    Examples
    --------
    >>> import saltus
    >>> model = saltus.load_urdf(saltus.urdf_dir() / "arm.urdf")
    >>> saltus.check_derivatives(lambda now: (-now.v, 0 * model.mass_matrix(now.q), None), model)
    """

def classify_impact(
    M: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"],
    N: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"],
    *,
    restitution: typing.SupportsFloat | numpy.typing.ArrayLike = 1.0,
    tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-09,
) -> ImpactCertificate:
    """
    Whether the outcome of an impact on several contacts is unique, by their angles.

    With `G = N M^-1 N^T` contacts are mirrors at the angles theta, `cos theta = -G_ij / sqrt(G_ii
    G_jj)`. Elastic impacts on two contacts are unique if and only if theta = pi/m. Those on more are if
    every theta is pi/m and the mirrors generate a finite group (J. Humphreys, Reflection Groups and
    Coxeter Groups, 2.4); then the number of impulses does not depend on the order either.

    Parameters
    ----------
    M : array_like, shape (n, n)
        Mass matrix, positive definite.
    N : array_like, shape (m, n)
        Rows are gradients of the gaps.
    restitution : float or array_like, shape (m,)
        e in [0, 1], of all contacts or of each. With e < 1 only contacts that do not feel each other
        have a unique outcome; with all e = 0 any.
    tolerance : float
        An angle is pi/m if m theta / pi is 1 to this.

    Returns
    -------
    ImpactCertificate

    Raises
    ------
    ModelError
        On arguments as for `resolve_impact`, and on a tolerance outside (0, 1e-3].

    Examples
    --------
    >>> import saltus
    >>> saltus.classify_impact(M=[[1, 0, 0], [0, 1, 0], [0, 0, 1]], N=[[-1, 1, 0], [0, -1, 1]])
    <ImpactCertificate: unique, A2, at most 3 impulses>
    """

def close_loops(
    model: Model,
    q: collections.abc.Mapping[str, typing.Any] | numpy.typing.ArrayLike | None = None,
    v: collections.abc.Mapping[str, numpy.typing.ArrayLike] | numpy.typing.ArrayLike | None = None,
    *,
    keep: collections.abc.Sequence[str] = [],
    t: typing.SupportsFloat | typing.SupportsIndex = 0.0,
) -> State:
    """
    Finds the state nearest to a configuration that closes all loops.

    Newton's method goes from q by the shortest steps in the metric of the mass matrix; velocities are
    the nearest, in the same metric, that keep the loops closed. Joints' limits have no say.

    Parameters
    ----------
    model : Model
    q : array_like, shape (n_q,), or mapping, optional
        Where to start: the closer, the likelier is the branch that you mean.
    v : array_like, shape (n_v,), or mapping, optional
    keep : list of str
        Joints, or velocities, that stay exactly as they are in q and v.
    t : float
        [s] of the state, and of prescribed motions.

    Returns
    -------
    State

    Raises
    ------
    ModelError
        Where no such state is found: the loop that stays open, and by how much.
    """

def energies(
    model: Model, state: State, h: typing.SupportsFloat | typing.SupportsIndex
) -> Energies:
    """
    Energies of one state.

    Parameters
    ----------
    model : Model
    state : State
    h : float
        [s] step of the shadow energy H - h^2 kappa / 24, which a fixed step conserves to O(h^4).

    Returns
    -------
    Energies
    """

def equilibrium(
    model: Model,
    q: collections.abc.Mapping[str, typing.Any] | numpy.typing.ArrayLike | None = None,
    *,
    control: typing.Any = None,
    keep: collections.abc.Sequence[str] = [],
) -> State:
    """
    Finds where a model rests under springs, weights and constant controls.

    The minimum of V minus the work of the controls near q, on the loops and within joints' limits.
    Contacts of shapes, damping and dry friction have no say.

    Parameters
    ----------
    model : Model
    q : array_like, shape (n_q,), or mapping, optional
        Where to start.
    control : array_like, shape (n_u,), or mapping, optional
        What actuators are told.
    keep : list of str
        Joints, or velocities, that stay as they are.

    Returns
    -------
    State
        At rest.

    Raises
    ------
    ModelError
        Where nothing holds what moves, and where the equilibrium that is found is no minimum: which
        coordinate would fall away from it.
    """

def gap(
    a: Sphere | Capsule | Box | Cylinder | HalfSpace | Ellipsoid | Convex,
    X_WA: Pose,
    b: Sphere | Capsule | Box | Cylinder | HalfSpace | Ellipsoid | Convex,
    X_WB: Pose,
) -> Gap:
    """
    Signed distance, normal, witness points and curvature of two shapes.

    Parameters
    ----------
    a, b : Shape
    X_WA, X_WB : Pose
        Where they are.

    Returns
    -------
    Gap

    Raises
    ------
    ModelError
        Where these two kinds of shape have no gap function, see `gap_table`, or a pose is not finite.
    """

def gap_table() -> list[tuple[str, str]]:
    """
    The pairs of shapes that have a gap function, by name.

    Returns
    -------
    list of (str, str)
        Generated from the dispatch; the order within a pair does not matter.
    """

def has_gap(
    a: Sphere | Capsule | Box | Cylinder | HalfSpace | Ellipsoid | Convex,
    b: Sphere | Capsule | Box | Cylinder | HalfSpace | Ellipsoid | Convex,
) -> bool:
    """
    True where `gap` knows the two kinds of shape, in either order.
    """

def impact_outcomes(
    M: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"],
    N: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"],
    v: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"],
    *,
    restitution: typing.SupportsFloat | numpy.typing.ArrayLike = 1.0,
    max_outcomes: typing.SupportsInt | typing.SupportsIndex = 1000,
    max_states: typing.SupportsInt | typing.SupportsIndex = 400000,
    tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-09,
) -> ImpactOutcomes:
    """
    All outcomes of an impact: a depth-first search over every order.

    Each velocity is visited once: equal balls in a line take N! velocities, not all orders.

    Parameters
    ----------
    M : array_like, shape (n, n)
        Mass matrix, positive definite.
    N : array_like, shape (m, n)
        Rows are gradients of the gaps.
    v : array_like, shape (n,)
        Velocity before.
    restitution : float or array_like, shape (m,)
        e in [0, 1], of all contacts or of each.
    max_outcomes : int
    max_states : int
        Velocities on the way.
    tolerance : float
        Outcomes that differ by less than this part of the velocity are one, and slower approaches wait
        until no other contact approaches.

    Returns
    -------
    ImpactOutcomes

    Raises
    ------
    ModelError
        On arguments as for `resolve_impact`, and where a bound does not suffice.
    JammedError
        Where impulses lead back to a velocity that they came from, or have no end.

    Examples
    --------
    >>> import saltus
    >>> N = [[-0.8, 0.6, 0.8, -0.6, 0, 0], [-0.8, -0.6, 0, 0, 0.8, 0.6]]  # a disc hits two
    >>> saltus.impact_outcomes([[i == j for j in range(6)] for i in range(6)], N, [1, 0, 0, 0, 0, 0])
    <ImpactOutcomes: 2 outcomes, spread 42 % of v, 5 velocities met>
    """

def read_urdf(
    path_or_text: str | os.PathLike[str],
    *,
    gravity: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"] = (0, 0, -9.81),
    package_dirs: collections.abc.Iterable[str | os.PathLike[str]] = (),
    root_joint: JointType | str = ...,
    solver: TreeSolver | str = ...,
    meshes: MeshUse | str = ...,
    srdf: str | os.PathLike[str] | None = None,
    contact: ContactProperties | None = None,
    floor: bool = False,
    effects: JointEffects | str = ...,
    visuals: bool = True,
    inertia: InertiaUse | str = ...,
    strict: bool = False,
) -> ModelBuilder:
    """
    Reads URDF into a ModelBuilder, to add to it before `build`.

    Parameters
    ----------
    path_or_text : str or os.PathLike
        A file, or URDF text where it begins with "<".
    gravity : array_like, shape (3,)
        [m/s^2]
    package_dirs : sequence of str or os.PathLike
        Where `package://name/rest` is looked up: folders that hold `name`, or `name` itself.
    root_joint : JointType or str
        How the root link hangs on the world: fixed, or by a joint named "root" below a link "world".
    solver : TreeSolver or str
        How steps solve for velocities, see `ModelBuilder.set_solver`.
    meshes : MeshUse or str
        What becomes of collision meshes, where the file does not say it.
    srdf : str or os.PathLike, optional
        SRDF, a file or text: which links never collide, and states by name.
    contact : ContactProperties, optional
        The default contact, in place of the file's own.
    floor : bool
        Adds the half-space z <= 0, as `ModelBuilder.add_floor` does, unless the file has it.
    effects : JointEffects or str
        What of the joints acts: limits, damping, dry friction, motors.
    visuals : bool
        Reads what links look like, `Model.visuals`.
    inertia : InertiaUse or str
        Where the inertias of links come from.
    strict : bool
        Refuses what is wrong and else read with a warning.

    Returns
    -------
    ModelBuilder
        Its `warnings` name what was understood but is not used.

    Raises
    ------
    ModelError
        With file and line, `element` and `name` of the culprit.
    """

def resolve_impact(
    M: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"],
    N: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"],
    v: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"],
    *,
    restitution: typing.SupportsFloat | numpy.typing.ArrayLike = 1.0,
    order: ImpactOrder | str = ...,
    max_impulses: typing.SupportsInt | typing.SupportsIndex = 100000,
    T: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"] | None = None,
    friction: typing.SupportsFloat | numpy.typing.ArrayLike | None = None,
) -> ImpactOutcome | FrictionOutcome:
    """
    Impulses at one instant: while some contact approaches, reflect on one that does.

    In contact space, with G = N M^-1 N^T and u = N v: `lambda_i = -(1 + e_i) u_i / G_ii`,
    `u += G[:, i] lambda_i`. Seghete and Murphey, "Multiple Instantaneous Collisions in a Variational
    Framework", (4), (5) and section III-D. Ends after finitely many impulses if all e = 1 and the cone
    {v: N v >= 0} has an interior.

    The order `ImpactOrder.symmetric` reflects on all that approach together, and `restitution=0` for
    all contacts is, in any order, the projection on {v: N v >= 0}. `classify_impact` tells whether the
    order matters, `impact_outcomes` by how much.

    With `T` and `friction` contacts have Coulomb friction: one after another collides, in a compression
    until it does not close any more and an expansion with e times the impulse of the compression
    (Poisson's restitution), and in each friction is what dissipates most, `|beta| <= mu lambda`. Energy
    never grows. Contacts that all have e = 0 are resolved together, and with `ImpactOrder.symmetric` all
    that approach.

    Parameters
    ----------
    M : array_like, shape (n, n)
        Mass matrix, positive definite.
    N : array_like, shape (m, n)
        Rows are gradients of the gaps.
    v : array_like, shape (n,)
        Velocity before.
    restitution : float or array_like, shape (m,)
        e in [0, 1], of all contacts or of each.
    order : ImpactOrder or str
    max_impulses : int
    T : array_like, shape (2 m, n), optional
        Two rows a contact: `T v` is the velocity of the points that touch along two orthogonal unit
        tangents; one row is 0 where motion is planar. Belongs to `friction`.
    friction : float or array_like, shape (m,), optional
        Coulomb's mu >= 0, of all contacts or of each. Belongs to `T`.

    Returns
    -------
    ImpactOutcome
        `v`, and `impulses` with the fields "pair" (row of N) and "lambda".
    FrictionOutcome
        With friction; its impulses have the field "tangential", shape (2,), too.

    Raises
    ------
    ModelError
        On shapes that do not fit, values that are not finite, M not positive definite, e not in [0, 1],
        mu < 0; on one of `T` and `friction` without the other.
    JammedError
        When the impulses do not end.

    Examples
    --------
    >>> import saltus
    >>> out = saltus.resolve_impact(  # a puck slides down on a floor: x, z
    ...     M=[[1, 0], [0, 1]], N=[[0, 1]], v=[2, -1], T=[[1, 0], [0, 0]], friction=0.25
    ... )
    >>> out.v.tolist()
    [1.5, 1.0]
    """

def resolve_overlap(
    model: Model, q: collections.abc.Mapping[str, typing.Any] | numpy.typing.ArrayLike | None
) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
    """
    The nearest configuration without overlap.

    Moves bodies out of each other as little as the kinetic metric allows, step by step: each
    minimizes |dq|_M subject to phi + phi_q dq >= 0. Joints' limits are such gaps, and loops stay
    closed.

    Parameters
    ----------
    model : Model
    q : mapping of names to values, or array_like, shape (n,)
        [rad | m] coordinates; those not named are 0.

    Returns
    -------
    numpy.ndarray, shape (n,)

    Raises
    ------
    ModelError
        Where `q` does not fit the model; where pairs still overlap in the end: names them and their
        depths.
    """

def rotation_from_rpy(
    roll: typing.SupportsFloat | typing.SupportsIndex,
    pitch: typing.SupportsFloat | typing.SupportsIndex,
    yaw: typing.SupportsFloat | typing.SupportsIndex,
) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 3]"]:
    """
    Rotation by fixed-axis roll, pitch and yaw, as in URDF: `Rz(yaw) Ry(pitch) Rx(roll)`.

    Parameters
    ----------
    roll, pitch, yaw : float
        [rad]

    Returns
    -------
    numpy.ndarray, shape (3, 3)
    """

def shape_name(shape: Sphere | Capsule | Box | Cylinder | HalfSpace | Ellipsoid | Convex) -> str:
    """
    As in `gap_table`: "sphere", "half_space".
    """

def simulate(
    run: Trajectory,
    start: State,
    duration: typing.SupportsFloat | typing.SupportsIndex,
    *,
    options: StepOptions = ...,
    record_every: typing.SupportsInt | typing.SupportsIndex = 1,
    record_contacts: bool = False,
    control: typing.Any = None,
    control_every: typing.SupportsInt | typing.SupportsIndex = 1,
    forces: collections.abc.Mapping[str, Wrench] | None = None,
    qfrc: collections.abc.Mapping[str, numpy.typing.ArrayLike]
    | numpy.typing.ArrayLike
    | None = None,
    progress: collections.abc.Callable[[float], typing.Any] | None = None,
) -> None:
    """
    Runs round(duration / h) steps from `start`; row 0 is `start`.

    Parameters
    ----------
    run : Trajectory
        Is written: all rows, those before the step where it raises an error or Ctrl-C
        (KeyboardInterrupt) stops it, none where numbers make no run. Not `complete` where rows lack.
    start : State
    duration : float
        [s] a whole number of steps.
    options : StepOptions
    record_every : int
        Steps between recorded rows.
    record_contacts : bool
        Whether to fill `contacts`.
    control, forces, qfrc
        As `saltus.simulate` takes them.
    control_every : int
        Steps between the times that a function is asked.
    progress : callable, optional
        Called about ten times a second with the part done in [0, 1]; what it returns is not used.

    Raises
    ------
    ModelError
        On a duration or h that is not positive, a duration that is no whole number of steps, a start
        that does not fit the model or overlaps, more than 16 GB.
    StepError, JammedError
        As `Stepper.advance`.
    """

def simulate_batch(
    batch: BatchTrajectory,
    starts: collections.abc.Sequence[State],
    duration: typing.SupportsFloat | typing.SupportsIndex,
    *,
    options: StepOptions = ...,
    record_every: typing.SupportsInt | typing.SupportsIndex = 1,
    record_contacts: bool = False,
    control: collections.abc.Sequence[
        typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"]
    ] = [],
    forces: collections.abc.Mapping[str, Wrench] | None = None,
    qfrc: collections.abc.Mapping[str, numpy.typing.ArrayLike]
    | numpy.typing.ArrayLike
    | None = None,
    threads: typing.SupportsInt | typing.SupportsIndex = 0,
    on_failure: OnFailure | str = ...,
    progress: collections.abc.Callable[[float], typing.Any] | None = None,
) -> None:
    """
    Runs round(duration / h) steps from every start.

    Parameters
    ----------
    batch : BatchTrajectory
        Is written: all runs, also where one raises an error; none where numbers make no run. Runs that
        Ctrl-C (KeyboardInterrupt) stopped are not `complete`.
    starts : list of State
    duration : float
        [s] a whole number of steps.
    options : StepOptions
    record_every : int
        Steps between recorded rows.
    record_contacts : bool
        Whether to fill `contacts` of each run.
    control : list of numpy.ndarray, shape (steps, n_u)
        Of each run, or none; the last row holds on.
    forces, qfrc
        Of all runs, as `saltus.simulate` takes them.
    threads : int
        0: as many as the machine runs at once. The bits do not depend on it.
    on_failure : OnFailure or str
    progress : callable, optional
        Called about ten times a second with the part done in [0, 1]; what it returns is not used.

    Raises
    ------
    ModelError
        Before anything runs, on numbers that make no run.
    StepError, JammedError, ModelError
        With OnFailure.stop, the error of the first run, by index, that fails.
    """

def solid_box(
    mass: typing.SupportsFloat | typing.SupportsIndex,
    half: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"],
) -> BodyInertia:
    """
    Inertia of a homogeneous box about its centre.

    Parameters
    ----------
    mass : float
        [kg]
    half : array_like, shape (3,)
        [m] half-extents, as of `Box`.

    Returns
    -------
    BodyInertia

    Raises
    ------
    ModelError
        Where the mass or a size is not finite and positive.
    """

def solid_cylinder(
    mass: typing.SupportsFloat | typing.SupportsIndex,
    radius: typing.SupportsFloat | typing.SupportsIndex,
    half_length: typing.SupportsFloat | typing.SupportsIndex,
) -> BodyInertia:
    """
    Inertia of a homogeneous cylinder along z about its centre.

    Parameters
    ----------
    mass : float
        [kg]
    radius, half_length : float
        [m] as of `Cylinder`.

    Returns
    -------
    BodyInertia

    Raises
    ------
    ModelError
        Where the mass or a size is not finite and positive.
    """

def solid_inertia(
    mass: typing.SupportsFloat | typing.SupportsIndex,
    shape: Sphere | Capsule | Box | Cylinder | HalfSpace | Ellipsoid | Convex,
) -> BodyInertia:
    """
    Inertia of a homogeneous solid, in its shape's frame.

    Parameters
    ----------
    mass : float
        [kg]
    shape : Shape

    Returns
    -------
    BodyInertia
        The centre of mass of a `Convex` need not be the origin.

    Raises
    ------
    ModelError
        On a `HalfSpace`, which is infinite, and on a mass or size that is not finite and positive.

    See Also
    --------
    volume : to get the mass from a density.
    ModelBuilder.add_body : a link with a shape and this inertia, and its joint.
    """

def solid_sphere(
    mass: typing.SupportsFloat | typing.SupportsIndex,
    radius: typing.SupportsFloat | typing.SupportsIndex,
) -> BodyInertia:
    """
    Inertia of a homogeneous ball about its centre.

    Parameters
    ----------
    mass : float
        [kg]
    radius : float
        [m]

    Returns
    -------
    BodyInertia

    Raises
    ------
    ModelError
        Where the mass or a size is not finite and positive.
    """

def states(
    model: Model,
    q: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"],
    v: typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]", "flags.c_contiguous"],
) -> list[State]:
    """
    Starts at t = 0, one of each row of q and v.

    Parameters
    ----------
    model : Model
    q, v : numpy.ndarray, shape (runs, n)
        Coordinates [rad | m] and velocities.

    Returns
    -------
    list of State

    Raises
    ------
    ModelError
        On other shapes; on a value that is not finite, by row and coordinate.
    """

def volume(shape: Sphere | Capsule | Box | Cylinder | HalfSpace | Ellipsoid | Convex) -> float:
    """
    Volume of a shape.

    Parameters
    ----------
    shape : Shape

    Returns
    -------
    float
        [m^3]

    Raises
    ------
    ModelError
        On a `HalfSpace`, which is infinite, and on a size that is not finite and positive.
    """

_DESCRIPTION_VERSION: int = 1
__version__: str = "0.1.0"
