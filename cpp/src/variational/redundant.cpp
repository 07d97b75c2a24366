#include "variational/redundant.hpp"

#include <Eigen/Core>
#include <cmath>
#include <numeric>
#include <utility>

namespace saltus {
namespace {

using Row = Eigen::Map<Eigen::RowVectorXd>;

/// Gauss elimination of a symmetric positive definite (n, n + 1): the solution in the last column.
void solve_definite(double* G, int n) {
  const auto row = [&](int i) { return Row(G + static_cast<std::ptrdiff_t>(i) * (n + 1), n + 1); };
  for (int k = 0; k < n; ++k) {
    for (int i = k + 1; i < n; ++i) {
      const double factor = row(i)[k] / row(k)[k];
      row(i).tail(n - k) -= factor * row(k).tail(n - k);
    }
  }
  for (int k = n - 1; k >= 0; --k) {
    double x = row(k)[n];
    for (int j = k + 1; j < n; ++j) x -= row(k)[j] * row(j)[n];
    row(k)[n] = x / row(k)[k];
  }
}

}  // namespace

void RedundantSystem::reserve(int unknowns) {
  const auto n = static_cast<std::size_t>(unknowns);
  for (auto* each : {&A_, &G_}) each->reserve(n * (n + 1));
  column_.reserve(n);
  x_.reserve(n);
}

void RedundantSystem::start(int unknowns) {
  n_ = unknowns;
  A_.assign(static_cast<std::size_t>(n_) * width(), 0.0);
  column_.resize(static_cast<std::size_t>(n_));
  std::iota(column_.begin(), column_.end(), 0);
}

/// Complete pivoting: what is left when the pivots end is rounding, 1e-11 as in solve_small.
void RedundantSystem::eliminate() {
  const auto row = [&](int i) { return Row(&A(i, 0), n_ + 1); };
  double largest = 0;
  for (rank_ = 0; rank_ < n_; ++rank_) {
    const int k = rank_;
    int at = k, of = k;
    double pivot = 0;
    for (int i = k; i < n_; ++i) {
      int best = 0;
      const double size = row(i).segment(k, n_ - k).cwiseAbs().maxCoeff(&best);
      if (size > pivot) pivot = size, at = i, of = k + best;
    }
    if (k == 0) largest = pivot;
    if (!(pivot > 1e-11 * largest)) return;
    if (at != k) row(at).swap(row(k));
    if (of != k) {
      for (int i = 0; i < n_; ++i) std::swap(A(i, of), A(i, k));
      std::swap(column_[of], column_[k]);
    }
    for (int i = k + 1; i < n_; ++i) {
      const double factor = A(i, k) / A(k, k);
      if (factor != 0) row(i).tail(n_ - k) -= factor * row(k).tail(n_ - k);
    }
  }
}

/// x = (x_0 - X y, y) for any y; the shortest has (1 + X^T X) y = X^T x_0.
void RedundantSystem::shorten() {
  const int d = n_ - rank_;
  G_.assign(static_cast<std::size_t>(d) * (d + 1), 0.0);
  const auto G = [&](int i) { return Row(&G_[static_cast<std::size_t>(i) * (d + 1)], d + 1); };
  for (int i = 0; i < d; ++i) G(i)[i] = 1;
  for (int k = 0; k < rank_; ++k) {
    const Row X(&A(k, rank_), d + 1);  // x_0 is its last
    for (int i = 0; i < d; ++i) G(i) += X[i] * X;
  }
  solve_definite(G_.data(), d);
  for (int k = 0; k < rank_; ++k) {
    for (int i = 0; i < d; ++i) b(k) -= A(k, rank_ + i) * G(i)[d];
  }
  for (int i = 0; i < d; ++i) b(rank_ + i) = G(i)[d];
}

void RedundantSystem::solve() {
  eliminate();
  const int d = n_ - rank_;
  for (int k = rank_ - 1; k >= 0; --k) {
    Row X(&A(k, rank_), d + 1);
    for (int j = k + 1; j < rank_; ++j) {
      if (A(k, j) != 0) X -= A(k, j) * Row(&A(j, rank_), d + 1);
    }
    X /= A(k, k);
  }
  if (d > 0) shorten();
  x_.resize(static_cast<std::size_t>(n_));
  for (int k = 0; k < n_; ++k) x_[column_[k]] = b(k);
  for (int k = 0; k < n_; ++k) b(k) = x_[k];
}

}  // namespace saltus
