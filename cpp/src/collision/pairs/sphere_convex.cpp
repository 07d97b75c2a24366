// A sphere's centre c from a polytope, e_f = n_f.c - offset_f its height over face f.
//
//   no e_f > 0           inside: the face with the greatest e_f, d = e_f, F = 0
//   over one face        (within the planes across its edges): d = e_f, F = 0
//   else                 the nearest edge or vertex; distance from a line or a point
//
// Over a face is decided for the highest faces only by trying: at most one holds.
#include "collision/pairs/sphere_convex.hpp"

#include <cmath>

#include "collision/gap/point_distance.hpp"

namespace saltus {
namespace {

bool is_over(const Vec3& c, const Hull& hull, const Hull::Face& face) {
  const std::size_t count = face.corners.size();
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3& from = hull.vertices[static_cast<std::size_t>(face.corners[k])];
    const Vec3& to = hull.vertices[static_cast<std::size_t>(face.corners[(k + 1) % count])];
    if ((to - from).cross(c - from).dot(face.normal) < 0) return false;
  }
  return true;
}

PointDistance distance_from_face(const Hull::Face& face, double e) {
  const Vec3 t = face.normal.unitOrthogonal();
  return {e, face.normal, {.dim = 2, .t0 = t, .t1 = face.normal.cross(t)}};
}

/// The nearest edge, or the vertex at its end.
PointDistance distance_from_edges(const Vec3& c, const Hull& hull, const Hull::Face& highest) {
  double least = -1;
  Vec3 v = Vec3::Zero(), t = Vec3::Zero();
  for (const Hull::Edge& edge : hull.edges) {
    const Vec3& from = hull.vertices[static_cast<std::size_t>(edge.from)];
    const Vec3& to = hull.vertices[static_cast<std::size_t>(edge.to)];
    const Vec3 e = to - from;
    const double along = e.dot(c - from), length = e.squaredNorm();
    const bool inner = along > 0 && along < length;
    Vec3 w = along > 0 ? c - to : c - from;
    if (inner) w = (c - from) - (along / length) * e;
    const double square = w.squaredNorm();
    if (least >= 0 && square >= least) continue;
    least = square;
    v = w;
    t = inner ? e : Vec3::Zero();
  }
  if (!t.isZero(0)) t.normalize();
  PointDistance out = distance_from_point(v, highest.normal);
  if (t.isZero(0) || out.d <= 0) return out;
  out.n = (out.n - t.dot(out.n) * t).normalized();  // v lost digits where it is short
  out.patch = {.dim = 1, .t0 = t, .t1 = Vec3::Zero()};
  return out;
}

PointDistance distance_from_hull(const Vec3& c, const Hull& hull) {
  const Hull::Face* highest = nullptr;
  double height = 0;
  for (const Hull::Face& face : hull.faces) {
    const double e = face.normal.dot(c) - face.offset;
    if (e > 0 && is_over(c, hull, face)) return distance_from_face(face, e);
    if (highest != nullptr && e <= height) continue;
    highest = &face;
    height = e;
  }
  if (height <= 0) return distance_from_face(*highest, height);
  return distance_from_edges(c, hull, *highest);
}

}  // namespace

Gap gap_between(const Sphere& a, const Pose& X_WA, const Convex& b, const Pose& X_WB) {
  return sphere_gap(a, X_WA, X_WB, distance_from_hull(in_frame(X_WB, X_WA.p), *b.hull));
}

}  // namespace saltus
