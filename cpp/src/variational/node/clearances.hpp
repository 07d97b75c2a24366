// How far pairs are from touching, and how far their shapes have gone since that was measured.
//
// No gap changes by more than its two shapes move, so that most pairs of a scene need not be placed
// at every node: a pair that was clear by more than that is clear. Knows nothing of pairs whose gap
// is no distance at their start (rims that cross).
#pragma once

#include <limits>
#include <vector>

#include "saltus/collision/broad_phase.hpp"
#include "saltus/collision/pair.hpp"

namespace saltus {

class Clearances {
 public:
  explicit Clearances(std::size_t shapes) : way_(shapes, 0) {}

  /// Bodies have been put elsewhere.
  void forget() { ++era_; }

  /// Every shape has gone as far as bp.motion at most.
  void go(const BroadPhase& bp) {
    for (const int i : bp.bounded) way_[i] += bp.motion[i];
  }

  /// [m] What the distance of the pair `key` is at least; minus infinity where nobody knows.
  double least(int key, const Pair& pair) const {
    if (!is_known(key, pair)) return -std::numeric_limits<double>::infinity();
    return known_[key].distance - (way_of(pair) - known_[key].way);
  }
  /// [m] And at most; infinity where nobody knows.
  double most(int key, const Pair& pair) const {
    if (!is_known(key, pair)) return std::numeric_limits<double>::infinity();
    return known_[key].distance + (way_of(pair) - known_[key].way);
  }

  /// Needs fit.
  void note(int key, const Pair& pair, double distance) {
    if (!pair.is_stop()) known_[key] = {era_, distance, way_of(pair)};
  }

  void fit(int keys) {
    if (static_cast<int>(known_.size()) < keys) known_.resize(static_cast<std::size_t>(keys));
  }

 private:
  struct Known {
    int era = -1;
    double distance = 0, way = 0;  ///< [m] way of both shapes when it was measured
  };

  bool is_known(int key, const Pair& pair) const {
    return !pair.is_stop() && key < static_cast<int>(known_.size()) && known_[key].era == era_;
  }
  double way_of(const Pair& pair) const { return way_[pair.a] + way_[pair.b]; }

  int era_ = 0;
  std::vector<double> way_;   ///< (shapes) [m]
  std::vector<Known> known_;  ///< (keys)
};

}  // namespace saltus
