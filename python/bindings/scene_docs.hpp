// Docstrings of scenes for people: solids, bodies, floors, one model in another.
#pragma once

namespace saltus::bindings::docs {

constexpr auto solid_inertia = R"(Inertia of a homogeneous solid, in its shape's frame.

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
)";

constexpr auto volume = R"(Volume of a shape.

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
)";

constexpr auto add_body =
    R"(Adds a homogeneous solid: a link, its shape and its joint.

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
)";

constexpr auto add_floor =
    R"(Adds the solid below the plane normal.x = offset, fixed to the world, of a material of its own.

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
)";

constexpr auto add = R"(Copies another model into this one: two robots in one world.

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
)";

}  // namespace saltus::bindings::docs
