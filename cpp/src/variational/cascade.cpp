#include "saltus/variational/cascade.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <sstream>

namespace saltus {
namespace {

/// The contact to reflect on next, -1 when none approaches.
int next_contact(const Eigen::Ref<const MatX>& G, const VecRef& u, const VecRef& rest,
                 ImpactOrder order) {
  int best = -1;
  double fastest = 0;
  for (int i = 0; i < u.size(); ++i) {
    if (!(u[i] < -rest[i])) continue;
    if (order == ImpactOrder::index) return i;
    const double speed = u[i] / std::sqrt(G(i, i));
    if (speed < fastest) {
      fastest = speed;
      best = i;
    }
  }
  return best;
}

void check_problem(const Eigen::Ref<const MatX>& M, const Eigen::Ref<const MatX>& N,
                   const VecRef& v, const CascadeOptions& options) {
  std::ostringstream text;
  const auto n = v.size();
  if (M.rows() != n || M.cols() != n) {
    text << "M is (" << M.rows() << ", " << M.cols() << "); v has " << n << " entries, so M is ("
         << n << ", " << n << ")";
  } else if (N.cols() != n && N.rows() > 0) {
    text << "N is (" << N.rows() << ", " << N.cols() << "); v has " << n
         << " entries, so N is (contacts, " << n << "), a row a contact";
  } else if (!M.allFinite() || !N.allFinite() || !v.allFinite()) {
    text << "M, N or v holds a value that is not finite";
  } else if ((M - M.transpose()).norm() > 1e-12 * M.norm()) {
    text << "M is not symmetric: it differs from its transpose by " << (M - M.transpose()).norm();
  } else if (!(options.restitution >= 0 && options.restitution <= 1)) {
    text << "restitution " << options.restitution << " is outside [0, 1]";
  } else if (options.max_impulses < 1) {
    text << "max_impulses " << options.max_impulses << " is less than 1";
  }
  if (!text.str().empty()) throw ModelError(text.str());
}

void check_rows(const Eigen::Ref<const MatX>& N) {
  for (int i = 0; i < N.rows(); ++i) {
    if (N.row(i).norm() > 0) continue;
    throw ModelError("row " + std::to_string(i) + " of N is zero: no normal");
  }
}

}  // namespace

bool cascade(const Eigen::Ref<const MatX>& G, Eigen::Ref<VecX> u, const VecRef& rest,
             const CascadeOptions& options, std::vector<Impulse>& impulses) {
  for (int count = 0; count < options.max_impulses; ++count) {
    const int i = next_contact(G, u, rest, options.order);
    if (i < 0) return true;
    const double lambda = -(1 + options.restitution) * u[i] / G(i, i);
    const double u_after = -options.restitution * u[i];  // exact, without the rounding of G lambda
    u += G.col(i) * lambda;
    u[i] = u_after;
    impulses.push_back({i, lambda});
  }
  return next_contact(G, u, rest, options.order) < 0;
}

ImpactOutcome resolve_impact(const Eigen::Ref<const MatX>& M, const Eigen::Ref<const MatX>& N,
                             const VecRef& v, const CascadeOptions& options) {
  check_problem(M, N, v, options);
  check_rows(N);
  const Eigen::LLT<Eigen::MatrixXd> llt(M);
  if (llt.info() != Eigen::Success) throw ModelError("M is not positive definite");
  ImpactOutcome out{v, {}};
  if (N.rows() == 0) return out;
  const Eigen::MatrixXd columns = llt.solve(N.transpose());  // M^-1 n_i
  const MatX G = N * columns;
  VecX u = N * v;
  // 1e-13 of the greatest rate that this kinetic energy allows: the rounding of u
  const double speed = std::sqrt(std::max(0.0, v.dot(M * v)));
  const VecX rest = 1e-13 * speed * G.diagonal().array().sqrt();
  if (!cascade(G, u, rest, options, out.impulses)) {
    std::ostringstream text;
    text << "the impact does not end within " << options.max_impulses
         << " impulses: bodies jammed between others, or max_impulses is too small";
    throw JammedError(text.str(), 0, u.minCoeff(), options.max_impulses);
  }
  for (const Impulse& impulse : out.impulses) {
    out.v += columns.col(impulse.pair) * impulse.lambda;
  }
  return out;
}

}  // namespace saltus
