// What the laws for contacts that hit together share.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "saltus/spatial/spatial.hpp"

namespace saltus {

/// Contacts that feel each other, directly or through others, in order.
using Part = std::vector<int>;

/// The parts of the contacts that are `in`. Contact i changes the rates of column[k] by the entries
/// start[i] <= k < start[i + 1] that `acts(k)`.
template <class Acts>
std::vector<Part> parts_of(const std::vector<int>& start, const std::vector<int>& column, Acts acts,
                           std::vector<char> in) {
  std::vector<Part> parts;
  for (int seed = 0; seed < static_cast<int>(in.size()); ++seed) {
    if (!in[seed]) continue;
    Part part{seed};
    in[seed] = 0;
    for (std::size_t at = 0; at < part.size(); ++at) {
      for (int k = start[part[at]]; k < start[part[at] + 1]; ++k) {
        const int j = column[k];
        if (!in[j] || !acts(k)) continue;
        in[j] = 0;
        part.push_back(j);
      }
    }
    std::sort(part.begin(), part.end());
    parts.push_back(std::move(part));
  }
  return parts;
}

/// The e of a part, by the energy |lambda u| that each contact takes up.
inline double shared_restitution(const VecRef& e, const VecX& energy) {
  if ((e.array() == e[0]).all()) return e[0];
  const double sum = energy.sum();
  return sum > 0 ? std::sqrt(e.cwiseAbs2().dot(energy) / sum) : 0;
}

}  // namespace saltus
