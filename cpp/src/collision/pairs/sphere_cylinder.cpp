// A sphere's centre c from a cylinder, in the half-plane through c and the axis z.
//
//   rho = |(c_x, c_y)|, w = unit vector away from the axis, t = z x w, s = sign of c_z
//   e_r = rho - radius, e_z = |c_z| - half_length
//   both > 0        rim:   d = |(e_r, e_z)|, n = (e_r w + e_z s z)/d
//   else e_r > e_z  side:  d = e_r, n = w, F = t t^T/rho
//   else            cap:   d = e_z, n = s z, F = 0
//
// The rim is a curve along t that bends by -w/radius; across it the distance curves with 1/d, along
// it with (n.w)/rho. Inside, both e < 0 and the nearer surface counts.
#include "collision/pairs/sphere_cylinder.hpp"

#include <cmath>

#include "collision/gap/point_distance.hpp"

namespace saltus {
namespace {

PointDistance distance_from_cylinder(const Vec3& c, const Cylinder& b) {
  const double rho = std::hypot(c.x(), c.y());
  const bool off_axis = rho > no_length;
  const Vec3 w = off_axis ? Vec3(c.x() / rho, c.y() / rho, 0) : Vec3(Vec3::UnitX());
  const Vec3 z(0, 0, side(c.z())), t(-w.y(), w.x(), 0);
  const double e_r = rho - b.radius, e_z = std::abs(c.z()) - b.half_length;
  const double d = std::hypot(e_r, e_z);
  if (e_r > 0 && e_z > 0 && d > no_length) {
    const Vec3 n = (e_r * w + e_z * z) / d;
    return {d, n, {.dim = 1, .t0 = t, .t1 = Vec3::Zero(), .k00 = -n.dot(w) / b.radius}};
  }
  if (e_r <= e_z) return {e_z, z, face_across(2)};
  if (!off_axis) return {e_r, w, face_across(0)};  // F = 0 where it is infinite
  return {e_r, w, {.dim = 2, .t0 = t, .t1 = Vec3::UnitZ(), .k00 = -1 / b.radius}};
}

}  // namespace

Gap gap_between(const Sphere& a, const Pose& X_WA, const Cylinder& b, const Pose& X_WB) {
  return sphere_gap(a, X_WA, X_WB, distance_from_cylinder(in_frame(X_WB, X_WA.p), b));
}

}  // namespace saltus
