// The tree and its bodies, packed for the kernels: numbers of eight joints side by side.
//
// A slot holds one joint. Slot k is lane k % 8 of block k / 8, and a block keeps each of its
// numbers for all eight lanes next to each other, so that one instruction works on a block. Two
// kinds of groups fill the lanes:
//
//   one tree     its joints in preorder, one a lane: what is done joint by joint runs in lanes, and
//                recursions along the tree go lane by lane
//   equal trees  (a cradle's pendulums, bodies that fly alone) the same joint of each tree side by
//                side: recursions too run in lanes
//
// Lanes that are left over hold joints without mass, whose numbers nobody reads.
#pragma once

#include <memory>
#include <vector>

#include "saltus/lagrangian/mass_model.hpp"
#include "saltus/tree/coordinates.hpp"
#include "saltus/tree/kinematics.hpp"

namespace saltus {

inline constexpr int lanes = 8;

/// C numbers a joint, for eight joints.
template <int C>
struct alignas(64) Block {
  double x[C][lanes] = {};
};

template <int C>
using Blocks = std::vector<Block<C>>;

/// The first number of a slot; its others follow at strides of `lanes`.
template <int C>
inline double* at(Blocks<C>& blocks, int slot) {
  const unsigned k = static_cast<unsigned>(slot);  // whose division is a shift
  return &blocks[k / lanes].x[0][k % lanes];
}
template <int C>
inline const double* at(const Blocks<C>& blocks, int slot) {
  const unsigned k = static_cast<unsigned>(slot);
  return &blocks[k / lanes].x[0][k % lanes];
}

/// How J x = r is solved on a tree.
enum class TreeSolver {
  automatic,  ///< lu for shallow trees, sweep for deep ones
  lu,         ///< elimination from the leaves without fill: O(sum of depth^2)
  sweep,      ///< articulated-body-like recursion: O(n)
};

/// One tree (width 1), or equal ones (width a multiple of 8). Joint `position` of tree `lane` is in
/// slot first + position * width + lane.
struct PackedGroup {
  int first = 0;      ///< a multiple of 8
  int positions = 0;  ///< joints a tree
  int width = 1;
  int trees = 1;                    ///< lanes that hold one
  bool branched = false;            ///< else the parent of a position is the one before
  bool sweep = false;               ///< else lu
  int depth = 0;                    ///< joints on the longest path from the root
  std::vector<int> parent;          ///< (positions) -1 for the root
  std::vector<int> level;           ///< (positions) ancestors of each
  std::vector<long> row;            ///< (positions) block where its row begins, see PackedRows
  std::vector<int> reference_path;  ///< positions from the joint at the reference point to the root
  std::vector<int> balls;           ///< positions of the first joints of balls; the others follow
  /// (positions) nothing turns above the joint, so that PackedTree::X has its placement in the
  /// world's axes: that of the root, of all joints of a body that flies.
  std::vector<char> placed;

  int slot(int position) const { return first + position * width; }
};

/// Where a tree is.
struct PackedPlace {
  int group, lane;
};

/// A ball, its joints in three slots.
struct PackedBall {
  int slot[3];
  int velocity, coordinate;  ///< as in Ball
};

struct PackedPotentials;  ///< potentials.hpp with the paths of their points: packed/potentials.hpp

struct PackedTree {
  std::vector<PackedGroup> groups;
  std::vector<PackedPlace> trees;
  std::vector<int> tree;              ///< (n) index in `trees` of each joint
  std::vector<int> slot;              ///< (n) of each joint
  std::vector<int> joint;             ///< (slots) in each slot, -1 where there is none
  int slots = 0;                      ///< a multiple of 8
  long row_blocks = 0;                ///< of all rows
  long lu_row_blocks = 0;             ///< of those of groups that lu solves; they come first
  bool one_to_one = true;             ///< as in Tree
  std::vector<PackedBall> balls;      ///< as in Tree
  std::vector<int> slot_of_velocity;  ///< (n_v) of the joint that v moves one to one
  /// Where q has the displacement of a joint; not with mimic joints.
  struct Displacement {
    int slot, coordinate;
  };
  std::vector<Displacement> displacements;  ///< of all joints that are of no ball

  Blocks<12> X;      ///< placement: R by columns, p; R from the world's axes where it is `placed`
  Blocks<2> kind;    ///< what a unit of displacement turns and slides: 1, 0 | 0, 1 | 1, pitch
  Blocks<10> body;   ///< mass, c_J, I_J: xx xy xz yy yz zz
  Blocks<1> weight;  ///< [kg] mass of the subtree
  /// armature, stiffness, rest (mass_model.hpp), in the slots that `slot_of_velocity` names; empty
  /// where no coordinate has any.
  Blocks<3> own;
  Vec3 gravity = Vec3::Zero();
  /// Shared by copies, which do not change it; null where there are none.
  std::shared_ptr<const PackedPotentials> potentials;
  int columns = 0;  ///< that they add to Packed::coupled
  /// J(tau) is factored as a dense matrix: forces that join several coordinates are many.
  bool dense_arcs = false;
};

/// Sorts the joints into slots. Equal trees share lanes where `solver` is not sweep.
SALTUS_EXPORT PackedTree pack(const Tree& tree, const MassModel& mass,
                              TreeSolver solver = TreeSolver::automatic);

}  // namespace saltus
