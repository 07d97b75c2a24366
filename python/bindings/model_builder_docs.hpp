// Docstrings of ModelBuilder.
#pragma once

namespace saltus::bindings::docs {

constexpr auto mimic =
    R"(This joint's displacement is `multiplier * (displacement of joint) + offset`.

Parameters
----------
joint : str
    Name of the joint to follow; both have one coordinate.
multiplier : float
offset : float
    [rad | m]
)";

constexpr auto model_builder =
    R"(Describes a model link by link; `build` checks it and makes the model.

All methods return the builder, so that calls can be chained. Local mistakes raise ModelError at
once; mistakes of the whole (unknown parents, cycles, joints that move no mass) raise it in `build`.

Parameters
----------
name : str
    Name of the model.
root : str
    Name of the link that is fixed to the world; its frame is the world frame.
)";

constexpr auto set_gravity = R"(Sets gravity; default: (0, 0, -9.81).

Parameters
----------
gravity : array_like, shape (3,)
    [m/s^2]
)";

constexpr auto set_solver = R"(Sets the linear solver of the steps, for all trees.

It changes the speed, and results by rounding only. The default, TreeSolver.automatic, depends on
the shape of each tree; `Model.solvers` has the solvers in use.

Parameters
----------
solver : TreeSolver or str
)";

constexpr auto add_link = R"(Adds a link.

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
)";

constexpr auto add_joint = R"(Adds a joint between two links.

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
)";

constexpr auto add_shape = R"(Adds a collision shape.

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
)";

constexpr auto inertia_check = R"(How far the inertia of a link may be from what a body can have.

strict: not at all. lenient, as of files: with a warning, moments that are possible once none is
changed by more than 2 % of the greatest, and moments without a mass of what is welded or fixed.
as_given: moments may be anything.
)";

constexpr auto add_visual = R"(Adds what a link looks like, or a part of it; it touches nothing.

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
)";

constexpr auto add_half_space =
    R"(Adds the solid below the plane normal.x = offset, fixed to the world.

Parameters
----------
name : str
    As in names of pairs.
normal : array_like, shape (3,)
    Out of the solid, of any length but 0.
offset : float
    [m]
)";

constexpr auto add_exclusion =
    R"(Lets two links pass through each other: no gap is watched between them.

Half-spaces belong to the root link.

Parameters
----------
link_a, link_b : str
)";

constexpr auto add_body_exclusion =
    R"(As `add_exclusion`, but half-spaces of these links stay watched.

Parameters
----------
link_a, link_b : str
)";

constexpr auto set_group = R"(Puts a link into a group; a link is in one group at most.

Parameters
----------
link : str
group : str
    Any name, for `add_group_exclusion`.
)";

constexpr auto add_group_exclusion = R"(Lets the links of two groups pass through each other.

Parameters
----------
group_a, group_b : str
    They may be the same group; its links then pass through each other.
)";

constexpr auto set_adjacent_links = R"(Sets whether links on both sides of one joint may collide.

Links that are welded together never collide.

Parameters
----------
adjacent : AdjacentLinks or str
)";

constexpr auto adjacent_links =
    R"(Whether gaps are watched between links on both sides of one joint, which often overlap there.

Default: excluded. Floating and planar joints do not make their links adjacent.
)";

constexpr auto set_material =
    R"(Sets the material of all shapes of a link; `set_contact` gives it its properties.

Parameters
----------
link : str
    The root link's material is that of its half-spaces too; `add_floor` gives a floor its own.
material : str
    Any name.
)";

constexpr auto set_contact =
    R"(Sets restitution and friction of two materials; the last call applies.

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
)";

constexpr auto set_default_contact =
    R"(Sets restitution and friction of all pairs for which nothing else is set.

`set_contact` of their materials takes precedence, then the properties of a floor (`add_floor`). The
default is elastic and frictionless. Parameters as in `set_contact`.
)";

constexpr auto build = R"(Checks the description and makes the model.

Returns
-------
Model
    Its `warnings` are also issued as `ModelWarning`.

Raises
------
ModelError
    With `element` and `name` of the culprit.
)";

}  // namespace saltus::bindings::docs
