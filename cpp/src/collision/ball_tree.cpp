#include "saltus/collision/ball_tree.hpp"

#include <algorithm>

namespace saltus {
namespace {

constexpr int most_in_leaf = 4;

void split(const std::vector<Vec3>& center, int first, int last, BallTree& tree) {
  const std::size_t self = tree.node.size();
  tree.node.push_back({Vec3::Zero(), Vec3::Zero(), first, last, 0});
  if (last - first > most_in_leaf) {
    Vec3 low = center[tree.ball[first]], high = low;
    for (int k = first; k < last; ++k) {
      low = low.cwiseMin(center[tree.ball[k]]);
      high = high.cwiseMax(center[tree.ball[k]]);
    }
    int axis = 0;
    (high - low).maxCoeff(&axis);
    const int middle = first + (last - first) / 2;
    const auto ball = tree.ball.begin();
    std::nth_element(ball + first, ball + middle, ball + last,
                     [&](int i, int j) { return center[i][axis] < center[j][axis]; });
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
  tree.ball = balls;
  tree.node.clear();
  if (!balls.empty()) split(center, 0, static_cast<int>(balls.size()), tree);
}

void refit(const std::vector<Vec3>& center, const std::vector<double>& radius, BallTree& tree) {
  for (int m = static_cast<int>(tree.node.size()) - 1; m >= 0; --m) {
    BallTree::Node& node = tree.node[m];
    const bool leaf = node.skip == m + 1;
    if (!leaf) {
      const BallTree::Node &left = tree.node[m + 1], &right = tree.node[left.skip];
      node.low = left.low.cwiseMin(right.low);
      node.high = left.high.cwiseMax(right.high);
      continue;
    }
    const int first = tree.ball[node.first];
    node.low = center[first].array() - radius[first];
    node.high = center[first].array() + radius[first];
    for (int k = node.first + 1; k < node.last; ++k) {
      const int i = tree.ball[k];
      node.low = node.low.cwiseMin((center[i].array() - radius[i]).matrix());
      node.high = node.high.cwiseMax((center[i].array() + radius[i]).matrix());
    }
  }
}

}  // namespace saltus
