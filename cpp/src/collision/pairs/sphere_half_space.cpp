// A sphere's centre c from the half-space z <= 0: d = c_z, F = 0.
#include "collision/pairs/sphere_half_space.hpp"

#include "collision/gap/point_distance.hpp"

namespace saltus {

Gap gap_between(const Sphere& a, const Pose& X_WA, const HalfSpace&, const Pose& X_WB) {
  return sphere_gap(a, X_WA, X_WB, {in_frame(X_WB, X_WA.p).z(), Vec3::UnitZ(), face_across(2)});
}

}  // namespace saltus
