// Random shapes, poses, trees and pairs: the same on every machine, for a seed.
#pragma once

#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "kit/hulls.hpp"
#include "saltus/collision/contact.hpp"
#include "saltus/collision/pair_table.hpp"
#include "saltus/tree/coordinates.hpp"

namespace saltus::testing_scene {

struct Random {
  std::mt19937 engine;
  explicit Random(unsigned seed) : engine(seed) {}

  /// std::uniform_real_distribution may differ between standard libraries; this does not.
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine()) / 4294967296.0;
  }
  int index(int n) { return static_cast<int>(engine() % static_cast<unsigned>(n)); }
  bool chance(double p) { return uniform(0, 1) < p; }
  Vec3 vector(double scale) {
    return {uniform(-scale, scale), uniform(-scale, scale), uniform(-scale, scale)};
  }
  Vec3 direction() {
    Vec3 x = vector(1);
    while (x.norm() < 0.1 || x.norm() > 1) x = vector(1);
    return x.normalized();
  }
  Mat3 rotation() {
    return Eigen::AngleAxisd(uniform(-std::numbers::pi, std::numbers::pi), direction())
        .toRotationMatrix();
  }
  Pose pose(double scale) { return {rotation(), vector(scale)}; }
  VecX numbers(int n, double scale) {
    VecX x(n);
    for (double& value : x) value = uniform(-scale, scale);
    return x;
  }
};

/// The hull of 4 to 60 points in an ellipsoid, half of them on its surface: flat and round ones.
inline Convex random_convex(const Vec3& radii, Random& random) {
  std::vector<Vec3> points;
  for (int k = random.index(57) + 4; k > 0; --k) {
    points.push_back(radii.cwiseProduct(random.direction()) *
                     (k % 2 == 0 ? random.uniform(0, 1) : 1));
  }
  return test::hull_of(points);
}

/// A shape of the kind that `shape_name` calls so, with sizes of 0.1 to 0.6.
inline Shape random_shape(const std::string& kind, Random& random) {
  const auto size = [&] { return random.uniform(0.1, 0.6); };
  if (kind == "sphere") return Sphere{size()};
  if (kind == "capsule") return Capsule{size(), size()};
  if (kind == "box") return Box{Vec3(size(), size(), size())};
  if (kind == "cylinder") return Cylinder{size(), size()};
  if (kind == "half_space") return HalfSpace{};
  if (kind == "ellipsoid") return Ellipsoid{Vec3(size(), size(), size())};
  if (kind == "convex") return random_convex({size(), size(), size()}, random);
  throw std::invalid_argument("no random shape for kind " + kind);
}

struct TreeOptions {
  int joints = 4;
  double offset = 0.4;     ///< [m] greatest component of a placement
  double branching = 0.3;  ///< chance that a joint hangs on any earlier frame, not on the last
  double mimic = 0.2;      ///< chance that a joint is driven by an earlier coordinate
  double ball = 0;         ///< chance that a joint is a ball, which counts as one
};

/// The joint that carries what hangs on joint i: of a ball the third.
inline int carrier(const Tree& tree, int i) {
  return i >= 0 && tree.joint[i].is_ball() ? i + 2 - tree.joint[i].axis : i;
}

inline VecX random_coordinates(const Tree& tree, double scale, Random& random) {
  VecX q = random.numbers(tree.n_q, scale);
  for (const Ball& ball : tree.balls) {
    q.segment<4>(ball.coordinate) = Quaternion(random.rotation()).normalized().coeffs();
  }
  return q;
}

/// q (+) s dq.
inline VecX moved(const Tree& tree, const VecX& q, double s, const VecX& dq) {
  VecX out(tree.n_q);
  integrate(tree, q, s, dq, out);
  return out;
}

