#include "saltus/variational/cascade.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "variational/law/contact_problem.hpp"
#include "variational/law/contact_qp.hpp"
#include "variational/law/generalized_reflections.hpp"

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

/// After so many impulses u is computed anew from v: its updates round, so that the energy is off
/// by the square of their number, 2e-8 after 31415 impulses. Anew after each it is 2e-12, every 16
/// of them 2e-11, which has to do where N v costs more than the impulses.
int impulses_a_go(const Eigen::Ref<const MatX>& N) {
  return static_cast<int>(std::clamp<Eigen::Index>(N.size() / 256, 1, 16));
}

/// v + s w with w = M^-1 N^T lambda, lambda those from `first` on. Of a reflection on several
/// contacts s is what makes it one along w, so that it keeps the energy: 1 but for what a G near
/// singular leaves in lambda.
void add_impulses(const ContactProblem& problem, const Eigen::Ref<const MatX>& N, bool reflection,
                  std::size_t first, ImpactOutcome& out) {
  VecX w = VecX::Zero(out.v.size()), p = w;
  for (std::size_t k = first; k < out.impulses.size(); ++k) {
    const Impulse& impulse = out.impulses[k];
    w += problem.columns.col(impulse.pair) * impulse.lambda;
    p += N.row(impulse.pair).transpose() * impulse.lambda;
  }
  double s = 1;
  if (reflection && p.dot(w) > 0) s = -2 * p.dot(out.v) / p.dot(w);
  for (std::size_t k = first; k < out.impulses.size(); ++k) out.impulses[k].lambda *= s;
  out.v += s * w;
}

[[noreturn]] void refuse_endless(const ContactProblem& problem, int max_impulses) {
  const auto m = problem.u.size();
  std::ostringstream text;
  text << "the impact does not end within " << max_impulses << " impulses: ";
  const double interior = cone_interior(problem.G);
  if (interior == 0) {
    text << "bodies jammed between others, no velocity opens all " << m << " gaps";
  } else {
    text << "the " << m << " gaps can open, but at no more than " << interior
         << " of |v| at once, because masses or normals are so unlike; raise max_impulses";
  }
  throw JammedError(text.str(), 0, problem.u.minCoeff(), max_impulses);
}

}  // namespace

bool cascade(const ContactMatrix& G, Eigen::Ref<VecX> u, const VecRef& rest,
             const VecRef& restitution, const CascadeOptions& options, CascadeScratch& scratch,
             std::vector<Impulse>& impulses) {
  const int m = G.size();
  if (m == 0) return true;
  if (m > 1 && (restitution.array() == 0).all()) {
    project(G, u, rest, impulses);
    return true;
  }
  if (options.order == ImpactOrder::symmetric) {
    return reflect_together(G, u, rest, restitution, options.max_impulses, impulses);
  }
  scratch.key.resize(static_cast<std::size_t>(m));
  for (int i = 0; i < m; ++i) {
    scratch.key[i] = key_of(u[i], rest[i], G.diagonal[i], options.order);
  }
  start_tournament(m, scratch);
  for (int count = 0;; ++count) {
    const int i = scratch.winner[1];
    if (!(scratch.key[i] < 0)) return true;
    if (count == options.max_impulses) return false;
    const double lambda = -(1 + restitution[i]) * u[i] / G.diagonal[i];
    const double u_after = -restitution[i] * u[i];  // exact, without the rounding of G lambda
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
             const VecRef& restitution, const CascadeOptions& options,
             std::vector<Impulse>& impulses) {
  CascadeScratch scratch;
  return cascade(without_zeros(G), u, rest, restitution, options, scratch, impulses);
}

ImpactOutcome resolve_impact(const Eigen::Ref<const MatX>& M, const Eigen::Ref<const MatX>& N,
                             const VecRef& v, const VecRef& restitution,
                             const CascadeOptions& options) {
  if (options.max_impulses < 1) {
    throw ModelError("max_impulses " + std::to_string(options.max_impulses) + " is less than 1");
  }
  ContactProblem problem = contact_problem(M, N, v, restitution);
  const ContactMatrix G = without_zeros(problem.G);
  const bool together = options.order == ImpactOrder::symmetric;
  const bool reflections = together && (restitution.array() == 1).all();
  const int go = together ? 1 : impulses_a_go(N);  // a round
  CascadeScratch scratch;
  ImpactOutcome out{v, {}};
  for (bool ended = G.size() == 0; !ended;) {
    const std::size_t first = out.impulses.size();
    CascadeOptions some = options;
    some.max_impulses = std::clamp(options.max_impulses - static_cast<int>(first), 0, go);
    ended = cascade(G, problem.u, problem.rest, restitution, some, scratch, out.impulses);
    if (!ended && out.impulses.size() == first) refuse_endless(problem, options.max_impulses);
    add_impulses(problem, N, reflections, first, out);
    problem.u = N * out.v;
  }
  return out;
}

ImpactOutcome resolve_impact(const Eigen::Ref<const MatX>& M, const Eigen::Ref<const MatX>& N,
                             const VecRef& v, double restitution, const CascadeOptions& options) {
  return resolve_impact(M, N, v, VecX(VecX::Constant(N.rows(), restitution)), options);
}

}  // namespace saltus
