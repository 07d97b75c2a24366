// A sphere's centre c from a capsule: the distance from its segment, less the radius.
//
//   |c_z| <= half_length   side: rho = |(c_x, c_y)|, F = (I - z z^T - n n^T)/rho
//   beyond                 cap:  r = distance from the segment's end, F = (I - n n^T)/r
#include "collision/pairs/sphere_capsule.hpp"

#include <cmath>

#include "collision/gap/point_distance.hpp"

namespace saltus {
namespace {

PointDistance distance_from_segment(const Vec3& c, double half_length) {
  if (std::abs(c.z()) <= half_length) return distance_from_line(c, 2, Vec3::UnitX());
  const Vec3 end(0, 0, std::copysign(half_length, c.z()));
  return distance_from_point(c - end, Vec3::UnitX());
}

}  // namespace

Gap gap_between(const Sphere& a, const Pose& X_WA, const Capsule& b, const Pose& X_WB) {
  PointDistance out = distance_from_segment(in_frame(X_WB, X_WA.p), b.half_length);
  out.d -= b.radius;
  out.radius = b.radius;
  return sphere_gap(a, X_WA, X_WB, out);
}

}  // namespace saltus
