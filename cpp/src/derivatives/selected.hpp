// Products with a matrix among a few of all velocities.
#pragma once

#include <vector>

#include "saltus/spatial/spatial.hpp"

namespace saltus {

/// to += factor H x, of a matrix (k, k) among the velocities (k).
template <class Matrix>
void add_selected(const Matrix& H, const std::vector<int>& velocities, const VecX& x, double factor,
                  VecX& to) {
  for (Eigen::Index r = 0; r < H.rows(); ++r) {
    double sum = 0;
    for (Eigen::Index c = 0; c < H.cols(); ++c) sum += H(r, c) * x[velocities[c]];
    to[velocities[r]] += factor * sum;
  }
}

}  // namespace saltus
