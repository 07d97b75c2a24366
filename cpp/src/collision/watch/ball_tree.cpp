#include "saltus/collision/ball_tree.hpp"

#include <algorithm>

namespace saltus {
namespace {

constexpr int most_in_leaf = 4;

void split(const std::vector<Vec3>& center, int first, int last, BallTree& tree) {
  const std::size_t self = tree.node.size();
  tree.node.push_back({Vec3::Zero(), Vec3::Zero(), first, last, 0});
  if (last - first > most_in_leaf) {
    Vec3 low = center[tree.ball[first].index], high = low;
    for (int k = first; k < last; ++k) {
      low = low.cwiseMin(center[tree.ball[k].index]);
      high = high.cwiseMax(center[tree.ball[k].index]);
    }
    int axis = 0;
    (high - low).maxCoeff(&axis);
    const int middle = first + (last - first) / 2;
    const auto ball = tree.ball.begin();
    std::nth_element(ball + first, ball + middle, ball + last,
                     [&](const BallTree::Ball& x, const BallTree::Ball& y) {
                       return center[x.index][axis] < center[y.index][axis];
                     });
    split(center, first, middle, tree);  // as deep as log2 n: halves
    split(center, middle, last, tree);
  }
  tree.node[self].skip = static_cast<int>(tree.node.size());
}

}  // namespace

void reserve(std::size_t n, BallTree& tree) {
  tree.node.reserve(2 * n + 1);
  tree.ball.reserve(n);
}

void build(const std::vector<int>& balls, const std::vector<Vec3>& center, BallTree& tree) {
  tree.ball.clear();
  for (const int i : balls) tree.ball.push_back({Vec3::Zero(), 0, i});
  tree.node.clear();
  if (!balls.empty()) split(center, 0, static_cast<int>(balls.size()), tree);
}

void refit(const std::vector<Vec3>& center, const std::vector<double>& radius, BallTree& tree) {
  for (BallTree::Ball& ball : tree.ball) {
    ball.center = center[ball.index];
    ball.radius = radius[ball.index];
  }
  for (int m = static_cast<int>(tree.node.size()) - 1; m >= 0; --m) {
    BallTree::Node& node = tree.node[m];
    if (!tree.is_leaf(m)) {
      const BallTree::Node &left = tree.node[m + 1], &right = tree.node[left.skip];
      node.low = left.low.cwiseMin(right.low);
      node.high = left.high.cwiseMax(right.high);
      continue;
    }
    const BallTree::Ball& first = tree.ball[node.first];
    node.low = first.center.array() - first.radius;
    node.high = first.center.array() + first.radius;
    for (int k = node.first + 1; k < node.last; ++k) {
      const BallTree::Ball& ball = tree.ball[k];
      node.low = node.low.cwiseMin((ball.center.array() - ball.radius).matrix());
      node.high = node.high.cwiseMax((ball.center.array() + ball.radius).matrix());
    }
  }
}

}  // namespace saltus
