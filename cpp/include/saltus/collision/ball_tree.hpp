// A binary tree of boxes over balls: which of them overlap, in O(n log n).
//
// Built from the top by halving along the longer side of the centres; refitted as they move, which
// keeps it right whatever they do, and good while they stay near where they were.
#pragma once

#include <algorithm>
#include <vector>

#include "saltus/export.hpp"
#include "saltus/spatial/spatial.hpp"

namespace saltus {

/// Nodes in order of a walk from the root, children after their parents. Allocates in reserve only.
struct BallTree {
  struct Node {
    Vec3 low, high;   ///< [m] holds all balls below; by refit
    int first, last;  ///< they are ball[first] ... ball[last - 1]; by build
    int skip;         ///< the node after all those below this one
  };
  std::vector<Node> node;
  std::vector<int> ball;
};

/// Room for n balls.
SALTUS_EXPORT void reserve(std::size_t n, BallTree& tree);

/// A new tree over the balls listed, by their centres. Centres must be finite.
SALTUS_EXPORT void build(const std::vector<int>& balls, const std::vector<Vec3>& center,
                         BallTree& tree);

/// Boxes for balls that have moved or grown.
SALTUS_EXPORT void refit(const std::vector<Vec3>& center, const std::vector<double>& radius,
                         BallTree& tree);

/// Calls found(i, j) once for each two balls that overlap or touch.
template <class Found>
void for_each_overlap(const std::vector<Vec3>& center, const std::vector<double>& radius,
                      const BallTree& tree, const Found& found) {
  const int nodes = static_cast<int>(tree.node.size());
  for (int k = 0; k < static_cast<int>(tree.ball.size()); ++k) {
    const int i = tree.ball[k];
    const Vec3& c = center[i];
    const double r = radius[i];
    for (int m = 0; m < nodes;) {
      const BallTree::Node& node = tree.node[m];
      // each pair is met from the ball that comes first
      const bool apart = node.last <= k + 1 || (c.array() - r > node.high.array()).any() ||
                         (c.array() + r < node.low.array()).any();
      const bool leaf = node.skip == m + 1;
      for (int b = std::max(node.first, k + 1); leaf && !apart && b < node.last; ++b) {
        const int j = tree.ball[b];
        const double touching = r + radius[j];
        if ((c - center[j]).squaredNorm() <= touching * touching) found(i, j);
      }
      m = apart ? node.skip : m + 1;
    }
  }
}

}  // namespace saltus
