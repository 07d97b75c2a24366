// Products and inverses of dense matrices of a model's size.
#pragma once

#include "saltus/spatial/spatial.hpp"

namespace saltus {

/// C += A B.
void add_product(const MatX& A, const MatX& B, MatX& C);

/// A <- A^-1 by Gauss and Jordan, from the last row to the first and without pivots: for matrices
/// that are nearly symmetric and positive. @return false where a pivot vanishes or is not a number
bool invert(MatX& A);

}  // namespace saltus
