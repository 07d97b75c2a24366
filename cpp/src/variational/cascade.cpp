#include "saltus/variational/cascade.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <sstream>

namespace saltus {
namespace {

/// What a contact plays with: the least key is next, ties go to the lowest index.
double key_of(double u, double rest, double G_ii, ImpactOrder order) {
  if (!(u < -rest)) return 0;
  return order == ImpactOrder::index ? -1 : u / std::sqrt(G_ii);
}

void play(CascadeScratch& s, int match) {
  const int a = s.winner[2 * match], b = s.winner[2 * match + 1];
  s.winner[match] = b < 0 || (a >= 0 && s.key[a] <= s.key[b]) ? a : b;
}

/// All matches of m contacts; leaves beyond them are empty (-1).
void start_tournament(int m, CascadeScratch& s) {
  int leaves = 1;
  while (leaves < m) leaves *= 2;
  s.winner.assign(static_cast<std::size_t>(2 * leaves), -1);
  for (int i = 0; i < m; ++i) s.winner[leaves + i] = i;
  for (int match = leaves - 1; match > 0; --match) play(s, match);
}

/// The matches of one contact, up to the last.
void replay(int i, CascadeScratch& s) {
  for (int match = (static_cast<int>(s.winner.size()) / 2 + i) / 2; match > 0; match /= 2) {
    play(s, match);
  }
}

ContactMatrix without_zeros(const Eigen::Ref<const MatX>& G) {
  ContactMatrix out;
  for (int i = 0; i < G.rows(); ++i) {
    out.start.push_back(static_cast<int>(out.column.size()));
    out.diagonal.push_back(G(i, i));
    for (int j = 0; j < G.cols(); ++j) {
      if (G(i, j) == 0) continue;
      out.column.push_back(j);
      out.value.push_back(G(i, j));
    }
  }
  out.start.push_back(static_cast<int>(out.column.size()));
  return out;
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

bool cascade(const ContactMatrix& G, Eigen::Ref<VecX> u, const VecRef& rest,
             const CascadeOptions& options, CascadeScratch& scratch,
             std::vector<Impulse>& impulses) {
  const int m = G.size();
  if (m == 0) return true;
  scratch.key.resize(static_cast<std::size_t>(m));
  for (int i = 0; i < m; ++i) {
    scratch.key[i] = key_of(u[i], rest[i], G.diagonal[i], options.order);
  }
  start_tournament(m, scratch);
  for (int count = 0;; ++count) {
    const int i = scratch.winner[1];
    if (!(scratch.key[i] < 0)) return true;
    if (count == options.max_impulses) return false;
    const double lambda = -(1 + options.restitution) * u[i] / G.diagonal[i];
    const double u_after = -options.restitution * u[i];  // exact, without the rounding of G lambda
    for (int k = G.start[i]; k < G.start[i + 1]; ++k) {
      const int j = G.column[k];
      u[j] = j == i ? u_after : u[j] + G.value[k] * lambda;
      scratch.key[j] = key_of(u[j], rest[j], G.diagonal[j], options.order);
      replay(j, scratch);
    }
    impulses.push_back({i, lambda});
  }
}

bool cascade(const Eigen::Ref<const MatX>& G, Eigen::Ref<VecX> u, const VecRef& rest,
             const CascadeOptions& options, std::vector<Impulse>& impulses) {
  CascadeScratch scratch;
  return cascade(without_zeros(G), u, rest, options, scratch, impulses);
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
