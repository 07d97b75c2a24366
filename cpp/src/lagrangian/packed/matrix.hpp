// The two ways to solve J x = r on one group; each writes its own fields of PackedMatrix.
#pragma once

#include "lagrangian/packed/path.hpp"
#include "saltus/lagrangian/packed_matrix.hpp"

namespace saltus::packed {

SALTUS_INLINE bool is_pivot(double D) { return std::abs(D) > 0 && std::isfinite(D); }

/// Rows of J, not yet eliminated: also what the dense matrix is made of.
void multiply_lu(const PackedGroup& g, PackedMatrix& J);
/// @return false where a pivot vanishes or is not a number.
bool eliminate_lu(const PackedGroup& g, PackedMatrix& J);
void solve_lu(const PackedGroup& g, PackedMatrix& J);
/// One tree of a group, x by position.
void solve_lane(const PackedGroup& g, int lane, PackedMatrix& J, double* x);

bool factorize_sweep(const PackedGroup& g, PackedMatrix& J);
/// @param transposed s with t and gain with row exchanged by the caller: J^-T
void solve_sweep(const PackedGroup& g, PackedMatrix& J, bool transposed = false);

}  // namespace saltus::packed
