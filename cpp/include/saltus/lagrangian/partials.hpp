// The Lagrangian and all its first and second partials as dense arrays, for people.
#pragma once

#include "saltus/lagrangian/packed_rows.hpp"

namespace saltus {

/// L = T - V at one (q, v). Row = velocity in L_vq: `L_vq(i, j) = d2L / dv_i dq_j`.
struct LagrangianPartials {
  double value = 0;  ///< [J]
  VecX L_q, L_v;     ///< (n_q)
  MatX L_qq, L_vq;   ///< (n_q, n_q)
  MatX L_vv;         ///< (n_q, n_q) the mass matrix
};

/// O(n depth) after the two passes; theory, section 2. `packed` is pack(tree, mass).
SALTUS_EXPORT LagrangianPartials lagrangian(const Tree& tree, const PackedTree& packed,
                                            const VecRef& q, const VecRef& v);

/// M(q) = L_vv, (n_q, n_q).
SALTUS_EXPORT MatX mass_matrix(const Tree& tree, const PackedTree& packed, const VecRef& q);

/// The same for a tree that is used once.
inline LagrangianPartials lagrangian(const Tree& tree, const MassModel& mass, const VecRef& q,
                                     const VecRef& v) {
  return lagrangian(tree, pack(tree, mass), q, v);
}
inline MatX mass_matrix(const Tree& tree, const MassModel& mass, const VecRef& q) {
  return mass_matrix(tree, pack(tree, mass), q);
}

}  // namespace saltus
