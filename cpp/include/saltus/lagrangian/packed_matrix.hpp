// The Newton matrix of an arc, and the mass matrix, in lanes: factored and solved.
//
//   J(tau) = L_vv + tau/2 (L_vq - L_vq^T) - tau^2/4 L_qq,   J(0) = M          (theory, section 3)
//   J_ij = t_i.w_j     J_ji = s_i.u_j                                            for i at or above
//   j
//
//   s = [S + tau/2 W; S_w]   w = [U + tau/2 F; G]     t = [S - tau/2 W; -tau^2/4 S_w]
//   u = [U - tau/2 F; -tau^2/4 G]                      (S_w: the angular rows of S)
//
// lu      eliminates from the leaves to the root. A joint's equation knows its ancestors only, and
//         eliminating it touches rows of ancestors only: no fill, O(sum of depth^2).
// sweep   carries one 9x9 matrix P up a branch, as the articulated-body recursion does, O(n):
//
//   leaf to root:  D = t.(P s + w),  row = t^T P + u^T,  e = r - t.c
//                  P_parent += P - (P s + w) row / D,    c_parent += c + (P s + w) e / D
//   root to leaf:  x = (e - row.a_parent) / D,           a = a_parent + s x
//
// A ball's rows are multiplied by K = J(tau w) (rotation.hpp), and so are the right-hand sides that
// solve takes: callers give momenta. Its generators are turned, and all nine of its entries are
// J_ij = t_i.w_j + Delta_ij, so that the sweep takes the three joints at once (theory, O2).
//
// What one coordinate feels of itself alone, armature and the slopes of springs, damping and
// servos, is on the diagonal, a + tau^2/4 (k - Q_q) - tau/2 Q_v, and adds to its pivot; of a ball
// -tau/2 C Q_v to Delta (theory, F1).
//
// Mimic joints tie distant branches together; there the dense matrix C^T J C is factored, and so is
// J where PackedTree::dense_arcs says so.
#pragma once

#include <Eigen/LU>

#include "saltus/lagrangian/packed_rows.hpp"

namespace saltus {

struct PackedMatrix {
  PackedMatrix() = default;
  SALTUS_EXPORT PackedMatrix(const Tree& tree, const PackedTree& packed);

  bool symmetric = false;  ///< tau = 0: `upper` is not used
  Blocks<18> s_t;          ///< generators of J by its ancestors
  Blocks<18> u_w;          ///< and by its descendants
  /// 1 / pivot; a slot whose pivot failed holds what is not finite. Of balls in the sweep only
  /// where tau = 0.
  Blocks<1> inverse;
  /// K, C = J(tau w / 2) and Delta by columns, in the slot of a ball's third joint; empty without
  /// balls. Not written where tau = 0.
  Blocks<27> ball;
  Blocks<8> ball_k;  ///< scratch: coefficients of K and C
  /// What a coordinate adds to its own pivot; empty where none does. Of balls it is in Delta.
  Blocks<1> added;
  VecX lock;  ///< (n_v) what the caller has added to the diagonal; empty: nothing. Not of balls

  // lu
  PackedRows lower, upper;  ///< row j: J_ji and J_ij, eliminated
  Blocks<18> path;          ///< scratch

  // sweep: nine numbers a slot, padded to twelve
  struct alignas(32) Nine {
    double x[12] = {};
  };
  struct Carried {
    Nine P[9], PT[9];  ///< rows of P and of its transpose
  };
  std::vector<Nine> s, t, gain, row, c, a;
  std::vector<Carried> branch;  ///< sums at joints with several children
  std::vector<int> branch_of;   ///< (slots) index in `branch`, or -1
  Blocks<9> pivot;              ///< inverse of a ball's 3x3 pivot, as `ball`

  // mimic joints, dense arcs
  bool is_dense = false;
  MatX dense;                    ///< (n_v, n_v)
  Eigen::PartialPivLU<MatX> lu;  ///< of dense
  VecX solution;                 ///< (n_v) scratch of solve

  // forces on several coordinates, J += G H^T, G = C g, H = -tau/2 (Q_v + tau/2 C^T Q_q), by
  // J^-1 - J^-1 G (1 + H^T J^-1 G)^-1 H^T J^-1; C at balls, else 1 (theory, F1 and O2)
  bool is_coupled = false;
  MatX G, H, JG;                       ///< (n_v, r), and J^-1 G
  VecX column;                         ///< (n_v) scratch
  VecX Hx, Hy;                         ///< (r)
  MatX inner;                          ///< (r, r)
  Eigen::PartialPivLU<MatX> inner_lu;  ///< of 1 + H^T J^-1 G

  Blocks<1> x;  ///< scratch of solve, by slot
};

/// Factors of J(tau); needs second_pass and, for balls, arc_pass at tau; or mass_pass for tau = 0.
/// @return false where a pivot vanishes or is not a number: J is singular there.
SALTUS_EXPORT bool factorize(const Tree& tree, const PackedTree& packed, const Packed& w,
                             double tau, PackedMatrix& J);

/// x <- J^-1 x on one tree, x by position in the tree; trees do not know of each other. Not with
/// mimic joints.
SALTUS_EXPORT void solve_tree(const PackedTree& packed, int tree, PackedMatrix& J, double* x);

/// x <- J^-1 x, x (n_v): what a change of the momenta at an arc's start does to its velocity.
SALTUS_EXPORT void solve(const Tree& tree, const PackedTree& packed, PackedMatrix& J, VecX& x);

/// x <- (K^-1 J)^-1 x: the same of an x that has been multiplied by K already.
SALTUS_EXPORT void solve_scaled(const Tree& tree, const PackedTree& packed, PackedMatrix& J,
                                VecX& x);

/// x <- (K^-1 J)^-T x: the transpose of solve_scaled, from the same factors. pull_back_end makes of
/// it that of solve.
SALTUS_EXPORT void solve_transposed(const Tree& tree, const PackedTree& packed, PackedMatrix& J,
                                    VecX& x);

/// x <- K^T x: from a derivative by the end of an arc to that by its velocity, over tau. Needs
/// factorize.
SALTUS_EXPORT void pull_back_end(const PackedTree& packed, const PackedMatrix& J, VecX& x);
/// The same on one tree, x by position in the tree.
SALTUS_EXPORT void pull_back_end_tree(const PackedTree& packed, int tree, const PackedMatrix& J,
                                      double* x);
/// x <- C^T x: likewise from one by its middle, over tau / 2.
SALTUS_EXPORT void pull_back_middle(const PackedTree& packed, const PackedMatrix& J, VecX& x);

/// rate <- -K dp_start/dtau of an arc (theory, section 3 and O2), what solve_scaled takes to
/// dv/dtau. Needs factorize; `products` are scratch, x too.
SALTUS_EXPORT void set_momentum_rate(const Tree& tree, const PackedTree& packed, const Packed& w,
                                     double tau, PackedProducts& products, VecX& x, VecX& rate);

}  // namespace saltus
