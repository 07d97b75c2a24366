// Supports of the five cores, and how witnesses move on the features of their surfaces.
//
// Unit-speed curves: an edge bends nowhere, a rim or the round of a cylinder's side by -w/r (w from
// the axis), an ellipsoid as in ellipsoid_patch.hpp, with
// x = r e, q = e/r for a point e of the unit sphere.
#include "collision/convex/solid.hpp"

#include <cmath>

#include "collision/gap/ellipsoid_patch.hpp"
#include "collision/gap/point_distance.hpp"

namespace saltus {
namespace {

using Kind = Feature::Kind;

Solid solid(Solid::Kind kind, const Vec3& size, const Mat3& R, const Vec3& p) {
  return {.kind = kind,
          .size = size,
          .hull = nullptr,
          .R = R,
          .p = p,
          .radius = 0,
          .length = size.norm()};
}

/// Climbs from neighbour to neighbour: a vertex without a farther neighbour is the farthest.
const Vec3& farthest_vertex(const Solid& s, const Vec3& d) {
  const Hull& hull = *s.hull;
  const auto vertex = [&](int k) -> const Vec3& {
    return hull.vertices[static_cast<std::size_t>(k)];
  };
  const int count = static_cast<int>(hull.vertices.size());
  int best = s.hint;
  double height = vertex(best).dot(d);
  for (int step = 0; step < count; ++step) {
    const int from = best;
    const auto row = static_cast<std::size_t>(from);
    for (int i = hull.first_neighbour[row]; i < hull.first_neighbour[row + 1]; ++i) {
      const int k = hull.neighbour[static_cast<std::size_t>(i)];
      const double here = vertex(k).dot(d);
      if (here <= height) continue;
      best = k;
      height = here;
    }
    if (best == from) break;
  }
  s.hint = best;
  return vertex(best);
}

Vec3 farthest(const Solid& s, const Vec3& d) {
  switch (s.kind) {
    case Solid::Kind::segment:
      return {0, 0, side(d.z()) * s.size.z()};
    case Solid::Kind::box:
      return {side(d.x()) * s.size.x(), side(d.y()) * s.size.y(), side(d.z()) * s.size.z()};
    case Solid::Kind::cylinder: {
      const double rho = std::sqrt(d.x() * d.x() + d.y() * d.y());
      const double z = side(d.z()) * s.size.z();
      if (rho < no_length) return {s.size.x(), 0, z};
      return {s.size.x() * (d.x() / rho), s.size.x() * (d.y() / rho), z};
    }
    case Solid::Kind::ellipsoid:
      return ellipsoid_support({s.size}, d);
    default:
      return farthest_vertex(s, d);
  }
}

/// The witness on an ellipsoid at the point e of the unit sphere, of any length here. Kept there it
/// tells the normal to rounding, however flat the ellipsoid.
void put(const Solid& s, const Vec3& e, Feature& f) {
  f.center = e.normalized();
  f.x = s.p + s.R * s.size.cwiseProduct(f.center);
  const Vec3 normal = s.R * f.center.cwiseQuotient(s.size).normalized();
  f.t0 = normal.unitOrthogonal();
  f.t1 = normal.cross(f.t0);
}

}  // namespace

Feature surface_at(const Solid& s, const Vec3& m) {
  Feature f = vertex_at(s.p);
  f.kind = Kind::surface;
  put(s, s.size.cwiseProduct(s.R.transpose() * m), f);
  return f;
}

Solid solid_of(const Capsule& s, const Mat3& R, const Vec3& p) {
  Solid out = solid(Solid::Kind::segment, {0, 0, s.half_length}, R, p);
  out.radius = s.radius;
  return out;
}
Solid solid_of(const Box& s, const Mat3& R, const Vec3& p) {
  return solid(Solid::Kind::box, s.half, R, p);
}
Solid solid_of(const Cylinder& s, const Mat3& R, const Vec3& p) {
  return solid(Solid::Kind::cylinder, {s.radius, s.radius, s.half_length}, R, p);
}
Solid solid_of(const Ellipsoid& s, const Mat3& R, const Vec3& p) {
  return solid(Solid::Kind::ellipsoid, s.radii, R, p);
}
Solid solid_of(const Convex& s, const Mat3& R, const Vec3& p) {
  // any vertex tells the scale: they are within a diameter of each other
  Solid out = solid(Solid::Kind::hull, s.hull->vertices[0].cwiseAbs(), R, p);
  for (const Vec3& v : {s.hull->vertices[1], s.hull->vertices[2], s.hull->vertices[3]}) {
    out.length = std::fmax(out.length, v.norm());
  }
  out.hull = s.hull.get();
  return out;
}

Vec3 support(const Solid& s, const Vec3& m) { return s.p + s.R * farthest(s, s.R.transpose() * m); }

void slide(const Solid& s, double u, double v, Feature& f) {
  if (f.kind == Kind::vertex) return;
  if (f.kind == Kind::edge || f.kind == Kind::face) {
    f.x += u * f.t0 + v * f.t1;
    return;
  }
  if (f.kind == Kind::surface) {  // over the unit sphere
    const Vec3 step = s.R.transpose() * (u * f.t0 + v * f.t1);
    return put(s, f.center + step.cwiseQuotient(s.size), f);
  }
  const double r = s.size.x(), angle = u / r;
  const Vec3 z = s.R.col(2);
  const double along = f.kind == Kind::side ? z.dot(f.x - f.center) + v : 0;
  const Vec3 w = f.t0.cross(z);  // from the axis to x
  const Vec3 turned = (std::cos(angle) * w + std::sin(angle) * f.t0).normalized();
  f.t0 = z.cross(turned);
  f.x = f.center + r * turned + along * z;
}

Patch patch_of(const Solid& s, const Feature& f, const Vec3& n) {
  if (f.kind == Kind::surface) {
    const Vec3 q = f.center.cwiseQuotient(s.size);
    const Vec3 a = (s.R.transpose() * f.t0).cwiseQuotient(s.size);
    const Vec3 b = (s.R.transpose() * f.t1).cwiseQuotient(s.size);
    const double bend = -(s.R.transpose() * n).dot(q) / q.squaredNorm();
    return {.dim = 2,
            .t0 = f.t0,
            .t1 = f.t1,
            .k00 = bend * a.squaredNorm(),
            .k01 = bend * a.dot(b),
            .k11 = bend * b.squaredNorm()};
  }
  Patch out{.dim = f.dim(), .t0 = f.t0, .t1 = f.t1};
  if (f.kind == Kind::rim || f.kind == Kind::side) {
    out.k00 = -n.dot(f.t0.cross(s.R.col(2))) / s.size.x();
  }
  return out;
}

double beyond(const Feature& f) {
  if (f.kind == Kind::edge) return std::abs(f.t0.dot(f.x - f.center)) - f.half;
  if (f.kind == Kind::side) return std::abs(f.t1.dot(f.x - f.center)) - f.half;
  return 0;
}

}  // namespace saltus
