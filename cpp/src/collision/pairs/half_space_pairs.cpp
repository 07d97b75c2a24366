// Solids over the half-space z <= 0: the lowest point x of the core, in closed form.
//
//   phi = n.(x - p_B) - radius,   m = -R_A^T n  (down, in a's axes),   x farthest along m
//
//   capsule     end:      h side(m_z) e_z
//   box         corner:   half_k side(m_k)
//   cylinder    rim:      radius w + h side(m_z) e_z,  w = (m_x, m_y)/rho;  bends by n.x_tt = rho/r
//   ellipsoid   surface:  r_k^2 m_k/|(r_k m_k)|;  bends by (t_i/r).(t_j/r)/|x/r^2|
//   convex      vertex
//
// The plane bends nowhere; a point, or a curve bent away from it, is all that M of curvature.cpp
// needs to be regular.
#include "collision/pairs/half_space_pairs.hpp"

#include <cmath>

#include "collision/gap/ellipsoid_patch.hpp"
#include "collision/gap/point_distance.hpp"

namespace saltus {
namespace {

constexpr double level = 4e-16;  // components of a turned unit vector are this uncertain

double side_of(double x) { return x < -level ? -1 : 1; }

/// x and its patch in a's frame.
Gap over_plane(const Pose& X_WA, const Vec3& x, double radius, const Patch& patch,
               const Pose& X_WB) {
  const Vec3 n = X_WB.R.col(2), x_W = X_WA.R * x;
  const double d = n.dot((X_WA.p - X_WB.p) + x_W);
  const Vec3 center = X_WA.p + x_W;
  return {.phi = d - radius,
          .n_W = n,
          .p_WA = center - radius * n,
          .p_WB = center - d * n,
          .center_W = center,
          .d = d,
          .a = in_world(X_WA.R, patch),
          .b = in_world(X_WB.R, face_across(2))};
}

Vec3 down(const Pose& X_WA, const Pose& X_WB) { return -(X_WA.R.transpose() * X_WB.R.col(2)); }

}  // namespace

Gap gap_between(const Capsule& a, const Pose& X_WA, const HalfSpace&, const Pose& X_WB) {
  const Vec3 end(0, 0, side_of(down(X_WA, X_WB).z()) * a.half_length);
  return over_plane(X_WA, end, a.radius, {}, X_WB);
}

Gap gap_between(const Box& a, const Pose& X_WA, const HalfSpace&, const Pose& X_WB) {
  const Vec3 m = down(X_WA, X_WB);
  const Vec3 sides(side_of(m.x()), side_of(m.y()), side_of(m.z()));
  return over_plane(X_WA, sides.cwiseProduct(a.half), 0, {}, X_WB);
}

Gap gap_between(const Cylinder& a, const Pose& X_WA, const HalfSpace&, const Pose& X_WB) {
  const Vec3 m = down(X_WA, X_WB);
  const double rho = std::hypot(m.x(), m.y()), z = side_of(m.z()) * a.half_length;
  if (rho <= level) return over_plane(X_WA, {a.radius, 0, z}, 0, {}, X_WB);
  const Vec3 w(m.x() / rho, m.y() / rho, 0);
  const Patch rim = {
      .dim = 1, .t0 = Vec3(-w.y(), w.x(), 0), .t1 = Vec3::Zero(), .k00 = rho / a.radius};
  return over_plane(X_WA, a.radius * w + Vec3(0, 0, z), 0, rim, X_WB);
}

Gap gap_between(const Ellipsoid& a, const Pose& X_WA, const HalfSpace&, const Pose& X_WB) {
  const Vec3 m = down(X_WA, X_WB);
  const Vec3 x = ellipsoid_support(a, m);
  return over_plane(X_WA, x, 0, ellipsoid_patch(a, x, -m), X_WB);
}

Gap gap_between(const Convex& a, const Pose& X_WA, const HalfSpace&, const Pose& X_WB) {
  const std::vector<Vec3>& v = a.hull->vertices;
  const Vec3 m = down(X_WA, X_WB);
  std::size_t lowest = 0;
  double depth = v[0].dot(m);
  for (std::size_t k = 1; k < v.size(); ++k) {
    const double here = v[k].dot(m);
    if (here <= depth + level * (std::abs(here) + std::abs(depth))) continue;
    lowest = k;
    depth = here;
  }
  return over_plane(X_WA, v[lowest], 0, {}, X_WB);
}

}  // namespace saltus
