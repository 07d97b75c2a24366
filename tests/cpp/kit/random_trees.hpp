// Random numbers, masses and trees, also with balls, for tests; the same on every machine.
#pragma once

#include <cstdint>
#include <random>

#include "saltus/lagrangian/mass_model.hpp"
#include "saltus/tree/coordinates.hpp"
#include "saltus/tree/kinematics.hpp"

namespace saltus::test {

/// mt19937_64 is fixed by the C++ standard; the distributions of <random> are not, so we bring
/// ours.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(bits_() >> 11) * 0x1p-53;
  }
  int below(int n) { return static_cast<int>(bits_() % static_cast<std::uint64_t>(n)); }
  bool chance(double p) { return uniform(0, 1) < p; }

  VecX vector(int n, double size = 1) {
    VecX x(n);
    for (int i = 0; i < n; ++i) x[i] = uniform(-size, size);
    return x;
  }
  Vec3 vec3(double size = 1) { return vector(3, size); }
  Vec6 vec6(double size = 1) { return vector(6, size); }
  Vec3 unit() {
    Vec3 x;
    do {
      x = vec3();
    } while (x.norm() < 0.1);
    return x.normalized();
  }
  Mat3 rotation() { return Eigen::AngleAxisd(uniform(-3, 3), unit()).toRotationMatrix(); }
  Pose pose(double size = 1) { return {rotation(), vec3(size)}; }

  /// A body that can exist: its inertia is that of six particles.
  BodyInertia body() {
    BodyInertia out{0, Vec3::Zero(), Mat3::Zero()};
    for (int k = 0; k < 6; ++k) {
      out = weld(out, {uniform(0.1, 0.5), vec3(0.4), Mat3::Zero()});
    }
    return out;
  }

 private:
  std::mt19937_64 bits_;
};

struct TreeOptions {
  int joints = 6;
  double branch = 0.3;  ///< chance that a joint hangs on any earlier one, not on the last
  double new_tree = 0;  ///< chance that a joint hangs on the world
  double mimic = 0;     ///< chance that a joint shares the coordinate of an earlier one
};

/// A tree with its masses and a state.
struct RandomTree {
  Tree tree;
  MassModel mass;
  VecX q, v;
};

inline Joint random_joint(Random& random) {
  switch (random.below(4)) {
    case 0:
      return {Joint::Kind::prismatic, 0};
    case 1:
      return {Joint::Kind::helical, random.uniform(-0.3, 0.3)};
    default:
      return {Joint::Kind::revolute, 0};
  }
}

inline RandomTree random_tree(Random& random, const TreeOptions& options) {
  RandomTree out;
  for (int i = 0; i < options.joints; ++i) {
    int parent = i - 1;
    if (i > 0 && random.chance(options.branch)) parent = random.below(i);
    if (random.chance(options.new_tree)) parent = -1;
    Drive drive{out.tree.n_v, 1, 0};
    if (i > 0 && random.chance(options.mimic)) {
      drive = {random.below(out.tree.n_v), random.uniform(-2, 2), random.uniform(-1, 1)};
    }
    add_joint(out.tree, parent, random_joint(random), random.pose(0.5), drive);
    out.mass.body.push_back(random.body());
  }
  out.mass.gravity = random.vec3(10);
  out.q = random.vector(out.tree.n_v, 1.5);
  out.v = random.vector(out.tree.n_v, 2);
  return out;
}

struct BallTreeOptions {
  int joints = 6;       ///< a ball counts as one
  double ball = 0.5;    ///< chance that a joint is one
  double branch = 0.3;  ///< as in TreeOptions
  double new_tree = 0;
  double mimic = 0;
};

/// Where the next joint may hang: on any joint but the first two of a ball.
inline int random_parent(Random& random, const Tree& tree) {
  int parent = random.below(tree.joints());
  while (tree.joint[parent].is_ball() && tree.joint[parent].axis < 2) ++parent;
  return parent;
}

inline VecX random_coordinates(Random& random, const Tree& tree) {
  VecX q = random.vector(tree.n_q, 1.5);
  for (const Ball& ball : tree.balls) {
    q.segment<4>(ball.coordinate) = Quaternion(random.rotation()).normalized().coeffs();
  }
  return q;
}

inline RandomTree random_ball_tree(Random& random, const BallTreeOptions& options) {
  RandomTree out;
  Tree& tree = out.tree;
  std::vector<int> one_degree;  // velocities that a mimic joint may share
  for (int i = 0; i < options.joints; ++i) {
    int parent = tree.joints() - 1;
    if (i > 0 && random.chance(options.branch)) parent = random_parent(random, tree);
    if (random.chance(options.new_tree)) parent = -1;
    if (random.chance(options.ball)) {
      add_ball(tree, parent, random.pose(0.5));
      for (int k = 0; k < 2; ++k) out.mass.body.push_back({});
    } else {
      Drive drive{tree.n_v, 1, 0};
      if (!one_degree.empty() && random.chance(options.mimic)) {
        const int other = random.below(static_cast<int>(one_degree.size()));
        drive = {one_degree[static_cast<std::size_t>(other)], random.uniform(-2, 2),
                 random.uniform(-1, 1)};
      } else {
        one_degree.push_back(tree.n_v);
      }
      add_joint(tree, parent, random_joint(random), random.pose(0.5), drive);
    }
    out.mass.body.push_back(random.body());
  }
  out.mass.gravity = random.vec3(10);
  out.q = random_coordinates(random, tree);
  out.v = random.vector(tree.n_v, 2);
  return out;
}

/// Trees of up to nine joints; branching, several on the world, with mimic joints; every fifth is
/// eleven free bodies, which share lanes.
inline RandomTree varied_ball_tree(int k) {
  Random random(static_cast<std::uint64_t>(3000 + k));
  if (k % 5 != 4) {
    return random_ball_tree(random, {.joints = 1 + k % 9,
                                     .ball = k % 2 ? 0.4 : 0.7,
                                     .branch = 0.1 * (k % 7),
                                     .new_tree = k % 3 == 0 ? 0.2 : 0,
                                     .mimic = k % 5 == 1 ? 0.4 : 0});
  }
  RandomTree out;
  for (int body = 0; body < 11; ++body) {
    int parent = -1;
    for (int axis = 0; axis < 3; ++axis) {
      const Pose X{random.rotation(), random.vec3(0.5)};
      parent = add_joint(out.tree, parent, {Joint::Kind::prismatic, 0}, X, {out.tree.n_v, 1, 0});
    }
    parent = add_ball(out.tree, parent, random.pose(0.5));
    for (int i = 0; i < 5; ++i) out.mass.body.push_back({});
    out.mass.body.push_back(random.body());
    add_joint(out.tree, parent, {Joint::Kind::revolute, 0}, random.pose(), {out.tree.n_v, 1, 0});
    out.mass.body.push_back(random.body());
  }
  out.mass.gravity = random.vec3(10);
  out.q = random_coordinates(random, out.tree);
  out.v = random.vector(out.tree.n_v, 2);
  return out;
}

/// q (+) x.
inline VecX moved(const Tree& tree, const VecX& q, const VecX& x) {
  VecX out(tree.n_q);
  integrate(tree, q, 1, x, out);
  return out;
}

}  // namespace saltus::test
