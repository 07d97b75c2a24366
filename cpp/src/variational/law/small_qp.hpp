// A dense convex quadratic program, by ProxQP (of ProxSuite): A. Bambade et al., "PROX-QP: Yet
// another Quadratic Programming Solver for Robotics and beyond", RSS 2022.
#pragma once

#include <Eigen/Core>

namespace saltus {

/// The x of least  x . H x / 2 + g . x  subject to  A x = b,  C x >= c. H may be singular.
/// @param H (n, n) symmetric to the last bit, positive semidefinite; @param g (n)
/// @param A (k, n); @param b (k); k = 0 for none; @param C (l, n); @param c (l)
/// @return (n) to 1e-10 absolute in the best case: scale before, check after
Eigen::VectorXd solve_qp(const Eigen::MatrixXd& H, const Eigen::VectorXd& g,
                         const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                         const Eigen::MatrixXd& C, const Eigen::VectorXd& c);

}  // namespace saltus
