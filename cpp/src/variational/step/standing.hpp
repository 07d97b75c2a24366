// Standing: what stands still, step after step.
//
// A tree that contacts hold at rest moves by the rounding of its impulses. Where steps in a row
// have moved it by no more than that, and to and fro, it stands still: its momentum is 0 and its
// coordinates stay. What creeps, rolls or begins to fall goes on in one direction, however slowly,
// and so does not stand. A step that moves it by more than rounding ends that.
//
// A step that has changed nothing at all is the next one, too, if what drives the model is the same
// and does not depend on time.
#pragma once

#include <vector>

#include "saltus/variational/stepper.hpp"
#include "variational/arc/finish.hpp"

namespace saltus {

/// Written by this file.
struct Standing {
  explicit Standing(const Scene& scene);

  std::vector<int> steps;    ///< (lists of TreeCoordinates) in a row that moved it by rounding
  std::vector<char> stands;  ///< (lists)
  bool is_timeless = false;  ///< nothing in the model depends on time, or may
  bool steps_on = false;     ///< nothing has changed in the last step

  // scratch
  std::vector<std::vector<int>> places;  ///< (lists) coordinates in q
  std::vector<char> is_length;           ///< (n_v) a velocity in m/s
  std::vector<double> rounding;          ///< (lists) [m] of contacts that hold it; 0: none does
  /// Of values since the watch began.
  struct Path {
    VecX first, last, length;  ///< the sum of all |changes|
  };
  Path q, v;  ///< (n_q), (n_v) at the ends of steps
};

/// Nothing is known to stand.
void forget(Standing& standing);

/// After a step from `start` to the node, the last arc of which ended with this half kick. Writes
/// q, p and v of what stands.
void stand_still(const Scene& scene, const State& start, const HalfKick& kick, Node& node,
                 Standing& standing);

}  // namespace saltus
