// Trees that fill the lanes in every way there is, with the plain quantities beside the packed
// ones.
#pragma once

#include "lagrangian/evaluate.hpp"
#include "saltus/lagrangian/packed_matrix.hpp"

namespace saltus::test {

/// `t` several times over, each copy with masses and a place of its own: equal trees share lanes.
inline RandomTree copies_of(const RandomTree& t, int copies, Random& random) {
  RandomTree out;
  out.mass.gravity = t.mass.gravity;
  for (int k = 0; k < copies; ++k) {
    const int first = out.tree.joints();
    for (int i = 0; i < t.tree.joints(); ++i) {
      const int parent = t.tree.parent[i] < 0 ? -1 : first + t.tree.parent[i];
      const Drive drive{first + i, 1, 0};
      add_joint(out.tree, parent, t.tree.joint[i], random.pose(0.5), drive);
      out.mass.body.push_back(random.body());
    }
  }
  out.q = random.vector(out.tree.n_v, 1.5);
  out.v = random.vector(out.tree.n_v, 2);
  return out;
}

/// One tree; branching ones; several on the world; with mimic joints; equal ones, also of more than
/// eight; a chain that needs more than a block and one that is deep.
inline RandomTree packed_tree(int k) {
  Random random(static_cast<std::uint64_t>(500 + k));
  const int joints = 1 + k % 13;
  switch (k % 6) {
    case 0:
      return random_tree(random, {.joints = joints, .branch = 0});
    case 1:
      return random_tree(random, {.joints = 2 * joints, .branch = 0.4});
    case 2:
      return random_tree(random, {.joints = joints, .branch = 0.2, .new_tree = 0.3});
    case 3:
      return random_tree(random, {.joints = joints + 1, .branch = 0.2, .mimic = 0.4});
    case 4:
      return copies_of(random_tree(random, {.joints = 1 + k % 5, .branch = 0.4}), 2 + k % 11,
                       random);
    default:
      return random_tree(random, {.joints = 20 + k % 20, .branch = k % 4 ? 0.05 : 0.0});
  }
}

/// Both evaluations of one tree at its state.
struct PackedEvaluation {
  explicit PackedEvaluation(const RandomTree& tree, TreeSolver solver = TreeSolver::automatic)
      : t(tree), packed(pack(t.tree, t.mass, solver)), w(packed), plain(evaluate(t)) {
    set_coordinates(t.tree, packed, t.q, w);
    set_rates(t.tree, packed, t.v, w);
    place(packed, w);
    move(packed, w);
    first_pass(packed, w);
    second_pass(packed, w);
  }

  /// Numbers c ... c + N - 1 of joint i.
  template <int N, int C>
  Eigen::Matrix<double, N, 1> of(const Blocks<C>& blocks, int i, int c = 0) const {
    Eigen::Matrix<double, N, 1> out;
    for (int k = 0; k < N; ++k) out[k] = at(blocks, packed.slot[i])[(c + k) * lanes];
    return out;
  }

  RandomTree t;
  PackedTree packed;
  Packed w;
  Evaluation plain;
};

}  // namespace saltus::test
