// A binary tree of boxes over balls: which of them overlap, in O(n log n).
//
// Built from the top by halving along the longer side of the centres; refitted as they move, which
// keeps it right whatever they do, and good while they stay near where they were. Both sides of a
// node are held against each other as trees, so that far parts are told apart near the root.
#pragma once

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
  struct Ball {
    Vec3 center;    ///< [m] by refit
    double radius;  ///< [m] likewise
    int index;      ///< by build
  };
  std::vector<Node> node;
  std::vector<Ball> ball;  ///< those of a node side by side in memory

  bool is_leaf(int m) const { return node[m].skip == m + 1; }
};

/// Room for n balls.
SALTUS_EXPORT void reserve(std::size_t n, BallTree& tree);

/// A new tree over the balls listed, by their centres. Centres must be finite.
SALTUS_EXPORT void build(const std::vector<int>& balls, const std::vector<Vec3>& center,
                         BallTree& tree);

/// Boxes for balls that have moved or grown.
SALTUS_EXPORT void refit(const std::vector<Vec3>& center, const std::vector<double>& radius,
                         BallTree& tree);

namespace ball_tree {

inline bool meet(const BallTree::Ball& x, const BallTree::Ball& y) {
  const double touching = x.radius + y.radius;
  return (x.center - y.center).squaredNorm() <= touching * touching;
}

inline bool meet(const BallTree::Node& x, const BallTree::Node& y) {
  return (x.low.array() <= y.high.array()).all() && (y.low.array() <= x.high.array()).all();
}

/// Balls below one node against those below another.
template <class Found>
void hold_against(const BallTree& tree, int m, int k, const Found& found) {
  const BallTree::Node &x = tree.node[m], &y = tree.node[k];
  if (!meet(x, y)) return;
  if (tree.is_leaf(m) && tree.is_leaf(k)) {
    for (int i = x.first; i < x.last; ++i) {
      for (int j = y.first; j < y.last; ++j) {
        if (meet(tree.ball[i], tree.ball[j])) found(tree.ball[i].index, tree.ball[j].index);
      }
    }
    return;
  }
  const bool split_x =
      !tree.is_leaf(m) && (tree.is_leaf(k) || x.last - x.first >= y.last - y.first);
  const int split = split_x ? m : k, other = split_x ? k : m;
  hold_against(tree, split + 1, other, found);
  hold_against(tree, tree.node[split + 1].skip, other, found);
}

/// Balls below a node among each other; as deep as the tree, log2 of the balls.
template <class Found>
void hold_together(const BallTree& tree, int m, const Found& found) {
  const BallTree::Node& x = tree.node[m];
  if (!tree.is_leaf(m)) {
    const int left = m + 1, right = tree.node[left].skip;
    hold_together(tree, left, found);
    hold_together(tree, right, found);
    hold_against(tree, left, right, found);
    return;
  }
  for (int i = x.first; i < x.last; ++i) {
    for (int j = i + 1; j < x.last; ++j) {
      if (meet(tree.ball[i], tree.ball[j])) found(tree.ball[i].index, tree.ball[j].index);
    }
  }
}

}  // namespace ball_tree

/// Calls found(i, j) once for each two balls that overlap or touch.
template <class Found>
void for_each_overlap(const BallTree& tree, const Found& found) {
  if (!tree.node.empty()) ball_tree::hold_together(tree, 0, found);
}

}  // namespace saltus
