// The Lagrangian and all its first and second partials as dense arrays, for people.
#pragma once

#include "saltus/lagrangian/packed_rows.hpp"

namespace saltus {

/// L = T - V at one (q, v). Row = velocity in L_vq: `L_vq(i, j) = d2L / dv_i dq_j`.
///
/// Derivatives by q are along velocities (n_v). Of a ball they are by eta of R -> exp(eta) R in the
/// axes of its placement, with the angular velocity in these axes held: L_q(i) is the slope along
/// eta_i, and L_qq(i, j) that of L_q(i) along eta_j, which is not symmetric within a ball.
struct LagrangianPartials {
  double value = 0;  ///< [J]
  VecX L_q;          ///< (n_v)
  VecX L_v;          ///< (n_v) the momenta
  MatX L_qq;         ///< (n_v, n_v)
  MatX L_vq;         ///< (n_v, n_v)
  MatX L_vv;         ///< (n_v, n_v) the mass matrix
};

/// O(n depth) after the two passes; theory, section 2. `packed` is pack(tree, mass).
SALTUS_EXPORT LagrangianPartials lagrangian(const Tree& tree, const PackedTree& packed,
                                            const VecRef& q, const VecRef& v);

/// The same into `L`, whose arrays are used again: of a large model most of the time is that of
/// getting and touching new memory.
SALTUS_EXPORT void lagrangian(const Tree& tree, const PackedTree& packed, const VecRef& q,
                              const VecRef& v, LagrangianPartials& L);

/// p = L_v alone (n_v), in O(n): the same bits as above.
SALTUS_EXPORT VecX momenta(const Tree& tree, const PackedTree& packed, const VecRef& q,
                           const VecRef& v);

/// M(q) = L_vv, (n_v, n_v).
SALTUS_EXPORT MatX mass_matrix(const Tree& tree, const PackedTree& packed, const VecRef& q);

/// The same for a tree that is used once.
inline LagrangianPartials lagrangian(const Tree& tree, const MassModel& mass, const VecRef& q,
                                     const VecRef& v) {
  return lagrangian(tree, pack(tree, mass), q, v);
}
/// The same for a tree that is used once.
inline MatX mass_matrix(const Tree& tree, const MassModel& mass, const VecRef& q) {
  return mass_matrix(tree, pack(tree, mass), q);
}

}  // namespace saltus
