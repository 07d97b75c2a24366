#include <cmath>
#include <numbers>

#include "collision/shapes/facts.hpp"

namespace saltus {

double ball_of(const Cylinder& s) { return std::hypot(s.radius, s.half_length); }
double size_of(const Cylinder& s) { return std::fmin(s.radius, s.half_length); }

std::string flaw_of(const Cylinder& s) { return flaw_of_size({s.radius, s.radius, s.half_length}); }

Homogeneous homogeneous_of(const Cylinder& s, double mass) {
  const double along = 0.5 * mass * s.radius * s.radius;
  const double across = along / 2 + mass / 3 * s.half_length * s.half_length;
  return {2 * std::numbers::pi * s.radius * s.radius * s.half_length, Vec3::Zero(),
          Vec3(across, across, along).asDiagonal()};
}

Core core_of(const Cylinder& s) {
  return {.length = Vec3(s.radius, s.radius, s.half_length).norm(), .curved = true};
}

Capsule axis_of(const Cylinder& s) { return {s.radius, s.half_length}; }

Vec3 farthest_of(const Cylinder& s, const Vec3& d) {
  const double rho = std::sqrt(d.x() * d.x() + d.y() * d.y()), z = side(d.z()) * s.half_length;
  if (rho < no_length) return {s.radius, 0, z};
  return {s.radius * (d.x() / rho), s.radius * (d.y() / rho), z};
}

void nearby_of(const Cylinder& c, const Solid& s, const Vec3& d, double width, Nearby& out) {
  const double rho = std::hypot(d.x(), d.y()), up = side(d.z());
  const Vec3 z = s.R.col(2);
  const Vec3 w = rho < no_length ? Vec3(s.R.col(0))
                                 : Vec3((d.x() / rho) * s.R.col(0) + (d.y() / rho) * s.R.col(1));
  if (rho < width) out.add_face(up * z);
  const bool level = std::abs(d.z()) < width && c.half_length > 0;  // a disc has no side
  const Vec3 round = s.p + c.radius * w;
  if (level) out.add(side_at(s, round));
  out.add(rim_at(s, round + up * c.half_length * z));
  if (level) out.add(rim_at(s, round - up * c.half_length * z));
}

void flat_of(const Cylinder& c, const Solid& s, const Vec3& d, double level, Flat& out) {
  const double rho = std::hypot(d.x(), d.y());
  if (rho <= level) {
    out.corners = 4;
    out.center = s.p + side(d.z()) * c.half_length * s.R.col(2);
    out.u = s.R.col(0);
    out.v = s.R.col(1);
    out.radius = c.radius;
    return;
  }
  const Vec3 w(d.x() / rho, d.y() / rho, 0), z = c.half_length * Vec3::UnitZ();
  const bool ruling = std::abs(d.z()) <= level && c.half_length > 0;
  out.point = Feature::Kind::rim;
  out.line = Feature::Kind::side;
  out.corners = ruling ? 2 : 1;
  out.corner[0] = s.p + s.R * (c.radius * w + (ruling ? 1 : side(d.z())) * z);
  if (ruling) out.corner[1] = s.p + s.R * (c.radius * w - z);
}

PartCounts parts_of(const Cylinder&) { return {.corners = 8, .edges = 1, .rims = 2, .faces = 3}; }

/// A rim has no corners; four points of it bear a cylinder that stands, where its lowest point
/// can be anywhere.
PartOfShape corner_of(const Cylinder& s, int k) {
  const double z = k < 4 ? 1 : -1, angle = (k % 4) * std::numbers::pi / 2;
  const Vec3 w(std::cos(angle), std::sin(angle), 0), t(-w.y(), w.x(), 0);
  std::string name(1, sign_name(z));
  name.append(std::to_string(90 * (k % 4)));
  PartOfShape out = point(name, 0, s.radius * w + z * s.half_length * Vec3::UnitZ());
  out.out = z * Vec3::UnitZ();
  out.inward = {-z * Vec3::UnitZ(), -w, t, -t};
  return out;
}

PartOfShape edge_of(const Cylinder& s, int) { return {"axis", s}; }

PartOfShape rim_of(const Cylinder& s, int k) {
  const double z = k == 0 ? 1 : -1;
  return {std::string("rim") + sign_name(z),
          Cylinder{s.radius, 0},
          {Mat3::Identity(), z * s.half_length * Vec3::UnitZ()},
          z * Vec3::UnitZ(),
          {-z * Vec3::UnitZ()}};
}

/// Its caps, and its side where that is nearest.
SeenFace face_of(const Cylinder& s, const Vec3& c, int k) {
  if (k < 2) {
    const double z = k == 0 ? 1 : -1;
    return {z * c.z() - s.half_length, z * Vec3::UnitZ()};
  }
  const double rho = std::hypot(c.x(), c.y());
  if (rho < no_length) return {-s.radius, Vec3::UnitX()};
  return {rho - s.radius, Vec3(c.x() / rho, c.y() / rho, 0), -1 / s.radius};
}

/// In the half-plane through c and the axis z.
///
///   rho = |(c_x, c_y)|, w = unit vector away from the axis, t = z x w, s = sign of c_z
///   e_r = rho - radius, e_z = |c_z| - half_length
///   both > 0        rim:   d = |(e_r, e_z)|, n = (e_r w + e_z s z)/d
///   else e_r > e_z  side:  d = e_r, n = w, F = t t^T/rho
///   else            cap:   d = e_z, n = s z, F = 0
///
/// The rim is a curve along t that bends by -w/radius; across it the distance curves with 1/d,
/// along it with (n.w)/rho. Inside, both e < 0 and the nearer surface counts, the cap if equal, its
/// + side at 0; on the axis the side's n is the x axis and F = 0.
PointDistance distance_of(const Cylinder& b, const Vec3& c) {
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

/// radius w + half_length side(m_z) e_z,  w = (m_x, m_y)/rho; the rim bends by rho/radius.
Lowest lowest_of(const Cylinder& s, const Vec3& m) {
  const double rho = std::hypot(m.x(), m.y());
  const double z = (m.z() < -level_sine ? -1 : 1) * s.half_length;
  if (rho <= level_sine) return {{s.radius, 0, z}, {}};
  const Vec3 w(m.x() / rho, m.y() / rho, 0);
  return {s.radius * w + Vec3(0, 0, z),
          {.dim = 1, .t0 = Vec3(-w.y(), w.x(), 0), .t1 = Vec3::Zero(), .k00 = rho / s.radius}};
}

}  // namespace saltus