inline Tree random_tree(const TreeOptions& options, Random& random) {
  Tree tree;
  std::vector<int> shared;  // velocities that mimic joints may have
  for (int n = 0; n < options.joints; ++n) {
    const int i = tree.joints();
    const int parent =
        carrier(tree, random.chance(options.branching) ? random.index(i + 1) - 1 : i - 1);
    if (options.ball > 0 && random.chance(options.ball)) {
      add_ball(tree, parent, random.pose(options.offset));
      continue;
    }
    Joint joint{static_cast<Joint::Kind>(random.index(3)), 0};
    if (joint.kind == Joint::Kind::helical) joint.pitch = random.uniform(-0.3, 0.3);
    Drive drive{tree.n_v, 1, 0};
    if (!shared.empty() && random.chance(options.mimic)) {
      const int other = random.index(static_cast<int>(shared.size()));
      drive = {shared[static_cast<std::size_t>(other)], random.uniform(-2, 2),
               random.uniform(-1, 1)};
    } else {
      shared.push_back(drive.velocity);
    }
    add_joint(tree, parent, joint, random.pose(options.offset), drive);
  }
  return tree;
}

inline PlacedShape place(const Shape& shape, int joint, const Pose& X_JG) {
  PlacedShape placed;
  placed.shape = shape;
  placed.joint = joint;
  placed.X_JG = X_JG;
  return placed;
}

/// The two shapes as wholes.
inline Pair make_pair_of(const Tree& tree, const std::vector<PlacedShape>& shapes, int a, int b) {
  Pair pair;
  pair.a = a;
  pair.b = b;
  pair.on_a = shapes[a];
  pair.on_b = shapes[b];
  pair.chain = chain_between(tree, shapes[b].joint, shapes[a].joint);
  pair.touch = 1e-10;
  return pair;
}

/// The table of all pairs, and the pairs themselves, for small scenes.
inline PairTable table_of(const std::vector<PlacedShape>& shapes) {
  return {shapes, {std::vector<int>(shapes.size(), 0), {}, {}}};
}

inline std::vector<Pair> pairs_of(const Tree& tree, const std::vector<PlacedShape>& shapes,
                                  const PairTable& table) {
  std::vector<Pair> pairs;
  for (int k = 0; k < table.size(); ++k) {
    const PairTable::Key key = table.key(k);
    pairs.push_back(make_pair(tree, shapes, key.a, key.b, key.part));
  }
  return pairs;
}

/// Two shapes on joints of a tree.
struct Scene {
  Tree tree;
  std::vector<PlacedShape> shapes;
  Pair pair;
  VecX q;

  Gap gap_at(const VecX& configuration) const {
    Kinematics kin(tree);
    set_configuration(tree, configuration, kin);
    return pair_gap(tree, kin, pair);
  }
};

/// A shape of each kind on two joints, or the second on the world if it is a half-space.
inline Scene random_scene(const std::string& kind_a, const std::string& kind_b,
                          const TreeOptions& options, Random& random) {
  Scene scene;
  scene.tree = random_tree(options, random);
  const int joints = scene.tree.joints();
  const int joint_a = carrier(scene.tree, random.index(joints));
  int joint_b = kind_b == "half_space" ? -1 : random.index(joints + 1) - 1;
  joint_b = carrier(scene.tree, joint_b);
  if (joint_b == joint_a) joint_b = -1;
  const Shape a =
      kind_a == "sphere" ? Sphere{random.uniform(0.05, 0.2)} : random_shape(kind_a, random);
  scene.shapes = {place(a, joint_a, random.pose(options.offset)),
                  place(random_shape(kind_b, random), joint_b, random.pose(options.offset))};
  scene.pair = make_pair_of(scene.tree, scene.shapes, 0, 1);
  scene.q = random_coordinates(scene.tree, 1.5, random);
  return scene;
}

/// A sphere on one joint and a shape of the kind on another.
inline Scene random_scene(const std::string& kind, const TreeOptions& options, Random& random) {
  return random_scene("sphere", kind, options, random);
}

}  // namespace saltus::testing_scene
