// The two passes in one call, for tests.
#pragma once

#include "kit/random_trees.hpp"
#include "plain/composite.hpp"

namespace saltus::test {

using plain::Composite;

struct Evaluation {
  Kinematics kin;
  Composite comp;
};

inline Evaluation evaluate(const RandomTree& t) {
  Evaluation at{Kinematics(t.tree), Composite(t.tree)};
  set_configuration(t.tree, t.q, at.kin);
  set_velocity(t.tree, t.v, at.kin);
  first_pass(t.tree, t.mass, at.kin, at.comp);
  second_pass(t.tree, t.mass, at.kin, at.comp);
  return at;
}

/// Trees of up to ten joints of all kinds; branching, several on the world, with mimic joints.
inline RandomTree varied_tree(int k) {
  Random random(static_cast<std::uint64_t>(1000 + k));
  return random_tree(random, {.joints = 1 + k % 10,
                              .branch = 0.1 * (k % 7),
                              .new_tree = k % 3 == 0 ? 0.2 : 0,
                              .mimic = k % 4 == 1 ? 0.3 : 0});
}

}  // namespace saltus::test
