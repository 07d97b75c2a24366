// Products of the generators for every pair of joints on a branch, packed by depth.
//
// Row of joint j: one entry for each joint i from the root to j, in order of level, so that loops
// over ancestors run along memory. Pairs that are not on a branch are zero and have no entry.
#pragma once

#include "saltus/lagrangian/packed.hpp"

namespace saltus {

/// Entry `level` of the row of joint (position, lane) of group g is number
/// g.row[position] * lanes + level * g.width + lane.
using PackedRows = Blocks<1>;

/// Calls f(j, i, entry) for every joint j and each i at or above it.
template <class F>
void for_each_pair(const PackedTree& t, const F& f) {
  for (const PackedGroup& g : t.groups) {
    for (int k = 0; k < g.positions; ++k) {
      for (int lane = 0; lane < g.trees; ++lane) {
        const int j = t.joint[g.slot(k) + lane];
        for (int i = k; i >= 0; i = g.parent[i]) {
          const long entry = g.row[k] * lanes + g.level[i] * g.width + lane;
          f(j, t.joint[g.slot(i) + lane], entry);
        }
      }
    }
  }
}

inline double number(const PackedRows& rows, long entry) {
  return rows[entry / lanes].x[0][entry % lanes];
}

/// All second partials of L that are not zero: row j, entry i of
struct SecondPartials {
  PackedRows L_vv;  ///< L_vv[i, j] = S_i.U_j
  PackedRows L_qq;  ///< L_qq[i, j] = W_i.F_j + S_i.G_j
  PackedRows L_vq;  ///< L_vq[i, j] = S_i.F_j
  PackedRows L_qv;  ///< L_vq[j, i] = W_i.U_j, within a ball S_j.F_i
  /// Within a ball, in the slot of its third joint: L_qq[y, x], [z, x], [z, y], where L_qq is not
  /// symmetric. Empty without balls.
  Blocks<3> L_qq_lower;
  Blocks<12> path;  ///< scratch: S, W of the ancestors, by level

  SecondPartials() = default;
  SALTUS_EXPORT explicit SecondPartials(const PackedTree& tree);
};

/// Needs second_pass.
SALTUS_EXPORT void multiply_pairs(const PackedTree& packed, const Packed& w, SecondPartials& out);

}  // namespace saltus
