#include "collision/shapes/facts.hpp"
#include "saltus/tree/tree.hpp"

namespace saltus {

double ball_of(const Box& s) { return s.half.norm(); }
double size_of(const Box& s) { return s.half.minCoeff(); }
std::string flaw_of(const Box& s) { return flaw_of_size(s.half); }

Homogeneous homogeneous_of(const Box& b, double mass) {
  const Vec3 s = mass / 3 * b.half.cwiseAbs2();
  return {8 * b.half.prod(), Vec3::Zero(),
          Vec3(s.y() + s.z(), s.x() + s.z(), s.x() + s.y()).asDiagonal()};
}

Core core_of(const Box& s) { return {.length = s.half.norm()}; }
Vec3 brick_of(const Box& s) { return s.half; }

PartCounts parts_of(const Box&) { return {.corners = 8, .edges = 12, .faces = 6}; }

PartOfShape corner_of(const Box& box, int k) {
  const Vec3 sign(k & 1 ? -1 : 1, k & 2 ? -1 : 1, k & 4 ? -1 : 1);
  const std::string name = {sign_name(sign.x()), sign_name(sign.y()), sign_name(sign.z())};
  PartOfShape out = point(name, 0, sign.cwiseProduct(box.half));
  for (int i = 0; i < 3; ++i) out.inward.push_back(-sign[i] * Vec3::Unit(i));
  return out;
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

SeenFace face_of(const Box& box, const Vec3& c, int k) {
  const Vec3 n = (k % 2 == 0 ? 1 : -1) * Vec3::Unit(k / 2);
  return {n.dot(c) - box.half[k / 2], n};
}

/// e_k = |c_k| - half_k tells the nearest feature.
///
///   no e_k > 0    inside: the face with the greatest e_k, d = e_k <= 0, F = 0
///   one           face:   d = e_k,                                       F = 0
///   two           edge along the third axis t:  d = distance from it,    F = (I - t t^T - n n^T)/d
///   three         corner:                       d = distance from it,    F = (I - n n^T)/d
///
/// Of equally near faces the first of x, y, z counts, its + side at 0.
PointDistance distance_of(const Box& s, const Vec3& c) {
  const Vec3 e = c.cwiseAbs() - s.half, outside = e.cwiseMax(0);
  const int beyond = static_cast<int>((e.array() > 0).count());
  if (beyond < 2 || outside.norm() < no_length) {
    int k = 0;
    const double d = e.maxCoeff(&k);
    return {d, side(c[k]) * Vec3::Unit(k), face_across(k)};
  }
  const Vec3 v(side(c.x()) * outside.x(), side(c.y()) * outside.y(), side(c.z()) * outside.z());
  if (beyond == 3) return distance_from_point(v, Vec3::UnitX());
  int along = 0;
  e.minCoeff(&along);
  return distance_from_line(v, along, Vec3::UnitX());
}

}  // namespace saltus
