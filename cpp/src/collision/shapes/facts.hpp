// What is known of a shape alone, in its own frame: overloads, each in the shape's own file.
//
// A new shape declares what it has in a paragraph below; the templates stand for what it has not.
// The rest of the library asks by the functions of a Shape, at the end.
#pragma once

#include <string>

#include "collision/shapes/features.hpp"
#include "collision/shapes/point_distance.hpp"

namespace saltus {

/// Every bounded shape is a convex core and all points within a radius of it: a sphere's core is
/// its centre, a capsule's its segment, that of any other shape the shape itself.
struct Core {
  double radius = 0;    ///< [m] 0 where the core is the shape
  double length = 0;    ///< [m] how far it goes from the origin, about
  bool curved = false;  ///< has features that bend
};

/// How many parts of each kind a shape has.
struct PartCounts {
  int corners = 0, edges = 0, rims = 0, faces = 0;
};

/// A part of a shape, in the shape's frame.
struct PartOfShape {
  std::string name;  ///< "" for all of it
  Shape shape;
  Pose X_GP = {};                 ///< its frame
  Vec3 out = Vec3::Zero();        ///< of an edge or a rim: as in Pair
  std::vector<Vec3> inward = {};  ///< of a corner: along the edges that meet in it
};

/// A face of a solid as a point sees it.
struct SeenFace {
  double e;         ///< [m] height of the point over it
  Vec3 n;           ///< in the solid's frame
  double bend = 0;  ///< [1/m] along n, about the solid's z axis
};

/// A point of a core, and its patch.
struct Lowest {
  Vec3 x;
  Patch patch;
};

/// A homogeneous solid.
struct Homogeneous {
  double volume;  ///< [m^3]
  Vec3 center;    ///< [m] of mass
  Mat3 I;         ///< [kg m^2] about the center
};

inline char sign_name(double x) { return x < 0 ? '-' : '+'; }
/// A corner or an end.
PartOfShape point(const std::string& name, double radius, const Vec3& p);
/// Out of the edge of faces with the unit normals m and n: 1/cos of half the angle between them.
Vec3 between(const Vec3& m, const Vec3& n);
/// One of the hull's faces, edges or rows that cannot be; "" where all is well. Cheap: it does not
/// look whether the solid is convex.
std::string flaw_of_hull(const Hull& hull);
/// "of size (1 -1 1); ..." unless all are finite and positive; "" then.
std::string flaw_of_size(const Vec3& size);

// Each shape has ball_of and size_of (shapes.hpp), flaw_of: "" or what is wrong with its
// sizes, and parts_of; one that has no parts is round and touches anything in one point.
//
// One with an end has homogeneous_of, the solid of this mass, and a core:
//   core_of, farthest_of   its size, and the point farthest along d (any length), of equally far
//                          ones always the same; farthest_near climbs from a hint, if there is one
//   nearby_of, flat_of     find_nearby and flat_along, where d is the direction in its frame
// or brick_of in place of the last three: half lengths along the axes, of a segment one, else 0.
// The parts are corner_of, edge_of, rim_of, by number, and face_of, as a point c sees it. What has
// an axis along z, a segment with a radius, tells it by axis_of; a smooth surface has surface_of,
// slide_on and patch_on (features.hpp).
//
// Closed forms, in place of the general scheme: distance_of a point c, and lowest_of, the point of
// the core that is farthest along the unit m, where a rise of less than level_sine is none.

template <class S>
PartCounts parts_of(const S&) {
  return {};
}
template <class S>
Capsule axis_of(const S&) {
  return {0, 0};
}
PartCounts parts_of(const Shape&) = delete;
Capsule axis_of(const Shape&) = delete;

/// Components of a turned unit vector are this uncertain.
inline constexpr double level_sine = 4e-16;

double ball_of(const Sphere& s);
double size_of(const Sphere& s);
std::string flaw_of(const Sphere& s);
Homogeneous homogeneous_of(const Sphere& s, double mass);
Core core_of(const Sphere& s);
Vec3 brick_of(const Sphere&);
PointDistance distance_of(const Sphere& s, const Vec3& c);

double ball_of(const Capsule& s);
double size_of(const Capsule& s);
std::string flaw_of(const Capsule& s);
Homogeneous homogeneous_of(const Capsule& s, double mass);
Core core_of(const Capsule& s);
Vec3 brick_of(const Capsule& s);
PartCounts parts_of(const Capsule&);
PartOfShape corner_of(const Capsule& s, int k);
PartOfShape edge_of(const Capsule& s, int k);
Capsule axis_of(const Capsule& s);
PointDistance distance_of(const Capsule& s, const Vec3& c);

double ball_of(const Box& s);
double size_of(const Box& s);
std::string flaw_of(const Box& s);
Homogeneous homogeneous_of(const Box& s, double mass);
Core core_of(const Box& s);
Vec3 brick_of(const Box& s);
PartCounts parts_of(const Box&);
PartOfShape corner_of(const Box& s, int k);
PartOfShape edge_of(const Box& s, int k);
SeenFace face_of(const Box& s, const Vec3& c, int k);
PointDistance distance_of(const Box& s, const Vec3& c);

double ball_of(const Cylinder& s);
double size_of(const Cylinder& s);
std::string flaw_of(const Cylinder& s);
Homogeneous homogeneous_of(const Cylinder& s, double mass);
Core core_of(const Cylinder& s);
Vec3 farthest_of(const Cylinder& s, const Vec3& d);
void nearby_of(const Cylinder& c, const Solid& s, const Vec3& d, double width, Nearby& out);
void flat_of(const Cylinder& c, const Solid& s, const Vec3& d, double level, Flat& out);
PartCounts parts_of(const Cylinder&);
PartOfShape corner_of(const Cylinder& s, int k);
PartOfShape edge_of(const Cylinder& s, int k);
PartOfShape rim_of(const Cylinder& s, int k);
SeenFace face_of(const Cylinder& s, const Vec3& c, int k);
Capsule axis_of(const Cylinder& s);
PointDistance distance_of(const Cylinder& s, const Vec3& c);
Lowest lowest_of(const Cylinder& s, const Vec3& m);

double ball_of(const HalfSpace&);
double size_of(const HalfSpace&);
std::string flaw_of(const HalfSpace&);
PointDistance distance_of(const HalfSpace&, const Vec3& c);

double ball_of(const Ellipsoid& s);
double size_of(const Ellipsoid& s);
std::string flaw_of(const Ellipsoid& s);
Homogeneous homogeneous_of(const Ellipsoid& s, double mass);
Core core_of(const Ellipsoid& s);
Vec3 farthest_of(const Ellipsoid& s, const Vec3& d);
void nearby_of(const Ellipsoid&, const Solid& s, const Vec3& d, double width, Nearby& out);
void flat_of(const Ellipsoid&, const Solid& s, const Vec3& d, double level, Flat& out);
Feature surface_of(const Ellipsoid& e, const Solid& s, const Vec3& m);
void slide_on(const Ellipsoid& e, const Solid& s, const Vec3& step_W, Feature& f);
Patch patch_on(const Ellipsoid& e, const Solid& s, const Feature& f, const Vec3& n);
PointDistance distance_of(const Ellipsoid& s, const Vec3& c);
Lowest lowest_of(const Ellipsoid& s, const Vec3& m);

double ball_of(const Convex& s);
double size_of(const Convex& s);
std::string flaw_of(const Convex& s);
Homogeneous homogeneous_of(const Convex& s, double mass);
Core core_of(const Convex& s);
Vec3 farthest_of(const Convex& s, const Vec3& d);
Vec3 farthest_near(const Convex& s, const Vec3& d, int& hint);
void nearby_of(const Convex& c, const Solid& s, const Vec3& d, double width, Nearby& out);
void flat_of(const Convex& c, const Solid& s, const Vec3& d, double level, Flat& out);
PartCounts parts_of(const Convex& s);
PartOfShape corner_of(const Convex& s, int k);
PartOfShape edge_of(const Convex& s, int k);
SeenFace face_of(const Convex& s, const Vec3& c, int k);
PointDistance distance_of(const Convex& s, const Vec3& c);
Lowest lowest_of(const Convex& s, const Vec3& m);

template <class S>
concept IsBrick = requires(const S& s) { brick_of(s); };

template <IsBrick S>
Vec3 farthest_of(const S& s, const Vec3& d) {
  return brick_of(s).cwiseProduct(Vec3(side(d.x()), side(d.y()), side(d.z())));
}
template <IsBrick S>
void nearby_of(const S& b, const Solid& s, const Vec3& d, double width, Nearby& out) {
  add_nearby_of_brick(brick_of(b), s, d, width, out);
}
template <IsBrick S>
void flat_of(const S& b, const Solid& s, const Vec3& d, double level, Flat& out) {
  set_flat_of_brick(brick_of(b), s, d, level, out);
}

template <class S>
concept HasCore = requires(const S& s) { core_of(s); };
template <class S>
concept HasDistance = requires(const S& s) { distance_of(s, Vec3()); };
template <class S>
concept HasFaces = requires(const S& s) { face_of(s, Vec3(), 0); };

std::string flaw(const Shape& shape);
/// Of a shape with an end.
Homogeneous homogeneous(const Shape& shape, double mass);

/// [m] 0 where the core is the shape.
double core_radius(const Shape& shape);
/// [m] radius of the ball about the shape's origin that holds the core; infinity for a half-space.
double core_extent(const Shape& shape);
Vec3 core_support(const Shape& shape, const Vec3& direction);

PartCounts part_counts(const Shape& shape);
/// An edge as a capsule.
Capsule edge_capsule(const Shape& shape);
/// A sphere.
PartOfShape corner(const Shape& shape, int k);
/// Along its z axis: a capsule, of radius 0 for an edge of flat faces, or the cylinder itself.
PartOfShape edge(const Shape& shape, int k);
/// As a disc.
PartOfShape rim(const Shape& shape, int k);

Lowest lowest(const Shape& shape, const Vec3& m);
void slide_on_surface(const Solid& s, const Vec3& step_W, Feature& f);
Patch patch_of_surface(const Solid& s, const Feature& f, const Vec3& n);

}  // namespace saltus
