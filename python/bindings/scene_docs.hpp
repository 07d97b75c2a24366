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
    On a `HalfSpace`, which has no end, and where the mass or a size is not finite and positive.

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
    On a `HalfSpace`, which has no end, and where a size is not finite and positive.
)";

constexpr auto add_body =
    R"(Adds a homogeneous solid that moves: a link, its shape and the joint above it.

The frames of the three are one, and the inertia is that of the shape (`solid_inertia`).

Parameters
----------
name : str
    Of the link.
shape : Shape
mass : float, optional
    [kg] this or `density`; a body on a fixed joint may have neither.
density : float, optional
    [kg/m^3]
X : Pose
    Where the body is in the parent link's frame at displacement 0.
joint : JointType or str
    Floating: it flies. Fixed, and below the root: it never moves.
parent : str, optional
    Link below which it hangs; the root link otherwise. It may be added later.
joint_name : str, optional
    The body's name otherwise, so that the coordinates of a free body "cube" are "cube_x" and so on.
axis : array_like, shape (3,)
    Of a joint that has one, in the body's frame. `add_joint` has what joints may have besides.

Raises
------
ModelError
    On names that are taken, a half-space, sizes or a mass that no body has, and where not one of
    mass and density is given. Nothing is added then.
)";

constexpr auto add_floor =
    R"(Adds the solid below the plane normal.x = offset, fixed to the world, of a material of its own.

What happens between a floor and a body is the first of these that is said: `set_contact` of their
two materials, this floor's own properties, `set_default_contact`.

Parameters
----------
name : str
    As in names of pairs.
normal : array_like, shape (3,)
    Out of the solid, of any length but 0.
offset : float
    [m]
restitution, friction : float, optional
    With all bodies that no `set_contact` is said of. Where one of the two is given, the other is 0;
    where none is, the default contact holds.
material : str, optional
    For `set_contact`; the floor's name otherwise.

Raises
------
ModelError
    On a name that is taken, on a plane where there is a half-space already, and on numbers out of
    their range. Nothing is added then.
)";

constexpr auto add = R"(Puts another model into this one: two robots in one world.

The other's root link is fixed to a link of this one. Half-spaces of one plane become one, and a
default contact that only one of the two has holds for both. Materials of one name are one material.
Gravity and solver stay those of this builder. A `Model` is added as it was built, with its
collisions.

Parameters
----------
other : ModelBuilder or Model
    It stays as it is.
prefix : str
    Put before all names of the other: of links, joints (and so coordinates), half-spaces, groups.
parent : str, optional
    Link that carries the other's root link; this one's root otherwise.
X : Pose
    Where the other's root link is in the parent's frame.
own_materials : bool
    True: the other's materials get the prefix too, and so are others than those of this builder.

Raises
------
ModelError
    On names that both have (the message proposes a prefix), on half-spaces that would move, and
    where the two contradict each other: in default contacts, contacts of materials, floors, or
    gaps between adjacent links. Nothing is added then.
)";

}  // namespace saltus::bindings::docs
