#include "saltus/constraint/equality_solver.hpp"

#include <cmath>

namespace saltus {
namespace {

/// Of the largest pivot or singular value, which are near 1.
constexpr double independent = 1e-8, redundant = 1e-11;

}  // namespace

EqualitySolver::EqualitySolver(int n_v, const EqualityModel& model)
    : lu_(model.rows, model.rows),
      svd_(model.rows, model.rows, Eigen::ComputeFullU | Eigen::ComputeFullV) {
  const int rows = model.rows;
  for (Columns* each : {&C, &Y}) each->setZero(n_v, rows);
  for (VecX* each : {&mu, &lock, &scale_, &none_, &y_}) each->setZero(rows);
  S_.setZero(rows, rows);
  for (const Equality& e : model.all) lock[e.first] = e.lock;
}

bool EqualitySolver::is_regular() const {
  const auto pivots = lu_.matrixLU().diagonal().cwiseAbs();
  return pivots.minCoeff() > independent * pivots.maxCoeff();
}

bool EqualitySolver::factorize() {
  weak_row = -1;
  S_.noalias() = C.transpose() * Y;
  if (!S_.allFinite()) return false;
  const double most = S_.diagonal().cwiseAbs().maxCoeff();
  for (Eigen::Index k = 0; k < S_.rows(); ++k) {
    const double own = std::abs(S_(k, k));
    // a row that nothing can move along is rounding, and none of its digits is to be trusted
    scale_[k] = own > redundant * redundant * most ? 1 / std::sqrt(own) : 0;
  }
  S_ = scale_.asDiagonal() * S_ * scale_.asDiagonal();
  lu_.compute(S_);
  regular_ = is_regular();
  return regular_ || decompose();
}

bool EqualitySolver::decompose() {
  svd_.compute(S_);
  const VecX& values = svd_.singularValues();
  rank_ = 0;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    const double part = values[0] > 0 ? values[k] / values[0] : 0;
    if (part > independent) ++rank_;
    if (part > independent || part < redundant) continue;
    svd_.matrixU().col(k).cwiseAbs().maxCoeff(&weak_row);
    return false;
  }
  return true;
}

/// mu <- S^+ mu, scaled.
void EqualitySolver::solve() {
  if (regular_) {
    y_.noalias() = lu_.permutationP() * mu;
    lu_.matrixLU().triangularView<Eigen::UnitLower>().solveInPlace(y_);
    lu_.matrixLU().triangularView<Eigen::Upper>().solveInPlace(y_);
    mu.noalias() = lu_.permutationQ() * y_;
    return;
  }
  y_.head(rank_).noalias() = svd_.matrixU().leftCols(rank_).transpose() * mu;
  for (Eigen::Index k = 0; k < rank_; ++k) y_[k] /= svd_.singularValues()[k];
  mu.noalias() = svd_.matrixV().leftCols(rank_) * y_.head(rank_);
}

void EqualitySolver::meet(const VecX& g, VecX& x) {
  mu = g;
  mu.noalias() -= C.transpose() * x;
  mu.array() *= scale_.array();
  solve();
  mu.array() *= scale_.array();
  x.noalias() += Y * mu;
  mu.array() -= lock.array() * g.array();
}

void EqualitySolver::hold(VecX& x) { meet(none_, x); }

}  // namespace saltus
