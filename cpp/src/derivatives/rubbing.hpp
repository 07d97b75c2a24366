// The few pairs whose friction acts in a step, and a number of each.
#pragma once

#include <vector>

#include "saltus/spatial/spatial.hpp"
#include "saltus/variational/tape.hpp"

namespace saltus {

struct Rubbing {
  std::vector<int> pairs;  ///< their numbers, ascending
  VecX value;              ///< (pairs); empty: 0

  /// Of one of them; 0 of any other.
  double of(int pair) const;
  /// To one of them. `value` is not empty.
  void add(int pair, double x);
};

/// The pairs that push with friction in a step, whether they stick or slide.
void list_rubbing(const Tape& tape, std::vector<int>& pairs);

}  // namespace saltus
