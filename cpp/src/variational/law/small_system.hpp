// Dense systems of a few contacts, on the stack.
#pragma once

#include <Eigen/QR>

namespace saltus {

inline constexpr int most_constraints = 64;  ///< contacts held closed at once; 32 kB a matrix

using SmallMat = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                               most_constraints, most_constraints>;
using SmallVec = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, most_constraints, 1>;

/// A x = b; where contacts are redundant and A is singular, the shortest of many solutions: four
/// legs of a table share its weight. Eigen's CompleteOrthogonalDecomposition does the same with a
/// vector from the heap.
inline SmallVec solve_small(const SmallMat& A, const SmallVec& b) {
  if (A.rows() == 1) return b / A(0, 0);
  Eigen::ColPivHouseholderQR<SmallMat> Q(A.rows(), A.cols());
  Q.setThreshold(1e-11);  // what redundant contacts leave is 1e-16 of A times its few rows
  Q.compute(A);
  const Eigen::Index rank = Q.rank();
  if (rank == A.cols()) return Q.solve(b);
  SmallVec c = b;
  c.applyOnTheLeft(Q.householderQ().adjoint());
  // R y = c with R (rank, n): y lies in the rows of R, R^T = Z T
  const SmallMat rows = Q.matrixR().topRows(rank).template triangularView<Eigen::Upper>();
  const Eigen::HouseholderQR<SmallMat> Z(SmallMat(rows.transpose()));
  SmallVec y = SmallVec::Zero(A.cols());
  y.head(rank) = c.head(rank);
  const auto T = Z.matrixQR().topRows(rank).template triangularView<Eigen::Upper>();
  T.transpose().solveInPlace(y.head(rank));
  y.applyOnTheLeft(Z.householderQ());
  return Q.colsPermutation() * y;
}

}  // namespace saltus
