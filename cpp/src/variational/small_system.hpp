// Dense systems of a few contacts, on the stack.
#pragma once

#include <Eigen/LU>

namespace saltus {

inline constexpr int most_constraints = 32;  ///< contacts held closed at once; 8 kB a matrix

using SmallMat = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                               most_constraints, most_constraints>;
using SmallVec = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, most_constraints, 1>;

/// A x = b; one solution of many where contacts are redundant and A is singular.
inline SmallVec solve_small(const SmallMat& A, const SmallVec& b) {
  return Eigen::FullPivLU<SmallMat>(A).solve(b);
}

}  // namespace saltus
