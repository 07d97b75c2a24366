// Linear systems of any number of contacts, some of which may follow from others.
#pragma once

#include <vector>

namespace saltus {

/// A x = b as solve_small (small_system.hpp) has it, without its bound: where A is singular the
/// shortest of many solutions. Its memory grows with the largest system and then stays.
class RedundantSystem {
 public:
  void reserve(int unknowns);
  void start(int unknowns);  ///< all zero
  double& A(int i, int j) { return A_[static_cast<std::size_t>(i) * width() + j]; }
  double& b(int i) { return A(i, n_); }  ///< before solve() the right side, then the solution
  void solve();
  int rank() const { return rank_; }

 private:
  std::size_t width() const { return static_cast<std::size_t>(n_) + 1; }
  void eliminate();
  void shorten();

  int n_ = 0, rank_ = 0;
  std::vector<double> A_;  ///< (n, n + 1) by rows, b the last column
  std::vector<int> column_;
  std::vector<double> G_, x_;
};

}  // namespace saltus
