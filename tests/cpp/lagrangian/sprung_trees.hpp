// Random trees, with balls, whose points are joined by springs and pulled at.
#pragma once

#include <cmath>

#include "kit/random_trees.hpp"

namespace saltus::test {

inline BodyPoint random_point(Random& random, const Tree& tree) {
  if (random.chance(0.25)) return {-1, random.vec3()};
  return {random_parent(random, tree), random.vec3(0.5)};
}

/// V = cos(a.q) of one-degree coordinates, and c.R e of the first ball.
inline PotentialFunction random_function(Random& random, const Tree& tree) {
  const VecX a = random.vector(tree.n_v);
  const Vec3 c = random.vec3(), e = random.vec3();
  const auto angle = [a, tree](const VecX& q) {
    double sum = 0;
    for (int k = 0; k < tree.n_v; ++k) sum += a[k] * q[tree.coordinate[k]];
    for (const Ball& ball : tree.balls) {
      for (int k = 0; k < 3; ++k) sum -= a[ball.velocity + k] * q[ball.coordinate];
    }
    return sum;
  };
  const auto slopes = [a, tree] {
    VecX out = a;
    for (const Ball& ball : tree.balls) out.segment<3>(ball.velocity).setZero();
    return out;
  };
  PotentialFunction out;
  out.name = "function";
  out.value = [=](const VecX& q) {
    const double V = std::cos(angle(q));
    return tree.balls.empty() ? V : V + c.dot(quaternion(tree.balls.front(), q) * e);
  };
  out.gradient = [=](const VecX& q, VecX& V_q) {
    V_q = -std::sin(angle(q)) * slopes();
    if (tree.balls.empty()) return;
    const Ball& ball = tree.balls.front();
    V_q.segment<3>(ball.velocity) += (quaternion(ball, q) * e).cross(c);
  };
  out.hessian = [=](const VecX& q, MatX& V_qq) {
    V_qq = -std::cos(angle(q)) * slopes() * slopes().transpose();
    if (tree.balls.empty()) return;
    const Ball& ball = tree.balls.front();
    const Vec3 Re = quaternion(ball, q) * e;
    for (int j = 0; j < 3; ++j) {
      V_qq.block<3, 1>(ball.velocity, ball.velocity + j) += Vec3::Unit(j).cross(Re).cross(c);
    }
  };
  return out;
}

inline Curve random_curve(Random& random) {
  std::vector<double> x, y;
  for (int k = 0; k < 6; ++k) {
    x.push_back(-2 + 0.8 * k);
    y.push_back(random.uniform(-3, 3));
  }
  return make_curve(x, y, std::array<double, 2>{random.uniform(-1, 1), random.uniform(-1, 1)});
}

/// Of `t`, springs between random points, one of them of length 0, forces, a curve where no knot is
/// near, and a function.
inline void add_potentials(std::uint64_t seed, bool has_functions, RandomTree& t) {
  Random random(seed);
  Potentials& all = t.mass.potentials;
  for (const double length : {0.0, 0.4, 1.5}) {
    BodyPoint a = random_point(random, t.tree), b = random_point(random, t.tree);
    if (a.joint == b.joint) a.joint = b.joint < 0 ? t.tree.joints() - 1 : -1;
    all.springs.push_back({"spring", a, b, random.uniform(1, 20), length});
  }
  all.forces.push_back({random_point(random, t.tree), random.vec3(5)});
  for (int c = 0; c < t.tree.n_v; ++c) {
    bool is_ball = false;
    for (const Ball& ball : t.tree.balls) is_ball |= c >= ball.velocity && c < ball.velocity + 3;
    if (is_ball) continue;
    all.curves.push_back(
        {c, random.uniform(0.5, 1.5), random.uniform(-0.2, 0.2), random_curve(random)});
    break;
  }
  if (has_functions) all.functions.push_back(random_function(random, t.tree));
}

}  // namespace saltus::test
