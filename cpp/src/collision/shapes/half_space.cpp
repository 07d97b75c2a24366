#include <limits>

#include "collision/shapes/facts.hpp"

namespace saltus {

double ball_of(const HalfSpace&) { return std::numeric_limits<double>::infinity(); }
double size_of(const HalfSpace&) { return std::numeric_limits<double>::infinity(); }
std::string flaw_of(const HalfSpace&) { return ""; }

/// d = c_z, F = 0: the normal is the z axis on both sides of its face.
PointDistance distance_of(const HalfSpace&, const Vec3& c) {
  return {c.z(), Vec3::UnitZ(), face_across(2)};
}

}  // namespace saltus
