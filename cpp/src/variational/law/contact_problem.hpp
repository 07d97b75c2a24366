// Several contacts at one instant, in contact space: what M, N, v and e say of them.
//
// With rows n_i = phi_q: columns = M^-1 N^T, G = N M^-1 N^T, u = N v (theory, section 6).
#pragma once

#include "saltus/variational/friction.hpp"

namespace saltus {

/// Written by contact_problem().
struct ContactProblem {
  Eigen::MatrixXd columns;  ///< (n, m) M^-1 n_i: what a unit impulse does to v
  MatX G;                   ///< (m, m) symmetric, positive semidefinite, no zero on its diagonal
  VecX u;                   ///< (m) gap rates
  VecX rest;                ///< (m) epsilon_u: the rounding of u
  double speed;             ///< |v|_M = sqrt(v . M v)
};

/// @param M (n, n); @param N (m, n) rows phi_q; @param v (n); @param restitution (m) in [0, 1]
/// @throws ModelError on shapes that do not fit, values that are not finite, M not positive
///         definite, a row of N that is zero, e outside [0, 1].
ContactProblem contact_problem(const Eigen::Ref<const MatX>& M, const Eigen::Ref<const MatX>& N,
                               const VecRef& v, const VecRef& restitution);

/// G of some contacts, dense.
/// @param part indices, ascending
MatX dense_part(const ContactMatrix& G, const std::vector<int>& part);

/// W (3 m, 3 m) by contacts, without friction, restitution and rest.
ContactBlocks contact_blocks(const MatX& W);

}  // namespace saltus
