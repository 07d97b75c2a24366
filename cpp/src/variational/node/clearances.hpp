// How far pairs are from touching, and how far their shapes have gone since that was measured.
//
// No gap changes by more than its two shapes move, so that most pairs of a scene need not be placed
// at every node: a pair that was clear by more than that is clear. Knows nothing of pairs whose gap
// is no distance at their start (rims that cross).
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "saltus/collision/pair.hpp"

namespace saltus {

class Clearances {
 public:
  /// Of the pool's pairs by slot, or of their solids by number.
  enum Of { pairs, solids };

  explicit Clearances(std::size_t shapes) : way_(shapes, 0) {}

  /// Room for so many of each.
  void fit(int of_pairs, int of_solids) {
    grow(of_pairs, known_[pairs]);
    grow(of_solids, known_[solids]);
  }

  /// Bodies have been put elsewhere.
  void forget() { ++era_; }

  /// Every shape has gone so far [m] at most.
  void go(const std::vector<double>& motion) {
    for (std::size_t i = 0; i < way_.size(); ++i) way_[i] += motion[i];
  }

  /// [m] What the distance of the pair is at least; minus infinity where nobody knows.
  double least(Of of, int key, const Pair& pair) const {
    if (!is_known(of, key, pair)) return -std::numeric_limits<double>::infinity();
    return known_[of][key].distance - way_since(known_[of][key], pair);
  }
  /// [m] And at most; infinity where nobody knows.
  double most(Of of, int key, const Pair& pair) const {
    if (!is_known(of, key, pair)) return std::numeric_limits<double>::infinity();
    return known_[of][key].distance + way_since(known_[of][key], pair);
  }

  /// Needs fit.
  void note(Of of, int key, const Pair& pair, double distance) {
    if (!pair.is_stop()) known_[of][key] = {era_, distance, way_of(pair)};
  }

 private:
  struct Known {
    int era = -1;
    double distance = 0, way = 0;  ///< [m] way of both shapes when it was measured
  };

  static void grow(int keys, std::vector<Known>& known) {
    if (static_cast<int>(known.size()) < keys) known.resize(static_cast<std::size_t>(keys));
  }
  bool is_known(Of of, int key, const Pair& pair) const {
    return !pair.is_stop() && key < static_cast<int>(known_[of].size()) &&
           known_[of][key].era == era_;
  }
  double way_of(const Pair& pair) const { return way_[pair.a] + way_[pair.b]; }
  /// No number where a shape has gone without bound, which is neither near nor clear.
  double way_since(const Known& known, const Pair& pair) const { return way_of(pair) - known.way; }

  int era_ = 0;
  std::vector<double> way_;                  ///< (shapes) [m]
  std::array<std::vector<Known>, 2> known_;  ///< (Of) (keys)
};

}  // namespace saltus
