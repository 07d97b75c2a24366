// The generators of a joint's ancestors, one level a lane.
#pragma once

#include <algorithm>

#include "lagrangian/packed/lane.hpp"

namespace saltus::packed {

inline int deepest_one_tree(const PackedTree& t) {
  int depth = 0;
  for (const PackedGroup& g : t.groups) {
    if (g.width == 1 && g.branched) depth = std::max(depth, g.depth);
  }
  return depth;
}

/// Room for path_to.
template <int C>
Blocks<C> make_path(const PackedTree& t) {
  return Blocks<C>(static_cast<std::size_t>((deepest_one_tree(t) + lanes - 1) / lanes));
}

/// Blocks whose lane `level` holds the ancestor of that level of joint `k` of one tree, `k` itself
/// included. An unbranched tree is its own path. Else the joints are copied as the preorder meets
/// them: call for k = 0, 1, 2, ...
template <int C>
SALTUS_INLINE const Block<C>* path_to(const PackedGroup& g, const Blocks<C>& joints, int k,
                                      Blocks<C>& path) {
  if (!g.branched) return &joints[g.first / lanes];
  const double* from = at(joints, g.slot(k));
  double* to = at(path, g.level[k]);
  for (int c = 0; c < C; ++c) to[c * lanes] = from[c * lanes];
  return path.data();
}

}  // namespace saltus::packed
