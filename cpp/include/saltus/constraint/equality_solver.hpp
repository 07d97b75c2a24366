// What loops make of a linear solve: x = J^-1 b becomes x + Y mu, with rates C^T x = g.
//
// Theory, F6. A (n_v, m) are the directions that loops push in, Y = J^-1 A, C the gradients of the
// rates that they hold, S = C^T Y. At a node J is M and C is A; in an arc A is of its start and C
// of its end. Loops that say the same twice, as a planar one pinned in space does, leave S singular
// and share the load: mu is the shortest there is, of rows scaled to the same S_kk.
//
// A rank that changes along the motion is a bifurcation (a parallelogram that folds flat): between
// redundant, 1e-11, and independent, 1e-8, there is no motion to be told.
#pragma once

#include <Eigen/LU>
#include <Eigen/SVD>

#include "saltus/constraint/equality.hpp"

namespace saltus {

/// See above; `factorize` once C and Y are written, then `meet` or `hold`.
struct SALTUS_EXPORT EqualitySolver {
  /// Of no loops.
  EqualitySolver() = default;
  /// With the model's locks.
  EqualitySolver(int n_v, const EqualityModel& model);

  /// (m) What has been added to J along A A^T, of a row that J may be singular without: it changes
  /// multipliers alone.
  VecX lock;
  Columns C;          ///< (n_v, m) gradients of the rates; written by who uses it
  Columns Y;          ///< (n_v, m) J^-1 A, likewise
  VecX mu;            ///< (m) of the last `meet`
  int weak_row = -1;  ///< of a rank that changes, where factorize failed; else -1

  /// m
  int rows() const { return static_cast<int>(C.cols()); }
  /// Of S. @return false where its rank changes, or it holds no numbers
  bool factorize();
  /// x += Y mu, so that C^T x = g. Writes mu; does not allocate.
  void meet(const VecX& g, VecX& x);
  /// The same with g = 0.
  void hold(VecX& x);

 private:
  bool is_regular() const;
  bool decompose();
  void solve();

  VecX scale_, none_, y_;  ///< (m) 1 / sqrt|S_kk|; zeros; scratch
  MatX S_;                 ///< (m, m) scaled
  Eigen::FullPivLU<MatX> lu_;
  Eigen::JacobiSVD<MatX> svd_;
  Eigen::Index rank_ = 0;
  bool regular_ = false;
};

}  // namespace saltus
