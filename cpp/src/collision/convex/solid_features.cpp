// The features of a core near the place that is farthest along a direction m.
//
// A feature is near where m is within a small angle of its normals: an edge where m is nearly
// across it, a face where m is nearly its normal. Solid angles are small: only sines are compared.
#include <algorithm>
#include <cmath>

#include "collision/convex/solid.hpp"
#include "collision/gap/point_distance.hpp"

namespace saltus {
namespace {

using Kind = Feature::Kind;

/// Half lengths along three axes, of which a segment has one.
void nearby_box(const Solid& s, const Vec3& d, double width, Nearby& out) {
  const int first = s.kind == Solid::Kind::box ? 0 : 2;
  for (int k = first; k < 3 && first == 0; ++k) {
    const double other = std::hypot(d[(k + 1) % 3], d[(k + 2) % 3]);
    if (other < width) out.add_face(side(d[k]) * s.R.col(k));
  }
  const Vec3 corner(side(d.x()) * s.size.x(), side(d.y()) * s.size.y(), side(d.z()) * s.size.z());
  const auto loose = [&](int k) { return k >= first && std::abs(d[k]) < width; };
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
    for (int k = first; k < 3; ++k) {
      if (!loose(k) || (flip >> k & 1) == 1) continue;
      Vec3 y = x;
      y[k] = -y[k];
      if (s.size[k] > 0) out.add(edge_between(s.p + s.R * x, s.p + s.R * y));
    }
  }
}

void nearby_cylinder(const Solid& s, const Vec3& d, double width, Nearby& out) {
  const double rho = std::hypot(d.x(), d.y()), up = side(d.z());
  const Vec3 z = s.R.col(2);
  const Vec3 w = rho < no_length ? Vec3(s.R.col(0))
                                 : Vec3((d.x() / rho) * s.R.col(0) + (d.y() / rho) * s.R.col(1));
  if (rho < width) out.add_face(up * z);
  const bool level = std::abs(d.z()) < width && s.size.z() > 0;  // a disc has no side
  const Vec3 round = s.p + s.size.x() * w;
  if (level) out.add(side_at(s, round));
  out.add(rim_at(s, round + up * s.size.z() * z));
  if (level) out.add(rim_at(s, round - up * s.size.z() * z));
}

void nearby_hull(const Solid& s, const Vec3& d, double width, Nearby& out) {
  const Hull& hull = *s.hull;
  const double cosine = 1 - 0.5 * width * width;
  support(s, s.R * d);
  const auto row = static_cast<std::size_t>(s.hint);
  const Vec3 from = s.p + s.R * hull.vertices[row];
  out.add(vertex_at(from));
  for (int i = hull.first_neighbour[row]; i < hull.first_neighbour[row + 1]; ++i) {
    const Vec3& v =
        hull.vertices[static_cast<std::size_t>(hull.neighbour[static_cast<std::size_t>(i)])];
    const Vec3 e = v - hull.vertices[row];
    if (std::abs(e.dot(d)) > width * e.norm()) continue;
    out.add(edge_between(from, s.p + s.R * v));
    out.add(vertex_at(s.p + s.R * v));
  }
  for (const Hull::Face& face : hull.faces) {
    if (face.normal.dot(d) <= cosine) continue;
    out.add_face(s.R * face.normal);
    const std::size_t count = face.corners.size();
    for (std::size_t k = 0; k < count; ++k) {  // its edges away from that vertex
      const int i = face.corners[k], j = face.corners[(k + 1) % count];
      if (i == s.hint || j == s.hint) continue;
      const Vec3 x = s.p + s.R * hull.vertices[static_cast<std::size_t>(i)];
      out.add(edge_between(x, s.p + s.R * hull.vertices[static_cast<std::size_t>(j)]));
      if (count > 3) out.add(vertex_at(x));
    }
  }
}

void flat_hull(const Solid& s, const Vec3& d, double level, Flat& out) {
  const Hull& hull = *s.hull;
  for (const Hull::Face& face : hull.faces) {
    if ((face.normal - d).norm() > level) continue;
    out.face = &face;
    out.corners = static_cast<int>(face.corners.size());
    return;
  }
  support(s, s.R * d);
  const auto row = static_cast<std::size_t>(s.hint);
  out.corners = 1;
  out.corner[0] = s.p + s.R * hull.vertices[row];
  for (int i = hull.first_neighbour[row]; i < hull.first_neighbour[row + 1]; ++i) {
    const Vec3& v =
        hull.vertices[static_cast<std::size_t>(hull.neighbour[static_cast<std::size_t>(i)])];
    const Vec3 e = v - hull.vertices[row];
    if (std::abs(e.dot(d)) > level * e.norm()) continue;
    out.corners = 2;
    out.corner[1] = s.p + s.R * v;
  }
}

/// The + sides first; counterclockwise or clockwise.
void flat_box(const Solid& s, const Vec3& d, double level, Flat& out) {
  int loose[3], count = 0;
  Vec3 x = s.size;
  for (int k = 0; k < 3; ++k) {
    const bool flat = std::abs(d[k]) <= level;
    if (!flat) x[k] *= side(d[k]);
    if (flat && s.size[k] > 0 && count < 2) loose[count++] = k;
  }
  out.corners = 1 << count;
  for (int i = 0; i < out.corners; ++i) {
    Vec3 y = x;
    if (count > 0 && (i == 1 || i == 2)) y[loose[0]] = -y[loose[0]];
    if (count > 1 && i >= 2) y[loose[1]] = -y[loose[1]];
    out.corner[i] = s.p + s.R * y;
  }
}

void flat_cylinder(const Solid& s, const Vec3& d, double level, Flat& out) {
  const double rho = std::hypot(d.x(), d.y());
  if (rho <= level) {
    out.kind = Flat::Kind::disc;
    out.center = s.p + side(d.z()) * s.size.z() * s.R.col(2);
    out.u = s.R.col(0);
    out.v = s.R.col(1);
    out.radius = s.size.x();
    return;
  }
  const Vec3 w(d.x() / rho, d.y() / rho, 0), z = s.size.z() * Vec3::UnitZ();
  const bool ruling = std::abs(d.z()) <= level && s.size.z() > 0;
  out.corners = ruling ? 2 : 1;
  out.corner[0] = s.p + s.R * (s.size.x() * w + (ruling ? 1 : side(d.z())) * z);
  if (ruling) out.corner[1] = s.p + s.R * (s.size.x() * w - z);
}

}  // namespace

