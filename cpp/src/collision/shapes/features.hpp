// A convex core that is placed, and the features of its surface: what a witness may move on.
#pragma once

#include "saltus/collision/shapes.hpp"

namespace saltus {

/// The core of a shape (facts.hpp), in axes parallel to the world's, about an origin common to both
/// solids of a pair.
struct Solid {
  const Shape* shape;  ///< outlives it
  Mat3 R;
  Vec3 p;
  double radius;         ///< [m] of the shape round this core
  double length;         ///< [m] from p about as far as its farthest point
  bool curved;           ///< has features that bend
  mutable int hint = 0;  ///< vertex to climb from; speeds up, changes no result but among equals
};

Solid solid_of(const Shape& shape, const Mat3& R, const Vec3& p);
Solid solid_of(Shape&& shape, const Mat3& R, const Vec3& p) = delete;

/// The point farthest along m (any length but 0).
Vec3 support(const Solid& s, const Vec3& m);

/// A piece of surface that a witness may move on.
struct Feature {
  enum class Kind { vertex, edge, face, rim, side, surface };
  Kind kind;
  Vec3 x;         ///< the witness on it
  Vec3 t0, t1;    ///< unit tangents at x, across each other; zero where there are fewer
  Vec3 center;    ///< edge, side: middle; rim: of the circle; surface: its shape's own
  double half;    ///< [m] edge: along t0, side: along t1
  Vec3 axis;      ///< rim, side: of the circle
  double radius;  ///< [m] likewise

  int dim() const {
    if (kind == Kind::vertex) return 0;
    return kind == Kind::edge || kind == Kind::rim ? 1 : 2;
  }
};

Feature vertex_at(const Vec3& x);
Feature edge_between(const Vec3& from, const Vec3& to);
/// Of a shape that has an axis: its nearer rim, its side, at the point x of either.
Feature rim_at(const Solid& s, const Vec3& x);
Feature side_at(const Solid& s, const Vec3& x);
/// Of a smooth shape, where it is farthest along m.
Feature surface_at(const Solid& s, const Vec3& m);

/// Moves the witness by (u, v) along the tangents to first order, and stays on the feature.
void slide(const Solid& s, double u, double v, Feature& f);

/// Tangents and bends along n where the witness is.
Patch patch_of(const Solid& s, const Feature& f, const Vec3& n);

/// [m] how far the witness is past the feature's end; not above 0 within.
double beyond(const Feature& f);

/// What is near the farthest place along the unit m: features whose normals come within an angle
/// of about `width`, and flat faces by their normals alone. Angles are small: only sines are
/// compared.
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

/// The whole of a solid that is equally far along a normal of one of its faces or edges: a polygon,
/// which may have one corner, or two, or a disc, of which the points on its axes count as corners:
/// they stay on the disc where it turns.
struct Flat {
  const Solid* solid = nullptr;
  Vec3 along = Vec3::Zero();  ///< the direction
  int corners = 0;
  Vec3 corner[4];                               ///< where there is no face
  const Hull* hull = nullptr;                   ///< of the face
  const Hull::Face* face = nullptr;             ///< of a hull
  Feature::Kind point = Feature::Kind::vertex;  ///< what a corner is: vertex, rim, surface
  Feature::Kind line = Feature::Kind::edge;     ///< what two corners bound: edge, side
  double radius = 0;                            ///< [m] of a disc
  Vec3 center = Vec3::Zero(), u = Vec3::Zero(), v = Vec3::Zero();  ///< disc and two axes

  bool is_disc() const { return radius > 0; }
  Vec3 at(int k) const;
};
/// For a unit m; directions that rise by less than `level` count as level.
Flat flat_along(const Solid& s, const Vec3& m, double level);

/// The feature of the solid at x: all of the flat; a corner; the outline between two corners.
Feature flat_feature(const Flat& f, const Vec3& x, const Vec3& n);
Feature corner_feature(const Flat& f, const Vec3& x, const Vec3& n);
Feature outline_feature(const Flat& f, const Vec3& from, const Vec3& to, const Vec3& x);

/// What a brick has, of which a segment and a point are some: half lengths along three axes, which
/// may be 0.
void add_nearby_of_brick(const Vec3& half, const Solid& s, const Vec3& d, double width,
                         Nearby& out);
void set_flat_of_brick(const Vec3& half, const Solid& s, const Vec3& d, double level, Flat& out);

}  // namespace saltus
