// Joints of balls: what is different about them (theory, O1 and O2).
#pragma once

#include "lagrangian/packed/lane.hpp"
#include "saltus/lagrangian/packed_matrix.hpp"
#include "spatial/turn_series.hpp"

namespace saltus::packed {

/// Where the three joints of one ball are.
struct BallSlots {
  int x, y, z;
};

/// Calls kernel(slots, lane) for every ball of the group; numbers are at(blocks, slot) + lane.
/// Equal trees in lanes.
template <class Kernel>
SALTUS_INLINE void for_each_ball(const PackedGroup& g, const Kernel& kernel) {
  for (const int k : g.balls) {
    const BallSlots first{g.slot(k), g.slot(k + 1), g.slot(k + 2)};
    if (g.width == 1) {
      kernel(first, 0);
      continue;
    }
    for (int b = 0; b < g.width; b += lanes) {
      const BallSlots slots{first.x + b, first.y + b, first.z + b};
      SALTUS_LANES
      for (int l = 0; l < lanes; ++l) kernel(slots, l);
    }
  }
}

/// Calls kernel(third slot, lane, x = |tau w|^2) for every ball where all turns of its lanes are
/// small, and by_hand(third slot, f) for the others.
template <class Kernel, class ByHand>
SALTUS_INLINE void for_each_turn(const PackedGroup& g, const Packed& w, double tau,
                                 const Kernel& kernel, const ByHand& by_hand) {
  for (const int k : g.balls) {
    for (int b = 0; b < g.width; b += lanes) {
      const int z = g.slot(k + 2) + b, last = g.width == 1 ? 1 : lanes;
      const double *rx = at(w.s_dot, g.slot(k) + b), *ry = at(w.s_dot, g.slot(k + 1) + b);
      const double* rz = at(w.s_dot, z);
      double x[lanes] = {};
      bool all_small = true;
      SALTUS_LANES
      for (int l = 0; l < last; ++l) {
        x[l] = tau * tau * (rx[l] * rx[l] + ry[l] * ry[l] + rz[l] * rz[l]);
      }
      for (int l = 0; l < last; ++l) all_small = all_small && x[l] < turn_series::small;
      if (all_small) {
        SALTUS_LANES
        for (int l = 0; l < last; ++l) kernel(z, l, x[l]);
      } else {
        for (int l = 0; l < last; ++l) by_hand(z + l, tau * Vec3(rx[l], ry[l], rz[l]));
      }
    }
  }
}

/// One number of each of the three joints.
SALTUS_INLINE V3 load_ball(const double* x, const double* y, const double* z) {
  return {*x, *y, *z};
}

/// R of the third joints, in their parents' frames: placement times the quaternion's.
void turn_balls(const PackedTree& t, Packed& w);
/// S of the third joints, whose axis is not that of their frame.
void set_ball_screws(const PackedTree& t, Packed& w);
/// W of the first two joints, with V of the third.
void set_ball_twists(const PackedTree& t, Packed& w);
/// L_v', L_q' of balls' joints; needs w.arc as if there were none.
void correct_momenta(const PackedTree& t, double tau, Packed& w);
/// Generators, K, C and Delta of an arc; needs arc_pass at the same tau, and the generators as if
/// there were no balls.
void set_ball_generators(const PackedTree& t, const Packed& w, double tau, PackedMatrix& J);
/// The nine entries of a ball in the rows of J. Needs set_ball_generators and the rows.
void set_ball_entries(const PackedGroup& g, PackedMatrix& J);

}  // namespace saltus::packed
