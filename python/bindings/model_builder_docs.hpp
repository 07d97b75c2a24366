// Docstrings of ModelBuilder.
#pragma once

namespace saltus::bindings::docs {

constexpr auto mimic =
    R"(This joint's displacement is `multiplier * (displacement of joint) + offset`.

Parameters
----------
joint : str
    Name of the joint that is followed; both have one coordinate.
multiplier : float
offset : float
    [rad | m]
)";

constexpr auto model_builder = R"(Describes a model link by link; `build` checks and freezes it.

All methods return the builder, so that calls can be chained. Local mistakes raise ModelError at
once, those that need the whole (unknown parents, cycles, joints that move no mass) in `build`.

Parameters
----------
name : str
    Name of the model.
root : str
    Name of the link that is fixed to the world; its frame is the world frame.
)";

constexpr auto set_gravity = R"(Sets gravity; it is (0, 0, -9.81) otherwise.

Parameters
----------
gravity : array_like, shape (3,)
    [m/s^2]
)";

constexpr auto set_solver = R"(Says how steps solve for velocities, on all trees.

A matter of speed: answers differ by rounding. It is TreeSolver.automatic otherwise, which goes by
the shape of each tree; `Model.solvers` tells what became of it.

Parameters
----------
solver : TreeSolver or str
)";

constexpr auto add_link = R"(Adds a link.

Parameters
----------
name : str
inertia : BodyInertia
    In the link's frame; none where the link has no mass.

Raises
------
ModelError
    On a name that is taken and on an inertia that no body can have.
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
    [rad | m] limits; kept for the user, not applied.
velocity, effort : float
    [rad/s | m/s], [N m | N] limits; kept for the user, not applied.
damping, friction : float
    [N m s/rad | N s/m], [N m | N]; kept for the user, not applied.

Raises
------
ModelError
    On a name that is taken, a zero axis, limits in the wrong order, and numbers that are none.
)";

constexpr auto add_shape = R"(Adds a shape that can touch others.

It is named after its link, with "#2" added for the link's second, and so on.

Parameters
----------
link : str
shape : Shape
X_LG : Pose
    The shape's frame in the link's frame.

Raises
------
ModelError
    On sizes that are not finite and positive, and on a half-space that is not the root link's.
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

constexpr auto set_group = R"(Puts a link into a group, of which it has one at most.

Parameters
----------
link : str
group : str
    Any name; `add_group_exclusion` says what it is good for.
)";

constexpr auto add_group_exclusion = R"(Lets the links of two groups pass through each other.

Parameters
----------
group_a, group_b : str
    The same one twice: its links pass through each other.
)";

constexpr auto set_adjacent_links = R"(Says whether links on both sides of one joint may collide.

What is welded together never does.

Parameters
----------
adjacent : AdjacentLinks or str
)";

constexpr auto adjacent_links =
    R"(Are gaps watched between links on both sides of one joint? They overlap at it by design.

Excluded unless said otherwise. Floating and planar joints do not make their links adjacent.
)";

constexpr auto set_material =
    R"(Says what all shapes of a link are made of; it says nothing by itself.

Parameters
----------
link : str
    The root link's material is that of its half-spaces too; `add_floor` gives a floor its own.
material : str
    Any name; `set_contact` says what happens between two.
)";

constexpr auto set_contact = R"(Says what happens where two materials meet; the last word holds.

Parameters
----------
material_a, material_b : str
    In any order; they may be the same.
restitution : float
    e in [0, 1]: a contact that closes with gap rate u < 0 opens with -e u.
friction : float
    Coulomb's mu >= 0: the tangential force is at most mu times the normal one.

Raises
------
ModelError
    On values out of their range; `build` raises it on materials that no link has.
)";

constexpr auto set_default_contact =
    R"(Says what happens between all shapes that nothing else is said of.

`set_contact` of their materials comes first, then the properties of a floor (`add_floor`). Elastic and without friction otherwise. Parameters as in `set_contact`.
)";

constexpr auto build = R"(Checks the whole and freezes it.

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
