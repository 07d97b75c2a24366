// Which pairs can touch along a chord: sweep and prune over balls swept by the motion.
//
// Every shape is held by a ball about its origin at q; along the chord it stays within a ball
// larger by the most that its origin can move. Pairs whose larger balls are disjoint cannot touch.
// The balls are kept sorted by their lower end along one axis between calls, so that a coherent
// motion costs O(n) (insertion sort). Half-spaces are held against the balls of their partners.
#pragma once

#include <utility>

#include "saltus/collision/contact.hpp"

namespace saltus {

/// Scratch and coherence of the sweep; allocates at construction only, except that `candidates`
/// grows beyond a million pairs. Any state is valid for any configuration: it only saves time.
struct BroadPhase {
  BroadPhase() = default;
  SALTUS_EXPORT BroadPhase(const Tree& tree, const std::vector<PlacedShape>& shapes,
                           const std::vector<Pair>& pairs);

  std::vector<int> candidates;  ///< indices of pairs that can touch, ascending; by find_candidates

  /// A shape that a pair refers to, and the pair.
  struct Partner {
    int shape, pair;
  };
  std::vector<int> first_partner;  ///< (shapes + 1) where the row of a shape starts
  std::vector<Partner> partner;    ///< (pairs) a row for the half-space or smaller index of each
                                   ///< pair, sorted by shape in each row
  std::vector<int> unbounded;      ///< half-spaces that are in a pair

  std::vector<int>
      order;     ///< bounded shapes in pairs, by lower end along `axis`; by find_candidates
  int axis = 0;  ///< of the sweep: the one along which the shapes are spread; likewise
  std::vector<Vec3> center;    ///< (shapes) [m] p_WG; likewise
  std::vector<double> reach;   ///< (shapes) [m] radius of the swept ball; likewise
  std::vector<double> lower;   ///< (shapes) [m] its lower end along `axis`; likewise
  std::vector<double> moved;   ///< (n) [m] the most a joint frame's origin can move; likewise
  std::vector<double> turned;  ///< (n) [rad] the most it can turn; likewise
};

/// Writes bp.candidates: every pair that can come to phi <= margin on the chord from q by dq (n_q).
/// Needs set_configuration at q, and the tree and shapes that `bp` was made for.
SALTUS_EXPORT void find_candidates(const Tree& tree, const std::vector<PlacedShape>& shapes,
                                   const Kinematics& kin, const VecRef& dq, double margin,
                                   BroadPhase& bp);

/// Forgets the coherence. The candidates of balls that touch to the last bit may depend on it.
SALTUS_EXPORT void start_anew(BroadPhase& bp);

}  // namespace saltus
