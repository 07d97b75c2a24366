// Newton's matrix of a round, and its solution: for pile.cpp.
#include <algorithm>
#include <cmath>

#include "variational/law/pile_island.hpp"

namespace saltus {

/// H = 1 + rho K^T P' L at s.trial.
void PileIsland::set_slope(double rho) {
  std::fill_n(s_.H.begin(), static_cast<std::ptrdiff_t>(r_) * r_, 0.0);
  for (int c = 0; c < r_; ++c) row_of_H(c)[c] = 1;
  for (int i = 0; i < k_; ++i) {
    Mat3 D;
    to_set(s_.trial[i], s_.friction[i], s_.bound[i], &D);
    if (D.isZero(0)) continue;
    for_each_span(i, [&](int first, int n) { set_row_slopes(rho, D, i, first, n); });
    for_each_span(i, [&](int from, int count) {
      for (int c = from; c < from + count; ++c) {
        for_each_span(i, [&](int first, int n) { add_to_slope(i, c, first, n); });
      }
    });
  }
}

/// rho P' L of the contact's three rows, of these columns.
void PileIsland::set_row_slopes(double rho, const Mat3& D, int i, int first, int n) {
  for (int a = 0; a < 3; ++a) {
    auto x = row_of_DL(a).segment(first, n);
    x.setZero();
    for (int b = 0; b < 3; ++b) {
      if (D(a, b) != 0) x += rho * D(a, b) * row_of_L(3 * i + b).segment(first, n);
    }
  }
}

/// Row c of H += K^T times them.
void PileIsland::add_to_slope(int i, int c, int first, int n) {
  auto h = row_of_H(c).segment(first, n);
  for (int a = 0; a < 3; ++a) {
    const double y = row_of_K(3 * i + a)[c];
    if (y != 0) h += y * row_of_DL(a).segment(first, n);
  }
}

/// dz = -H^-1 F, by elimination with pivots; what is beyond the ends of rows is left alone.
bool PileIsland::solve_slope() {
  for (int c = 0; c < r_; ++c) s_.dz[c] = -s_.F[c];
  s_.reach = s_.ends;
  int end = 0;  // rows from here on have nothing in this column, by the symmetry of what is where
  for (int c = 0; c < r_; ++c) {
    end = std::max({end, c + 1, s_.ends[c]});
    int pivot = c;
    for (int i = c + 1; i < end; ++i) {
      if (std::abs(row_of_H(i)[c]) > std::abs(row_of_H(pivot)[c])) pivot = i;
    }
    if (!(std::abs(row_of_H(pivot)[c]) > 0)) return false;
    if (pivot != c) {
      row_of_H(c).swap(row_of_H(pivot));
      std::swap(s_.dz[c], s_.dz[pivot]);
      std::swap(s_.reach[c], s_.reach[pivot]);
    }
    eliminate(c, end);
    s_.work += static_cast<double>(end - c) * static_cast<double>(s_.reach[c] - c);
  }
  for (int c = r_ - 1; c >= 0; --c) {
    const Row x(s_.dz.data(), r_);
    const int n = std::max(s_.reach[c], c + 1) - c - 1;
    const double known = row_of_H(c).segment(c + 1, n).dot(x.segment(c + 1, n));
    s_.dz[c] = (s_.dz[c] - known) / row_of_H(c)[c];
  }
  return true;
}

/// Column c out of the rows below, up to `end`.
void PileIsland::eliminate(int c, int end) {
  const Row own = row_of_H(c);
  const int n = std::max(s_.reach[c], c + 1) - c - 1;
  for (int i = c + 1; i < end; ++i) {
    Row row = row_of_H(i);
    const double factor = row[c] / own[c];
    if (factor == 0) continue;
    s_.reach[i] = std::max(s_.reach[i], s_.reach[c]);
    row.segment(c + 1, n) -= factor * own.segment(c + 1, n);
    s_.dz[i] -= factor * s_.dz[c];
  }
}

}  // namespace saltus
