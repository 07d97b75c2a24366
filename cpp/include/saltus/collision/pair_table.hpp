// Which shapes are watched against which, and the number of each pair, without a list of them.
//
// 10 000 balls have 5e7 pairs. They are numbered row by row: the pairs of shape 0 with shapes 1, 2,
// ..., then those of shape 1, and so on, part by part; a number is found by counting. Shapes are of
// a class if they have as many gaps with any other: what is not watched is whole classes of shapes
// (kinds without a gap, groups that exclude each other), shapes of one joint frame, and a list.
#pragma once

#include <utility>
#include <vector>

#include "saltus/collision/parts.hpp"

namespace saltus {

/// What the table is made of.
struct PairRules {
  std::vector<int> group;  ///< (shapes) of each
  std::vector<std::pair<int, int>> excluded_groups;
  std::vector<std::pair<int, int>> excluded;  ///< shapes, in any order, once or more
};

class SALTUS_EXPORT PairTable {
 public:
  PairTable() = default;
  /// @throws ModelError where there are 2^31 pairs or more.
  PairTable(const std::vector<PlacedShape>& shapes, const PairRules& rules);

  int size() const { return row_.empty() ? 0 : static_cast<int>(row_.back()); }
  bool empty() const { return size() == 0; }

  /// Numbers of the gaps between two shapes: first, first + 1, ...
  struct Range {
    int first, count;  ///< count is 0 where they are not watched
  };
  Range range(int a, int b) const;
  int count(int a, int b) const { return range(a, b).count; }

  struct Key {
    int a, b, part;  ///< a < b
  };
  Key key(int pair) const;  ///< needs 0 <= pair < size()

  bool is_used(int shape) const {  ///< in any pair
    return !used_.empty() && used_[shape] != 0;
  }

 private:
  using Count = long long;
  int classes() const { return static_cast<int>(parts_.size()); }
  void classify(const std::vector<PlacedShape>& shapes, const PairRules& rules);
  const int* before(int kind) const { return before_.data() + kind * (class_.size() + 1); }
  /// Gaps of shape i with those between two others (left out), without the list of exclusions.
  Count row_between(int i, int from, int to) const;
  /// Gaps of shape i with those between it and j.
  Count row_before(int i, int j) const;

  /// Shapes of one class on one joint frame, ascending.
  struct Members {
    int kind;
    std::vector<int> shape;
  };
  std::vector<int> class_;               ///< (shapes)
  std::vector<std::vector<int>> parts_;  ///< (classes, classes) gaps of two shapes
  std::vector<int> before_;  ///< (classes, shapes + 1), rows joined: of the class before a shape
  std::vector<int> body_;    ///< (shapes) joint frame, numbered
  std::vector<std::vector<Members>> on_;    ///< (bodies)
  std::vector<std::vector<int>> excluded_;  ///< (shapes) later ones, ascending, watched otherwise
  std::vector<Count> row_;                  ///< (shapes + 1) number of the first pair of a row
  std::vector<char> used_;                  ///< (shapes)
  std::vector<char> plain_;  ///< (shapes) alone on its joint frame and in no list of exclusions
};

}  // namespace saltus
