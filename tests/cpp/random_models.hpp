// Random numbers, trees and masses for tests; the same on every machine.
#pragma once

#include <cstdint>
#include <random>

#include "saltus/lagrangian/mass_model.hpp"
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

}  // namespace saltus::test
