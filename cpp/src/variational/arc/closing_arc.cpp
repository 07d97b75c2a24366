#include "variational/arc/closing_arc.hpp"

#include <cmath>
#include <limits>

namespace saltus {
namespace {

/// phi at the end of the arc (q, v, tau); its gradient in `n`.
double gap_at_end(const ModelData& model, const ArcProblem& a, const VecX& v, const Pair& pair,
                  ArcScratch& s, VecX& n) {
  integrate(model.tree, a.q, a.tau, v, s.q);
  place_end(model, s.q, s);
  const Gap gap = pair_gap_at_end(model, pair, s);
  place_chain_at_end(model, pair, s);
  n.setZero();
  add_gap_gradient(model.tree, s.kin_end, pair, gap, n);
  return gap.phi;
}

/// One Newton step of (v, tau). @return false where it leads out of (0, longest].
bool improve(const ModelData& model, const ArcProblem& a, double phi, const ClosingGap& gap,
             Arc& arc, ArcScratch& s) {
  set_second_partials(model, s);
  if (!factorize(model.tree, model.packed, s.w, a.tau, s.J)) return false;
  s.dv = s.r;
  solve(model.tree, model.packed, s.J, s.dv);
  set_arc_rate(model, a.tau, s, gap.rate);
  pull_back_end(model.packed, s.J, gap.n);
  const double slope = gap.n.dot(arc.v) + a.tau * gap.n.dot(gap.rate);
  const double dtau = -(phi + a.tau * gap.n.dot(s.dv)) / slope;
  const double tau = a.tau + dtau;
  if (!(slope < 0 && tau > 0 && tau <= gap.longest)) return false;
  arc.v += s.dv + dtau * gap.rate;
  arc.tau = tau;
  return arc.v.allFinite();
}

}  // namespace

bool solve_closing_arc(const ModelData& model, const ArcProblem& problem, const ClosingGap& gap,
                       Arc& arc, ArcScratch& s) {
  arc.tau = problem.tau;
  constexpr int most_iterations = 8;  // quadratic from a good guess: 2 to 4
  const double touch = gap.pair.touch;
  double before = std::numeric_limits<double>::infinity(), phi_before = before;
  for (arc.iterations = 0; arc.iterations <= most_iterations; ++arc.iterations) {
    const ArcProblem a{problem.q, problem.p, arc.tau, nullptr, problem.whole, problem.t};
    arc.residual = momentum_residual(model, a, arc.v, s);
    if (!std::isfinite(arc.residual)) return false;
    const double phi = gap_at_end(model, a, arc.v, gap.pair, s, gap.n);
    const bool stalled = std::abs(phi) <= touch / 2 && std::abs(phi) >= phi_before / 2;
    if (is_converged(arc.residual, before) && (std::abs(phi) <= 1e-3 * touch || stalled)) {
      finish_arc(model, a, arc, s);
      return true;
    }
    if (arc.iterations == most_iterations || !improve(model, a, phi, gap, arc, s)) return false;
    before = arc.residual;
    phi_before = std::abs(phi);
  }
  return false;
}

}  // namespace saltus
