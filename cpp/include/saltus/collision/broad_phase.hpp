// Which pairs can touch along a chord: balls swept by the motion, and a list of near pairs.
//
// Every shape is held by a ball about its origin at q; along the chord it stays within a ball
// larger by the most that its origin can move. Pairs whose larger balls are disjoint cannot touch.
// The pairs whose balls would overlap if they were larger still, by a skin, are gathered by a tree
// of balls, O(n log n), and serve until a ball leaves the one it was gathered with: most calls of a
// coherent motion are O(n). Half-spaces are held against all balls.
#pragma once

#include <utility>

#include "saltus/collision/ball_tree.hpp"
#include "saltus/collision/pair_table.hpp"
#include "saltus/tree/kinematics.hpp"

namespace saltus {

/// Scratch and coherence; allocates at construction only, except that the lists of pairs grow
/// beyond a million. What it holds from earlier calls saves time and changes no candidate.
struct BroadPhase {
  BroadPhase() = default;
  SALTUS_EXPORT BroadPhase(const Tree& tree, const std::vector<PlacedShape>& shapes,
                           const PairTable& pairs);

  std::vector<int> candidates;  ///< numbers of pairs that can touch, ascending; by find_candidates

  std::vector<int> unbounded;  ///< half-spaces that are in a pair
  std::vector<int> bounded;    ///< the other shapes that are in a pair, ascending
  /// What is asked of a shape, packed: shapes themselves are long.
  struct Ball {
    int joint;
    Vec3 p_JG;    ///< [m] its centre
    double size;  ///< [m] radius of the ball that holds the shape
  };
  std::vector<Ball> ball;      ///< (shapes)
  std::vector<Vec3> center;    ///< (shapes) [m] p_WG; by find_candidates
  std::vector<double> reach;   ///< (shapes) [m] radius of the swept ball; likewise
  std::vector<Vec3> normal;    ///< (shapes) outward, of half-spaces; likewise
  std::vector<double> moved;   ///< (n) [m] the most a joint frame's origin can move; likewise
  std::vector<double> turned;  ///< (n) [rad] the most it can turn; likewise
  std::vector<double> motion;  ///< (shapes) [m] the most a point of it can move; likewise

  // What is kept between calls, written where a ball has left the one that it was gathered with.
  std::vector<Vec3> held_center;   ///< (shapes) [m] of the balls with their skins
  std::vector<double> held_reach;  ///< (shapes) [m] likewise
  BallTree tree;
  int calls_left = 0;  ///< gathers until the tree is built anew
  int age = 0;         ///< calls since the last gather
  struct Meeting {
    int i, j;  ///< shapes, i < j
  };
  std::vector<Meeting> met;  ///< whose held balls overlap
  std::vector<int> row;      ///< (shapes + 1) where the later partners of a shape end in `near`
  struct Near {
    int i, j;                  ///< i < j
    PairTable::Range numbers;  ///< of their gaps
  };
  std::vector<Near> near;  ///< those of `met` that are watched, ascending
};

/// Writes bp.candidates: every pair that can come to phi <= margin on the chord from q by dq (n_v).
/// Needs set_configuration at q, and the tree, shapes and pairs that `bp` was made for.
SALTUS_EXPORT void find_candidates(const Tree& tree, const std::vector<PlacedShape>& shapes,
                                   const PairTable& pairs, const Kinematics& kin, const VecRef& dq,
                                   double margin, BroadPhase& bp);

/// Forgets what is kept between calls.
SALTUS_EXPORT void start_anew(BroadPhase& bp);

}  // namespace saltus
