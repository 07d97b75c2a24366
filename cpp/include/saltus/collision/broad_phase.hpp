// Which pairs can touch along a chord: sweep and prune over balls swept by the motion.
//
// Every shape is held by a ball about its origin at q; along the chord it stays within a ball
// larger by the most that its origin can move. Pairs whose larger balls are disjoint cannot touch.
// The balls are kept sorted by their lower end along one axis between calls, so that a coherent
// motion in a row costs O(n) (insertion sort); where too many overlap along any one axis, a tree of
// balls takes over, O(n log n). Half-spaces are held against all balls.
#pragma once

#include <utility>

#include "saltus/collision/ball_tree.hpp"
#include "saltus/collision/pair_table.hpp"

namespace saltus {

/// Scratch and coherence of the sweep; allocates at construction only, except that `candidates`
/// grows beyond a million pairs. Any state is valid for any configuration: it only saves time.
struct BroadPhase {
  BroadPhase() = default;
  SALTUS_EXPORT BroadPhase(const Tree& tree, const std::vector<PlacedShape>& shapes,
                           const PairTable& pairs);

  std::vector<int> candidates;  ///< numbers of pairs that can touch, ascending; by find_candidates

  std::vector<int> unbounded;  ///< half-spaces that are in a pair
  std::vector<int> bounded;    ///< the other shapes that are in a pair, ascending
  std::vector<int> order;      ///< the bounded ones by lower end along `axis`; by find_candidates
  int axis = 0;  ///< of the sweep: the one along which the shapes are spread; likewise
  int rest = 0;  ///< calls left in which the tree is used without a sweep; likewise
  BallTree tree;
  /// What is asked of a shape, packed: shapes themselves are long.
  struct Ball {
    int joint;
    Vec3 p_JG;    ///< [m] its centre
    double size;  ///< [m] radius of the ball that holds the shape
  };
  std::vector<Ball> ball;      ///< (shapes)
  std::vector<Vec3> center;    ///< (shapes) [m] p_WG; by find_candidates
  std::vector<double> reach;   ///< (shapes) [m] radius of the swept ball; likewise
  std::vector<double> lower;   ///< (shapes) [m] its lower end along `axis`; likewise
  std::vector<double> moved;   ///< (n) [m] the most a joint frame's origin can move; likewise
  std::vector<double> turned;  ///< (n) [rad] the most it can turn; likewise
};

/// Writes bp.candidates: every pair that can come to phi <= margin on the chord from q by dq (n_q).
/// Needs set_configuration at q, and the tree, shapes and pairs that `bp` was made for.
SALTUS_EXPORT void find_candidates(const Tree& tree, const std::vector<PlacedShape>& shapes,
                                   const PairTable& pairs, const Kinematics& kin, const VecRef& dq,
                                   double margin, BroadPhase& bp);

/// Forgets the coherence. The candidates of balls that touch to the last bit may depend on it.
SALTUS_EXPORT void start_anew(BroadPhase& bp);

}  // namespace saltus
