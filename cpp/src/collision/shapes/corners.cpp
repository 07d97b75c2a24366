#include "collision/shapes/corners.hpp"
#include "saltus/tree/tree.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace saltus {
namespace {

char sign_name(double x) { return x < 0 ? '-' : '+'; }

PartOfShape point(std::string name, double radius, const Vec3& p) {
  return {std::move(name), Sphere{radius}, {Mat3::Identity(), p}, Vec3::Zero(), {}};
}

PartOfShape corner_of(const Box& box, int k) {
  const Vec3 sign(k & 1 ? -1 : 1, k & 2 ? -1 : 1, k & 4 ? -1 : 1);
  const std::string name = {sign_name(sign.x()), sign_name(sign.y()), sign_name(sign.z())};
  PartOfShape out = point(name, 0, sign.cwiseProduct(box.half));
  for (int i = 0; i < 3; ++i) out.inward.push_back(-sign[i] * Vec3::Unit(i));
  return out;
}

PartOfShape corner_of(const Capsule& capsule, int k) {
  const double z = k == 0 ? 1 : -1;
  return point({sign_name(z)}, capsule.radius, z * capsule.half_length * Vec3::UnitZ());
}

PartOfShape corner_of(const Convex& convex, int k) {
  const Hull& hull = *convex.hull;
  PartOfShape out = point(std::string("v").append(std::to_string(k)), 0, hull.vertices[k]);
  for (int i = hull.first_neighbour[k]; i < hull.first_neighbour[k + 1]; ++i) {
    out.inward.push_back((hull.vertices[hull.neighbour[i]] - hull.vertices[k]).normalized());
  }
  return out;
}

// A rim has no corners; four points of it bear a cylinder that stands, where its lowest point
// can be anywhere.
PartOfShape corner_of(const Cylinder& cylinder, int k) {
  const double z = k < 4 ? 1 : -1;
  const double angle = (k % 4) * std::numbers::pi / 2;
  std::string name(1, sign_name(z));
  name.append(std::to_string(90 * (k % 4)));
  const Vec3 w(std::cos(angle), std::sin(angle), 0), t(-w.y(), w.x(), 0);
  PartOfShape out = point(name, 0, cylinder.radius * w + z * cylinder.half_length * Vec3::UnitZ());
  out.out = z * Vec3::UnitZ();
  out.inward = {-z * Vec3::UnitZ(), -w, t, -t};
  return out;
}

/// Between faces with the unit normals m and n: 1/cos of half the angle between them long.
Vec3 between(const Vec3& m, const Vec3& n) {
  const Vec3 sum = m + n;
  return 2 / sum.squaredNorm() * sum;
}

PartOfShape edge_of(const Box& box, int k) {
  const int along = k / 4, i = (along + 1) % 3, j = (along + 2) % 3;
  const double sign_i = k & 1 ? -1 : 1, sign_j = k & 2 ? -1 : 1;
  const Vec3 out = between(sign_i * Vec3::Unit(i), sign_j * Vec3::Unit(j));
  Pose X_GP;
  X_GP.R = rotation_z_to(Vec3::Unit(along));
  X_GP.p = sign_i * box.half[i] * Vec3::Unit(i) + sign_j * box.half[j] * Vec3::Unit(j);
  std::string name = "...";
  name[along] = "xyz"[along];
  name[i] = sign_name(sign_i);
  name[j] = sign_name(sign_j);
  return {name, Capsule{0, box.half[along]}, X_GP, X_GP.R.transpose() * out, {}};
}

PartOfShape edge_of(const Convex& convex, int k) {
  const Hull& hull = *convex.hull;
  const Hull::Edge& edge = hull.edges[k];
  const Vec3 &from = hull.vertices[edge.from], &to = hull.vertices[edge.to];
  const Vec3 out = between(hull.faces[edge.left].normal, hull.faces[edge.right].normal);
  const Pose X_GP{rotation_z_to((to - from).normalized()), (from + to) / 2};
  return {std::string("e").append(std::to_string(k)),
          Capsule{0, (to - from).norm() / 2},
          X_GP,
          X_GP.R.transpose() * out,
          {}};
}

}  // namespace

int corner_count(const Shape& shape) {
  if (std::holds_alternative<Box>(shape) || std::holds_alternative<Cylinder>(shape)) return 8;
  if (std::holds_alternative<Capsule>(shape)) return 2;
  if (const auto* convex = std::get_if<Convex>(&shape)) {
    return static_cast<int>(convex->hull->vertices.size());
  }
  return 0;
}

PartOfShape corner(const Shape& shape, int k) {
  assert(k < corner_count(shape));
  if (const auto* box = std::get_if<Box>(&shape)) return corner_of(*box, k);
  if (const auto* capsule = std::get_if<Capsule>(&shape)) return corner_of(*capsule, k);
  if (const auto* convex = std::get_if<Convex>(&shape)) return corner_of(*convex, k);
  return corner_of(std::get<Cylinder>(shape), k);
}

int edge_count(const Shape& shape) {
  if (std::holds_alternative<Box>(shape)) return 12;
  if (const auto* convex = std::get_if<Convex>(&shape)) {
    return static_cast<int>(convex->hull->edges.size());
  }
  return std::holds_alternative<Capsule>(shape) || std::holds_alternative<Cylinder>(shape) ? 1 : 0;
}

PartOfShape edge(const Shape& shape, int k) {
  assert(k < edge_count(shape));
  if (const auto* box = std::get_if<Box>(&shape)) return edge_of(*box, k);
  if (const auto* convex = std::get_if<Convex>(&shape)) return edge_of(*convex, k);
  return {"axis", shape, {}, Vec3::Zero(), {}};
}

int rim_count(const Shape& shape) { return std::holds_alternative<Cylinder>(shape) ? 2 : 0; }

PartOfShape rim(const Shape& shape, int k) {
  assert(k < rim_count(shape));
  const auto& cylinder = std::get<Cylinder>(shape);
  const double z = k == 0 ? 1 : -1;
  return {std::string("rim") + sign_name(z),
          Cylinder{cylinder.radius, 0},
          {Mat3::Identity(), z * cylinder.half_length * Vec3::UnitZ()},
          z * Vec3::UnitZ(),
          {-z * Vec3::UnitZ()}};
}

}  // namespace saltus
