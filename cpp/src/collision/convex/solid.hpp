// The convex core of a shape in the general scheme of gaps (convex_gap.hpp): where it is farthest
// along a direction, and the features of its surface near there.
#pragma once

#include "saltus/collision/gap.hpp"

namespace saltus {

/// In axes parallel to the world's, about an origin common to both solids of a pair.
struct Solid {
  enum class Kind { segment, box, cylinder, ellipsoid, hull };
  Kind kind;
  Vec3 size;  ///< [m] segment (0, 0, h), box halves, cylinder (r, r, h), ellipsoid radii
  const Hull* hull;
  Mat3 R;
  Vec3 p;
  double radius;         ///< [m] of the shape round this core
  double length;         ///< [m] from p to its farthest point
  mutable int hint = 0;  ///< vertex to climb from; speeds up, changes no result but among equals

  bool curved() const { return kind == Kind::cylinder || kind == Kind::ellipsoid; }
};

Solid solid_of(const Capsule& s, const Mat3& R, const Vec3& p);
Solid solid_of(const Box& s, const Mat3& R, const Vec3& p);
Solid solid_of(const Cylinder& s, const Mat3& R, const Vec3& p);
Solid solid_of(const Ellipsoid& s, const Mat3& R, const Vec3& p);
Solid solid_of(const Convex& s, const Mat3& R, const Vec3& p);

/// The point farthest along m (any length but 0).
Vec3 support(const Solid& s, const Vec3& m);

/// A piece of surface that a witness may move on.
struct Feature {
  enum class Kind { vertex, edge, face, rim, side, surface };
  Kind kind;
  Vec3 x;       ///< the witness on it
  Vec3 t0, t1;  ///< unit tangents at x, across each other; zero where there are fewer
  Vec3 center;  ///< edge, side: middle; rim: of the circle; surface: x on the unit sphere
  double half;  ///< [m] edge: along t0, side: along t1

  int dim() const {
    if (kind == Kind::vertex) return 0;
    return kind == Kind::edge || kind == Kind::rim ? 1 : 2;
  }
};

/// Moves the witness by (u, v) along the tangents to first order, and stays on the feature.
void slide(const Solid& s, double u, double v, Feature& f);

/// Tangents and bends along n where the witness is.
Patch patch_of(const Solid& s, const Feature& f, const Vec3& n);

/// [m] how far the witness is past the feature's end; not above 0 within.
double beyond(const Feature& f);

Feature vertex_at(const Vec3& x);
/// On an ellipsoid, where it is farthest along m.
Feature surface_at(const Solid& s, const Vec3& m);
/// On a cylinder: its nearer rim, its side, at the point x of either.
Feature rim_at(const Solid& s, const Vec3& x);
Feature side_at(const Solid& s, const Vec3& x);
Feature edge_between(const Vec3& from, const Vec3& to);

/// What is near the farthest place along the unit m: features whose normals come within an angle
/// of about `width`, and flat faces by their normals alone.
struct Nearby {
  static constexpr int capacity = 32;
  Feature features[capacity];
  int count = 0;
  Vec3 normals[capacity];
  int faces = 0;

  void add(const Feature& f) {
    if (count < capacity) features[count++] = f;
  }
  void add_face(const Vec3& n) {
    if (faces < capacity) normals[faces++] = n;
  }
};
void find_nearby(const Solid& s, const Vec3& m, double width, Nearby& out);

/// The whole of a solid that is equally far along a normal of one of its faces or edges.
struct Flat {
  enum class Kind { polygon, disc };  ///< a polygon may have one corner, or two
  Kind kind = Kind::polygon;
  int corners = 0;
  Vec3 corner[4];                    ///< where there is no face
  const Hull::Face* face = nullptr;  ///< of a hull
  const Solid* solid = nullptr;
  Vec3 along = Vec3::Zero();                                       ///< the direction
  Vec3 center = Vec3::Zero(), u = Vec3::Zero(), v = Vec3::Zero();  ///< disc and two axes
  double radius = 0;

  Vec3 at(int k) const;
};
/// For a unit m; directions that rise by less than `level` count as level.
Flat flat_along(const Solid& s, const Vec3& m, double level);

}  // namespace saltus
