// Two shapes on or near each other, and the gaps of all their parts.
#pragma once

#include <cmath>
#include <limits>

#include "collision/gap_scene.hpp"

namespace saltus::testing_scene {

/// The hull of a few points: its edges are listed against those of any other shape.
inline Convex random_gem(Random& random) {
  std::vector<Vec3> points;
  for (int k = 4 + random.index(4); k > 0; --k) points.push_back(0.5 * random.direction());
  return test::hull_of(points);
}

/// As random_shape; "gem" is a convex one of a few corners, "prism" a flat one of six sides.
inline Shape part_shape(const std::string& kind, Random& random) {
  if (kind == "gem") return random_gem(random);
  if (kind != "prism") return random_shape(kind, random);
  std::vector<Vec3> points;
  for (int k = 0; k < 6; ++k) {
    const double angle = k * std::numbers::pi / 3;
    points.emplace_back(0.4 * std::cos(angle), 0.4 * std::sin(angle), 0.2);
    points.emplace_back(0.4 * std::cos(angle), 0.4 * std::sin(angle), -0.2);
  }
  return test::hull_of(points);
}

inline const std::vector<std::pair<std::string, std::string>>& kinds_with_parts() {
  static const std::vector<std::pair<std::string, std::string>> kinds = [] {
    const std::vector<std::string> all = {"capsule", "box", "cylinder", "gem", "prism", "convex"};
    std::vector<std::pair<std::string, std::string>> out;
    for (const std::string& a : all) {
      for (const std::string& b : all) {
        if (a <= b) out.emplace_back(a, b);
      }
      out.emplace_back(a, "half_space");
    }
    return out;
  }();
  return kinds;
}

struct Part {
  std::string name;
  Pair pair;
  Gap gap;
  bool silent;
};

/// Two shapes and where they are.
struct Bodies {
  Placed at;
  std::vector<PlacedShape> shapes;
  Tree tree;

  explicit Bodies(const Placed& placed) : at(placed) {
    for (int i = 0; i < 2; ++i) add_joint(tree, -1, {}, {}, {i, 1, 0});
    const bool plane = std::holds_alternative<HalfSpace>(at.b);
    shapes = {place(at.a, 0, {}), place(at.b, plane ? -1 : 1, {})};
    shapes[0].name = "a";
    shapes[1].name = "b";
  }
  const Pose& pose(int shape) const { return shape == 0 ? at.X_WA : at.X_WB; }
  Part part(const Pair& pair) const {
    const Pose A = pose(pair.a) * pair.on_a.X_JG, B = pose(pair.b) * pair.on_b.X_JG;
    const Gap g = part_gap(pair, A, B);
    return {pair_name(shapes, pair), pair, g, is_silent(pair, A, B, g)};
  }
  std::vector<Part> parts() const {
    std::vector<Part> out;
    const int count = part_count(at.a, at.b);
    for (int k = 0; k < count; ++k) out.push_back(part(make_pair(tree, shapes, 0, 1, k)));
    return out;
  }
};

/// The least of the gaps that are not silent.
inline double least_of(const std::vector<Part>& parts) {
  double least = std::numeric_limits<double>::infinity();
  for (const Part& part : parts) {
    if (!part.silent) least = std::min(least, part.gap.phi);
  }
  return least;
}

/// Axes of one along axes of the other, in any order, turned about one of them by any angle, and
/// tilted by up to 0.1 or not at all.
inline Mat3 nearly_flat(Random& random) {
  const double quarter = std::numbers::pi / 2;
  Mat3 R = Mat3::Identity();
  for (int k = 0; k < 3; ++k) {
    R = R * Eigen::AngleAxisd(quarter * random.index(4), Vec3::Unit(k)).toRotationMatrix();
  }
  if (random.chance(0.7)) {
    const Vec3 axis = Vec3::Unit(random.index(3));
    R = Eigen::AngleAxisd(random.uniform(0, 4 * quarter), axis).toRotationMatrix() * R;
  }
  if (random.chance(0.3)) return R;
  const double tilt = std::pow(10, random.uniform(-13, -1));
  return Eigen::AngleAxisd(tilt, random.direction()).toRotationMatrix() * R;
}

/// Two shapes of the kinds at a distance `phi`, often flat on each other.
inline Placed random_touching(const std::pair<std::string, std::string>& kinds, double phi,
                              Random& random) {
  Placed x{part_shape(kinds.first, random),
           part_shape(kinds.second, random),
           {},
           {random.rotation(), Vec3::Zero()}};
  if (random.chance(0.3)) x.X_WB.R.setIdentity();
  x.X_WA.R = random.chance(0.3) ? random.rotation() : Mat3(x.X_WB.R * nearly_flat(random));
  x.X_WA.p = 0.6 * random.direction();
  for (int k = 0; k < 5; ++k) {  // out of an overlap n is not the same all the way
    const Gap g = x.gap();
    x = x.moved_by((phi - g.phi) * g.n_W);
  }
  return x;
}

}  // namespace saltus::testing_scene
