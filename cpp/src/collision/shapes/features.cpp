// How witnesses move on the features of a surface.
//
// Unit-speed curves: an edge bends nowhere, a rim or the round of a side by -w/r (w from the axis);
// a smooth surface tells itself.
#include "collision/shapes/features.hpp"

#include <cmath>

#include "collision/shapes/facts.hpp"

namespace saltus {

using Kind = Feature::Kind;

Feature vertex_at(const Vec3& x) {
  const Vec3 none = Vec3::Zero();
  return {Kind::vertex, x, none, none, none, 0, none, 0};
}

Feature edge_between(const Vec3& from, const Vec3& to) {
  const Vec3 middle = 0.5 * (from + to), none = Vec3::Zero();
  const double length = (to - from).norm();
  return {Kind::edge, middle, (to - from) / length, none, middle, 0.5 * length, none, 0};
}

Feature side_at(const Solid& s, const Vec3& x) {
  const Capsule axis = edge_capsule(*s.shape);
  const Vec3 z = s.R.col(2), t0 = z.cross(x - s.p).normalized();
  return {Kind::side, x, t0, z, s.p, axis.half_length, z, axis.radius};
}

Feature rim_at(const Solid& s, const Vec3& x) {
  Feature f = side_at(s, x);
  f.kind = Kind::rim;
  f.center += side(f.axis.dot(x - s.p)) * f.half * f.axis;
  f.t1 = Vec3::Zero();
  return f;
}

void slide(const Solid& s, double u, double v, Feature& f) {
  if (f.kind == Kind::vertex) return;
  if (f.kind == Kind::edge || f.kind == Kind::face) {
    f.x += u * f.t0 + v * f.t1;
    return;
  }
  if (f.kind == Kind::surface) return slide_on_surface(s, u * f.t0 + v * f.t1, f);
  const double angle = u / f.radius;
  const double along = f.kind == Kind::side ? f.axis.dot(f.x - f.center) + v : 0;
  const Vec3 w = f.t0.cross(f.axis);  // from the axis to x
  const Vec3 turned = (std::cos(angle) * w + std::sin(angle) * f.t0).normalized();
  f.t0 = f.axis.cross(turned);
  f.x = f.center + f.radius * turned + along * f.axis;
}

Patch patch_of(const Solid& s, const Feature& f, const Vec3& n) {
  if (f.kind == Kind::surface) return patch_of_surface(s, f, n);
  Patch out{.dim = f.dim(), .t0 = f.t0, .t1 = f.t1};
  if (f.kind == Kind::rim || f.kind == Kind::side) out.k00 = -n.dot(f.t0.cross(f.axis)) / f.radius;
  return out;
}

double beyond(const Feature& f) {
  if (f.kind == Kind::edge) return std::abs(f.t0.dot(f.x - f.center)) - f.half;
  if (f.kind == Kind::side) return std::abs(f.t1.dot(f.x - f.center)) - f.half;
  return 0;
}

Vec3 Flat::at(int k) const {
  if (is_disc()) return center + (k % 2 == 0 ? radius : -radius) * (k < 2 ? u : v);
  if (face == nullptr) return corner[k];
  const auto vertex = static_cast<std::size_t>(face->corners[static_cast<std::size_t>(k)]);
  return solid->p + solid->R * hull->vertices[vertex];
}

Feature flat_feature(const Flat& f, const Vec3& x, const Vec3& n) {
  Feature out = vertex_at(x);
  if (f.corners > 2) {
    out.kind = Kind::face;
    out.t0 = n.unitOrthogonal();
    out.t1 = n.cross(out.t0);
  } else if (f.corners == 2) {
    out = outline_feature(f, f.at(0), f.at(1), x);
  } else if (f.point == Kind::surface) {
    out = surface_at(*f.solid, f.along);
  } else if (f.point == Kind::rim) {
    out = rim_at(*f.solid, x);
  }
  out.x = x;
  return out;
}

Feature corner_feature(const Flat& f, const Vec3& x, const Vec3& n) {
  if (f.is_disc() || f.point == Kind::vertex) return vertex_at(x);
  Flat point = f;
  point.corners = 1;
  return flat_feature(point, x, n);
}

Feature outline_feature(const Flat& f, const Vec3& from, const Vec3& to, const Vec3& x) {
  Feature out = f.line == Kind::side ? side_at(*f.solid, x) : edge_between(from, to);
  out.x = x;
  return out;
}

void add_nearby_of_brick(const Vec3& half, const Solid& s, const Vec3& d, double width,
                         Nearby& out) {
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    if (!(half[i] > 0 && half[j] > 0)) continue;  // has no such face
    if (std::hypot(d[i], d[j]) < width) out.add_face(side(d[k]) * s.R.col(k));
  }
  const Vec3 corner(side(d.x()) * half.x(), side(d.y()) * half.y(), side(d.z()) * half.z());
  const auto loose = [&](int k) { return half[k] > 0 && std::abs(d[k]) < width; };
  for (int flip = 0; flip < 8; ++flip) {
    Vec3 x = corner;
    bool valid = true;
    for (int k = 0; k < 3; ++k) {
      if ((flip >> k & 1) == 0) continue;
      valid = valid && loose(k);
      x[k] = -x[k];
    }
    if (!valid) continue;
    out.add(vertex_at(s.p + s.R * x));
    for (int k = 0; k < 3; ++k) {
      if (!loose(k) || (flip >> k & 1) == 1) continue;
      Vec3 y = x;
      y[k] = -y[k];
      out.add(edge_between(s.p + s.R * x, s.p + s.R * y));
    }
  }
}

/// The + sides first; counterclockwise or clockwise.
void set_flat_of_brick(const Vec3& half, const Solid& s, const Vec3& d, double level, Flat& out) {
  int loose[3], count = 0;
  Vec3 x = half;
  for (int k = 0; k < 3; ++k) {
    const bool flat = std::abs(d[k]) <= level;
    if (!flat) x[k] *= side(d[k]);
    if (flat && half[k] > 0 && count < 2) loose[count++] = k;
  }
  out.corners = 1 << count;
  for (int i = 0; i < out.corners; ++i) {
    Vec3 y = x;
    if (count > 0 && (i == 1 || i == 2)) y[loose[0]] = -y[loose[0]];
    if (count > 1 && i >= 2) y[loose[1]] = -y[loose[1]];
    out.corner[i] = s.p + s.R * y;
  }
}

}  // namespace saltus
