#include "derivatives/energy_derivative.hpp"

#include "saltus/lagrangian/shadow.hpp"

namespace saltus {
namespace {

const TapeImpact& impact_before(const Tape& tape, const TapeArc& arc) {
  const TapeImpact* found = nullptr;
  for (const Tape::Piece& piece : tape.pieces) {
    const auto k = static_cast<std::size_t>(piece.index);
    if (piece.is_arc && &tape.arcs[k] == &arc) break;
    if (!piece.is_arc) found = &tape.impacts[k];
  }
  return *found;  // a match has an impact before it
}

void check_match(const ModelData& model, const Tape& tape, const TapeArc& arc,
                 const TapeImpact& impact) {
  const auto refuse = [](const std::string& what) {
    throw ModelError("the step has no derivative yet: it has " + what);
  };
  for (const TapeContact& c : impact.contacts) {
    if (c.restitution < 1) refuse("a restitution below 1 with a law that matches energies");
  }
  if (tape.law != ImpactLaw::shadow_energy) return;
  if (arc.end == TapeArc::End::gap) {
    refuse("an impact after one whose law is shadow_energy");
  }
  if (!model.tree.balls.empty()) refuse("a ball or free joint with the law shadow_energy");
  for (const PotentialFunction& each : model.mass.potentials.functions) {
    refuse("the potential \"" + each.name + "\", a function, with the law shadow_energy");
  }
}

}  // namespace

void EnergyGradient::pull(double of_energy, Tangent& z) const {
  z.q += of_energy * q;
  z.p += of_energy * p;
  z.h += of_energy * h;
}

void set_energy_gradient(const ModelData& model, const Tape& tape, const VecX& q, const VecX& p,
                         EnergyGradient& out) {
  NodeDerivative node(model);
  node.t = tape.t;
  node.q = q;
  set_node_derivative(model, tape, tape.t, q, node.zero, node.motion);
  Tangent motion;
  set_flow(model, tape, p, node, motion);
  gather(model.tree, model.packed, node.motion.s.w.first, 1, out.q);
  out.q = -out.q;
  out.p = motion.q;
  out.h = 0;
}

void set_shadow_gradient(const ModelData& model, const VecX& q, const VecX& p, double h,
                         EnergyGradient& out) {
  const Tree& tree = model.tree;
  const PackedTree& packed = model.packed;
  Packed w(packed);
  PackedMatrix M(tree, packed);
  FreeMotion free(tree, packed);
  ShadowTerm shadow(tree, packed);
  HessianProduct product(tree);
  set_coordinates(tree, packed, q, w);
  place(packed, w);
  mass_pass(packed, w);
  factorize(tree, packed, w, 0, M);
  VecX v = p;
  solve(tree, packed, M, v);
  set_rates(tree, packed, v, w);
  move(packed, w);
  first_pass(packed, w);
  second_pass(packed, w);
  free_motion(tree, packed, w, M, free);
  shadow_gradient(tree, packed, w, free.a, shadow);
  VecX lifted = shadow.kappa_v;
  solve(tree, packed, M, lifted);
  take_generators(tree, packed, w, product);
  multiply_by_transposed(tree, packed, w, VecX::Zero(tree.n_v), lifted, product);
  const double c = h * h / 24;
  out.q.resize(tree.n_v);
  gather(tree, packed, w.first, 1, out.q);
  out.q = -out.q - c * (shadow.kappa_q - product.by_q);
  out.p = v - c * lifted;
  out.h = -h / 12 * shadow.kappa;
}

void set_match(const ModelData& model, const Tape& tape, const TapeArc& told, ArcDerivative& arc,
               MatchDerivative& out) {
  out.is_set = told.matched >= 0;
  if (!out.is_set) return;
  const TapeImpact& impact = impact_before(tape, told);
  check_match(model, tape, told, impact);
  out.delta = told.delta;
  Kinematics kin(model.tree);
  set_configuration(model.tree, told.q, kin);
  const auto contact = static_cast<std::size_t>(told.matched);
  set_gap_derivative(model, kin, impact.contacts[contact].pair, out.gap);
  out.end.q.resize(0);
  if (tape.law == ImpactLaw::shadow_energy) {
    set_shadow_gradient(model, told.q_end, told.p_end, tape.h, out.end);
  }
  const VecX none = VecX::Zero(model.tree.n_v);
  out.R = {none, out.gap.n, 0, 0};
  push_forward(model, arc, none, 0, out.R);
  if (out.end.q.size() > 0) out.R.energy = out.end.dot(out.R);
}

void push_matched(const ModelData& model, const MatchDerivative& match, ArcDerivative& arc,
                  const VecX& dQ, double dtau, Tangent& z) {
  if (!match.is_set) return push_forward(model, arc, dQ, dtau, z);
  const double before = z.energy;
  add_gradient_change(match.gap, z.q, match.delta, z.p);
  push_forward(model, arc, dQ, dtau, z);
  const double now = match.end.q.size() > 0 ? match.end.dot(z) : z.energy;
  const double ddelta = (before - now) / match.R.energy;
  z.q += ddelta * match.R.q;
  z.p += ddelta * match.R.p;
  z.energy = before;
}

double pull_matched(const ModelData& model, const MatchDerivative& match, ArcDerivative& arc,
                    VecX& Q, Tangent& z) {
  if (!match.is_set) return pull_back(model, arc, Q, z);
  const double of_delta = match.R.q.dot(z.q) + match.R.p.dot(z.p);
  const double of_energy = of_delta / match.R.energy, before = z.energy + of_energy;
  if (match.end.q.size() > 0) {
    match.end.pull(-of_energy, z);
    z.energy = 0;
  } else {
    z.energy = -of_energy;
  }
  const double of_tau = pull_back(model, arc, Q, z);
  add_gradient_covector(match.gap, z.p, match.delta, z.q);
  z.energy = before;
  return of_tau;
}

}  // namespace saltus
