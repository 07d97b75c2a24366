// The rows that loops push along, and how they turn with the configuration.
//
// Row k of h (equality.hpp) moves with joint i of an end as d.xi_i(P), xi_i the velocity at P of a
// unit of its screw, or as d.w_i where it is of the turn of a weld. With joint j the points move by
// P', d by d', and screws below j turn:
//
//   d'.xi_i + d.(w_i x P') + d.(w_j x xi_i - w_i x xi_j)       the last where j is above i
//
// What a joint's placement moves is a screw that does not turn: w_j = 0, xi_j = e.
#pragma once

#include "derivatives/frame_derivative.hpp"

namespace saltus {

/// Row `number` of h as a frame's first row; the other two stay 0.
void set_loop_row(const ModelData& model, const Kinematics& kin, int number, FrameDerivative& out);

/// Adds what steps of joints' placements make of the row, row_hat its covector or empty, and of h
/// itself: to (joints of the tree, 3).
void add_loop_placements(const ModelData& model, const Kinematics& kin, int number,
                         const VecX& row_hat, double of_h, MatX& to);

}  // namespace saltus
