// The two small convex problems of several contacts.
//
//   projection   min over lambda >= 0 of  lambda . G lambda / 2 + u . lambda,  the dual of
//                min over w of  |w - v|_M^2 / 2  subject to  N w >= 0:  w = v + M^-1 N^T lambda
//   interior     max over |w|_M <= 1 of  min_i n_i . w / sqrt(G_ii)
//
// Which contacts take part, settle_pile (pile.hpp) says, of contacts without friction; the numbers
// are then those of one direct solve, and what comes back has been checked. Contacts are scaled to
// G_ii = 1 before, so that light and heavy bodies count alike.
#pragma once

#include "saltus/spatial/spatial.hpp"

namespace saltus {

/// 0 <= lambda, 0 <= u + G lambda, and one of both 0 at each contact. Where contacts are redundant
/// (G singular) the shortest lambda of many, which treats contacts alike that are alike.
/// @param G (m, m) positive semidefinite, no zero on its diagonal; @param u (m) in its range, as
///        N v is for G = N M^-1 N^T
/// @return (m) lambda
/// @throws StepError where the conditions are missed by more than 1e-10 of the largest u and
/// lambda.
VecX contact_multipliers(const Eigen::Ref<const MatX>& G, const VecRef& u);

/// How fast all gaps can open at once: the largest d with n_i . w >= d sqrt(G_ii) for all i and
/// |w|_M = 1; 0 where none is positive: the cone {w: N w >= 0} has no interior. By duality it is
/// the distance of the hull of the normals from 0, min over the simplex of sqrt(lambda . G lambda).
/// @param G (m, m), m > 0, as above
/// @return a rate that the w found does reach; below 1e-7, the root of rounding, it is 0
double cone_interior(const Eigen::Ref<const MatX>& G);

}  // namespace saltus
