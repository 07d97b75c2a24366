// A sphere's centre c from another sphere: d = |c| - r_b, F = (I - n n^T)/|c|.
#include "collision/pairs/sphere_sphere.hpp"

#include "collision/gap/point_distance.hpp"

namespace saltus {

Gap gap_between(const Sphere& a, const Pose& X_WA, const Sphere& b, const Pose& X_WB) {
  PointDistance out = distance_from_point(in_frame(X_WB, X_WA.p), Vec3::UnitZ());
  out.d -= b.radius;
  out.radius = b.radius;
  return sphere_gap(a, X_WA, X_WB, out);
}

}  // namespace saltus
