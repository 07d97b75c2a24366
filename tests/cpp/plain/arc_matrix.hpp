// The Newton matrix of an arc, and the mass matrix, factored and solved in O(n).
//
//   J(tau) = L_vv + tau/2 (L_vq - L_vq^T) - tau^2/4 L_qq,   J(0) = M          (theory, section 3)
//
// On the tree J has a generator of rank 9, so J x = r is a sweep like the articulated-body
// recursion with one 9x9 matrix a joint:
//
//   s = [S + tau/2 W; S_w]   w = [U + tau/2 F; G]     t = [S - tau/2 W; -tau^2/4 S_w]
//   u = [U - tau/2 F; -tau^2/4 G]                      (S_w: the angular rows of S)
//   leaf to root:  D = t.(P s + w),  row = t^T P + u^T,  e = r - t.c
//                  P_parent += P - (P s + w) row / D,    c_parent += c + (P s + w) e / D
//   root to leaf:  x = (e - row.a_parent) / D,           a = a_parent + s x
//
// Mimic joints tie distant branches together; there the dense matrix C^T J C is factored instead.
#pragma once

#include <Eigen/LU>
#include <vector>

#include "plain/composite.hpp"

namespace saltus::plain {

using Vec9 = Eigen::Matrix<double, 9, 1>;
using Mat9 = Eigen::Matrix<double, 9, 9>;

/// Factors of J(tau); everything is written by factorize except the scratch c, a, e of solve.
struct ArcMatrix {
  struct Row {
    Vec9 s, t, gain, row;  ///< gain = P s + w
    double inverse_D;
    bool loaded;  ///< P is not zero: some joint hangs on this one
  };
  std::vector<Row> joint;        ///< (n)
  std::vector<Mat9> P;           ///< (n) scratch of factorize
  std::vector<Vec9> c, a;        ///< (n) scratch of solve
  VecX e;                        ///< (n) scratch of solve
  MatX dense;                    ///< (n_q, n_q) with mimic joints only
  Eigen::PartialPivLU<MatX> lu;  ///< of dense

  ArcMatrix() = default;
  explicit ArcMatrix(const Tree& tree);
};

/// Needs second_pass at the (q, v) in question.
/// @return false where a pivot vanishes or is not a number: J is singular there. The joint is the
/// last whose inverse_D is not a finite number; those before it are not eliminated.
bool factorize(const Tree& tree, const Kinematics& kin, const Composite& comp, double tau,
               ArcMatrix& J);

/// x <- J^-1 x, x (n_q).
void solve(const Tree& tree, ArcMatrix& J, Eigen::Ref<VecX> x);

/// Adds C^T J(tau) C to `out` (n_q, n_q): the dense twin of factorize, for people and for tests.
void add_dense(const Tree& tree, const Kinematics& kin, const Composite& comp, double tau,
               MatX& out);

}  // namespace saltus::plain
