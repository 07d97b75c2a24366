#include <cmath>

#include "collision/shapes/facts.hpp"

namespace saltus {

double ball_of(const Capsule& s) { return s.half_length + s.radius; }
double size_of(const Capsule& s) { return s.radius; }

std::string flaw_of(const Capsule& s) {  // of length 0 it is a ball
  if (s.half_length == 0) return flaw_of_size({s.radius, s.radius, s.radius});
  return flaw_of_size({s.radius, s.radius, s.half_length});
}

/// A cylinder, and a ball cut in halves that are moved to its ends. The centre of mass of half a
/// ball is 3/8 r from its flat face.
Homogeneous homogeneous_of(const Capsule& s, double mass) {
  const double r = s.radius, l = s.half_length;
  const Homogeneous ball = homogeneous_of(Sphere{r}, mass);
  if (l == 0) return ball;
  const double caps = mass / (1 + 1.5 * l / r), rod = mass - caps;  // volumes 4/3 r^3 to 2 r^2 l
  const double along = (rod / 2 + 0.4 * caps) * r * r;
  const double across = rod * (r * r / 4 + l * l / 3) + caps * (0.4 * r * r + l * l + 0.75 * l * r);
  return {ball.volume + homogeneous_of(Cylinder{r, l}, rod).volume, Vec3::Zero(),
          Vec3(across, across, along).asDiagonal()};
}

Core core_of(const Capsule& s) { return {s.radius, s.half_length}; }
Vec3 brick_of(const Capsule& s) { return {0, 0, s.half_length}; }
Capsule axis_of(const Capsule& s) { return s; }

PartCounts parts_of(const Capsule&) { return {.corners = 2, .edges = 1}; }

PartOfShape corner_of(const Capsule& s, int k) {
  const double z = k == 0 ? 1 : -1;
  return point({sign_name(z)}, s.radius, z * s.half_length * Vec3::UnitZ());
}

PartOfShape edge_of(const Capsule& s, int) { return {"axis", s}; }

/// The distance from its segment, less the radius.
///
///   |c_z| <= half_length   side: rho = |(c_x, c_y)|, F = (I - z z^T - n n^T)/rho
///   beyond                 cap:  r = distance from the segment's end, F = (I - n n^T)/r
///
/// On the segment n is the x axis and F = 0.
PointDistance distance_of(const Capsule& s, const Vec3& c) {
  if (std::abs(c.z()) <= s.half_length) return distance_from_line(c, 2, Vec3::UnitX(), s.radius);
  const Vec3 end(0, 0, std::copysign(s.half_length, c.z()));
  return distance_from_point(c - end, Vec3::UnitX(), s.radius);
}

}  // namespace saltus