Feature vertex_at(const Vec3& x) {
  const Vec3 none = Vec3::Zero();
  return {Kind::vertex, x, none, none, none, 0};
}

Feature edge_between(const Vec3& from, const Vec3& to) {
  const Vec3 middle = 0.5 * (from + to);
  const double length = (to - from).norm();
  return {Kind::edge, middle, (to - from) / length, Vec3::Zero(), middle, 0.5 * length};
}

Feature side_at(const Solid& s, const Vec3& x) {
  const Vec3 z = s.R.col(2);
  return {Kind::side, x, z.cross(x - s.p).normalized(), z, s.p, s.size.z()};
}

Feature rim_at(const Solid& s, const Vec3& x) {
  Feature f = side_at(s, x);
  f.kind = Kind::rim;
  f.center += side(f.t1.dot(x - s.p)) * f.half * f.t1;
  f.t1 = Vec3::Zero();
  return f;
}

Vec3 Flat::at(int k) const {
  if (face == nullptr) return corner[k];
  const auto vertex = static_cast<std::size_t>(face->corners[static_cast<std::size_t>(k)]);
  return solid->p + solid->R * solid->hull->vertices[vertex];
}

void find_nearby(const Solid& s, const Vec3& m, double width, Nearby& out) {
  out.count = out.faces = 0;
  const Vec3 d = s.R.transpose() * m;
  if (s.kind == Solid::Kind::hull) return nearby_hull(s, d, width, out);
  if (s.kind == Solid::Kind::cylinder) return nearby_cylinder(s, d, width, out);
  if (s.kind != Solid::Kind::ellipsoid) return nearby_box(s, d, width, out);
  out.add(surface_at(s, m));
}

Flat flat_along(const Solid& s, const Vec3& m, double level) {
  Flat out;
  out.solid = &s;
  out.along = m;
  const Vec3 d = s.R.transpose() * m;
  if (s.kind == Solid::Kind::hull) {
    flat_hull(s, d, level, out);
  } else if (s.kind == Solid::Kind::cylinder) {
    flat_cylinder(s, d, level, out);
  } else if (s.kind == Solid::Kind::ellipsoid) {
    out.corners = 1;
    out.corner[0] = support(s, m);
  } else {
    flat_box(s, d, level, out);
  }
  return out;
}

}  // namespace saltus
