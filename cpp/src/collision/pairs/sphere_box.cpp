// A sphere's centre c from a box: e_k = |c_k| - half_k tells the nearest feature.
//
//   no e_k > 0    inside: the face with the greatest e_k, d = e_k <= 0, F = 0
//   one           face:   d = e_k,                                       F = 0
//   two           edge along the third axis t:  d = distance from it,    F = (I - t t^T - n n^T)/d
//   three         corner:                       d = distance from it,    F = (I - n n^T)/d
#include "collision/pairs/sphere_box.hpp"

#include "collision/gap/point_distance.hpp"

namespace saltus {
namespace {

PointDistance distance_from_face(const Vec3& c, const Vec3& e) {
  int k = 0;
  const double d = e.maxCoeff(&k);
  return {d, side(c[k]) * Vec3::Unit(k), face_across(k)};
}

PointDistance distance_from_box(const Vec3& c, const Vec3& half) {
  const Vec3 e = c.cwiseAbs() - half;
  const Vec3 outside = e.cwiseMax(0);
  const int beyond = static_cast<int>((e.array() > 0).count());
  if (beyond < 2 || outside.norm() < no_length) return distance_from_face(c, e);
  const Vec3 v(side(c.x()) * outside.x(), side(c.y()) * outside.y(), side(c.z()) * outside.z());
  if (beyond == 3) return distance_from_point(v, Vec3::UnitX());
  int along = 0;
  e.minCoeff(&along);
  return distance_from_line(v, along, Vec3::UnitX());
}

}  // namespace

Gap gap_between(const Sphere& a, const Pose& X_WA, const Box& b, const Pose& X_WB) {
  return sphere_gap(a, X_WA, X_WB, distance_from_box(in_frame(X_WB, X_WA.p), b.half));
}

}  // namespace saltus
