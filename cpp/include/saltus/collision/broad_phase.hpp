// Which pairs can touch along a chord: sweep and prune over balls swept by the motion.
//
// Every shape is held by a ball about its origin at q; along the chord it stays within a ball
// larger by m = sum |dq_k| R_k over the joints above it. Pairs whose larger balls are disjoint
// cannot touch. The balls are kept sorted by their lower end along x between calls, so that a
// coherent motion costs O(n) (insertion sort), and shapes without bounds are met by all.
#pragma once

#include "saltus/collision/contact.hpp"

namespace saltus {

/// Scratch and coherence of the sweep; allocates at construction only.
struct BroadPhase {
  BroadPhase() = default;
  BroadPhase(const std::vector<PlacedShape>& shapes, const std::vector<Pair>& pairs);

  std::vector<int> candidates;  ///< indices of pairs that can touch, ascending; by find_candidates

  std::vector<int> order;             ///< bounded shapes by lower end along x
  std::vector<int> unbounded;         ///< shapes met by all
  std::vector<Vec3> center;           ///< (shapes) [m]
  std::vector<double> reach;          ///< (shapes) [m] radius of the swept ball
  std::vector<int> pair_of_first;     ///< CSR: row of shape i starts here
  std::vector<std::pair<int, int>> partner;  ///< (other shape, pair index), sorted in each row
};

/// Writes bp.candidates: every pair that can come to phi <= margin on the chord from q by dq.
SALTUS_EXPORT void find_candidates(const Tree& tree, const std::vector<PlacedShape>& shapes,
                                   const std::vector<Pair>& pairs, const Kinematics& kin,
                                   const VecRef& q, const VecRef& dq, double margin,
                                   BroadPhase& bp);

}  // namespace saltus
