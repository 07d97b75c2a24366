// A sphere's centre c from a cylinder, in the half-plane through c and the axis z.
//
//   rho = |(c_x, c_y)|, w = unit vector away from the axis, t = z x w, s = sign of c_z
//   e_r = rho - radius, e_z = |c_z| - half_length
//   both > 0        rim:   d = |(e_r, e_z)|, n = (e_r w + e_z s z)/d, k = 1/d, g = radius/(d rho)
//   else e_r > e_z  side:  d = e_r, n = w, F = t t^T/rho
//   else            cap:   d = e_z, n = s z, F = 0
//
// The rim is a ring. Across it the distance curves as about a point, with 1/d; along it as a cone
// about the axis whose generators lean by n, with (n.w)/rho = 1/d - g. The side curves along t
// only: k (I - n n^T) without its part along z. Inside, both e < 0 and the nearer surface counts.
#include "collision/sphere_cylinder.hpp"

#include <cmath>

#include "collision/point_distance.hpp"

namespace saltus {
namespace {

PointDistance distance_from_cylinder(const Vec3& c, const Cylinder& b) {
  const double rho = std::hypot(c.x(), c.y());
  const bool off_axis = rho > no_length;
  const Vec3 w = off_axis ? Vec3(c.x() / rho, c.y() / rho, 0) : Vec3(Vec3::UnitX());
  const Vec3 z(0, 0, side(c.z()));
  const double e_r = rho - b.radius, e_z = std::abs(c.z()) - b.half_length;
  const double d = std::hypot(e_r, e_z);
  if (e_r > 0 && e_z > 0 && d > no_length) {
    const Vec3 t(-w.y(), w.x(), 0);
    return {d, (e_r * w + e_z * z) / d, 1 / d, b.radius / (d * rho), t};
  }
  if (e_r <= e_z) return {e_z, z};
  if (!off_axis) return {e_r, w};
  return {e_r, w, 1 / rho, 1 / rho, Vec3::UnitZ()};
}

}  // namespace

Gap gap_between(const Sphere& a, const Pose& X_WA, const Cylinder& b, const Pose& X_WB) {
  return sphere_gap(a, X_WA, X_WB, distance_from_cylinder(in_frame(X_WB, X_WA.p), b));
}

}  // namespace saltus
