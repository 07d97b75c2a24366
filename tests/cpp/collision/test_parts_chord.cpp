// First hits of parts on a chord: of all parts together, no touch of two shapes is missed; and of a
// body that rests on one place of its rim, not that of the other.
#include <gtest/gtest.h>

#include "collision/parts_scene.hpp"
#include "saltus/collision/chord.hpp"

namespace saltus {
namespace {

using testing_scene::kinds_with_parts;
using testing_scene::place;
using testing_scene::Random;
using Outcome = ChordHit::Outcome;
using Names = std::pair<std::string, std::string>;

/// Two shapes on a tree, and a chord.
struct Flight {
  Tree tree;
  std::vector<PlacedShape> shapes;
  VecX q, dq;

  std::vector<Pair> parts() const {
    return testing_scene::pairs_of(tree, shapes, testing_scene::table_of(shapes));
  }
  /// Gap of the pair at s, infinite where it is silent.
  double gap(const Pair& pair, double s) const {
    Kinematics kin(tree);
    set_configuration(tree, q + s * dq, kin);
    const Gap g = pair_gap(tree, kin, pair);
    return is_silent(tree, kin, pair, g) ? std::numeric_limits<double>::infinity() : g.phi;
  }
  double distance(double s) const { return gap(make_solid_pair(tree, shapes, 0, 1), s); }
  ChordHit hit(const Pair& pair) const { return first_hit_on_chord(tree, pair, q, dq, 0); }
};

/// First s <= 1 where `f` is below 0, from samples and bisection; 2 if there is none.
template <class Function>
double first_root(const Function& f) {
  constexpr int samples = 100;
  for (int k = 1; k <= samples; ++k) {
    double high = static_cast<double>(k) / samples, low = high - 1.0 / samples;
    if (f(high) > 0) continue;
    for (int j = 0; j < 50; ++j) {
      const double middle = (low + high) / 2;
      (f(middle) > 0 ? low : high) = middle;
    }
    return high;
  }
  return 2;
}

class PartsOnChords : public ::testing::TestWithParam<Names> {};

TEST_P(PartsOnChords, NoTouchIsMissed) {
  Random random(71);
  int hits = 0;
  for (int k = 0; k < 120; ++k) {
    const int joints = 1 + random.index(6);
    Flight x;
    x.tree = testing_scene::random_tree({.joints = joints, .offset = 0.6}, random);
    const bool plane = GetParam().second == "half_space";
    const int a = random.index(joints), b = plane ? -1 : random.index(joints + 1) - 1;
    x.shapes = {place(testing_scene::part_shape(GetParam().first, random), a, random.pose(0.6)),
                place(testing_scene::part_shape(GetParam().second, random), b == a ? -1 : b,
                      random.pose(0.6))};
    x.q = random.numbers(x.tree.n_v, 1.5);
    x.dq = random.numbers(x.tree.n_v, random.chance(0.2) ? 0.1 : 4);
    if (x.distance(0) <= 0) continue;
    const double root = first_root([&](double s) { return x.distance(s); });
    double first = 2;
    for (const Pair& part : x.parts()) {
      const ChordHit hit = x.hit(part);
      // not converged: clear as far as s, and looked at from there; of edges nearly parallel
      if (hit.outcome != Outcome::clear) first = std::min(first, hit.s);
    }
    EXPECT_LE(first, root + 1e-12) << k;
    hits += root <= 1;
  }
  EXPECT_GT(hits, 8);
}

INSTANTIATE_TEST_SUITE_P(Kinds, PartsOnChords, ::testing::ValuesIn(kinds_with_parts()),
                         [](const ::testing::TestParamInfo<Names>& names) {
                           return names.param.first + "_" + names.param.second;
                         });

Pair part_named(const Flight& x, const std::string& name) {
  for (const Pair& part : x.parts()) {
    if (pair_name(x.shapes, part) == name) return part;
  }
  ADD_FAILURE() << "no part " << name;
  return {};
}

/// A can that turns about a place of its lower rim, down onto `low`. q is its tilt.
Flight tipping(const Shape& low, const Pose& X_WB, const Vec3& pivot, const Vec3& axis) {
  Flight x;
  add_joint(x.tree, -1, {}, {rotation_z_to(axis), pivot}, {0, 1, 0});
  const Cylinder can{0.1, 0.2};
  const Pose X_JW = Pose{rotation_z_to(axis), pivot}.inverse();
  x.shapes = {place(can, 0, X_JW * Pose{Mat3::Identity(), {0, 0, 0.2}}), place(low, -1, X_WB)};
  x.shapes[0].name = "can";
  x.shapes[1].name = "low";
  x.q = VecX::Constant(1, 1e-3);
  x.dq = VecX::Constant(1, -2e-3);
  return x;
}

void expect_found(const Flight& x, const std::string& bears, const std::string& comes) {
  EXPECT_NEAR(x.gap(part_named(x, bears), 0), 0, 1e-15);
  const Pair other = part_named(x, comes);
  EXPECT_GT(x.gap(other, 0), 1e-5);
  const ChordHit hit = x.hit(other);
  EXPECT_EQ(hit.outcome, Outcome::hit);
  EXPECT_NEAR(hit.s, 0.5, 1e-3);  // from where the place itself is looked for
  EXPECT_LT(x.gap(other, 0.5 + 1e-9), 0);
}

// The border is at x = 0.06, so that the rim crosses it at y = +-0.08.
TEST(Tipping, TheOtherPlaceOnABorderIsFound) {
  const Box table{{1, 1, 0.1}};
  const Pose X_WB{Mat3::Identity(), {-0.94, 0, -0.1}};
  const Vec3 out(0.06, 0.08, 0), in(0.06, -0.08, 0);
  expect_found(tipping(table, X_WB, out, -Vec3::UnitX()), "can[out] ~ low[+y+]",
               "can[in] ~ low[+y+]");
  expect_found(tipping(table, X_WB, in, Vec3::UnitX()), "can[in] ~ low[+y+]",
               "can[out] ~ low[+y+]");
}

TEST(Tipping, TheOtherPlaceOnARimIsFound) {
  const Pose X_WB{Mat3::Identity(), {0.12, 0, -0.1}};
  const Vec3 left(0.06, 0.08, 0), right(0.06, -0.08, 0);
  expect_found(tipping(Cylinder{0.1, 0.1}, X_WB, left, -Vec3::UnitX()), "can[left] ~ low[left]",
               "can[right] ~ low[right]");
  expect_found(tipping(Cylinder{0.1, 0.1}, X_WB, right, Vec3::UnitX()), "can[right] ~ low[right]",
               "can[left] ~ low[left]");
}

}  // namespace
}  // namespace saltus
