// The pieces of a step in their order, and in reverse.
#include <limits>

#include "derivatives/applied_derivative.hpp"
#include "derivatives/contact_placements.hpp"
#include "derivatives/program.hpp"

namespace saltus {
namespace {

using Kind = StepProgram::Kind;

void shift(const Tangent& b, const VecX& n, double slope, Tangent& z, double& left) {
  const double sigma = -n.dot(z.q) / slope;
  z.q += sigma * b.q;
  z.p += sigma * b.p;
  z.energy += sigma * b.energy;
  left -= sigma;
}

/// @return the covector of the gap
double shift_back(const Tangent& b, const VecX& n, double slope, Tangent& z, double left) {
  const double of_sigma = b.q.dot(z.q) + b.p.dot(z.p) + b.energy * z.energy - left;
  z.q -= of_sigma / slope * n;
  return -of_sigma / slope;
}

double entry(const VecX& x, int k) { return x.size() > 0 ? x[k] : 0; }

Vec3 row_of(const MatX& x, std::size_t k) {
  return x.size() > 0 ? Vec3(x.row(static_cast<Eigen::Index>(k)).transpose()) : Vec3(Vec3::Zero());
}

/// [s] What an arc's duration changes by, where the step's does by h and `left` of it is left.
double duration_of(const StepProgram::Piece& piece, double h, double left) {
  if (piece.kind == Kind::rest) return left;
  return piece.kind == Kind::part ? piece.part * h : 0;
}

void push_impact(double de, const Rubbing& friction, ImpactPieces& impact, Tangent& z,
                 double& left) {
  if (impact.is_together) {
    const VecX& n = impact.node.gaps[static_cast<std::size_t>(impact.first)].n;
    shift(impact.flow, n, impact.slope, z, left);
    push_kick(impact.kick, VecX(), friction, z);
    return;
  }
  for (const FrictionDerivative& each : impact.rubbing) {
    const VecX& n = impact.node.gaps[static_cast<std::size_t>(each.contact)].n;
    shift(each.flow, n, each.slope, z, left);
    push_friction(each, de, friction, z);
  }
  for (const ImpulseDerivative& each : impact.impulses) {
    const GapDerivative& gap = impact.node.gaps[static_cast<std::size_t>(each.contact)];
    shift(each.flow, gap.n, each.slope, z, left);
    push_impulse(gap, each, de, z);
  }
}

/// The next contact of a trajectory along z (theory, D4): of those that approach with the motion b,
/// whose gap closes first. @return -1 where none approaches
int first_contact(const TapeImpact& told, const ImpactPieces& impact, const Tangent& b,
                  const Tangent& z) {
  int first = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < impact.node.gaps.size(); ++i) {
    const VecX& n = impact.node.gaps[i].n;
    const double rate = n.dot(b.q);
    if (!(rate < -told.contacts[i].epsilon_u)) continue;
    const double sigma = -n.dot(z.q) / rate;
    if (sigma < least) least = sigma, first = static_cast<int>(i);
  }
  return first;
}

void push_along(const ModelData& model, const Tape& tape, const TapeImpact& told, double de,
                ImpactPieces& impact, Tangent& z, double& left) {
  VecX p = impact.p_before;
  Tangent b = impact.arrival;
  if (b.q.size() == 0) set_flow(model, tape, p, impact.node, b);
  ImpulseDerivative impulse;
  for (int count = 0;; ++count) {
    const int i = first_contact(told, impact, b, z);
    if (i < 0) return;
    if (count == 100000) throw ModelError("the impulses along this direction do not end");
    const GapDerivative& gap = impact.node.gaps[static_cast<std::size_t>(i)];
    shift(b, gap.n, gap.n.dot(b.q), z, left);
    set_impulse(model, tape, i, p, impact.node, impulse);
    push_impulse(gap, impulse, de, z);
    set_flow(model, tape, p, impact.node, b);
  }
}

}  // namespace

void push_piece(const ModelData& model, const Tape& tape, const StepDirection& by, Order order,
                const StepProgram::Piece& piece, StepProgram& program, Tangent& z, double& left) {
  const auto k = static_cast<std::size_t>(piece.index);
  program.friction.value = by.friction;
  if (piece.kind == Kind::impact) {
    ImpactPieces& impact = *program.impacts[k];
    const double de = entry(by.restitution, piece.index);
    const bool has_orders = impact.node.gaps.size() > 1 && !impact.is_together;
    if (order == Order::of_direction && has_orders && !impact.rubbing.empty()) {
      throw ModelError("directional has no impacts with friction on several contacts yet");
    }
    if (order == Order::of_direction && has_orders) {
      push_along(model, tape, tape.impacts[k], de, impact, z, left);
    } else {
      push_impact(de, program.friction, impact, z, left);
    }
    return;
  }
  if (piece.kind == Kind::pass) {
    const Passing& passing = program.passings[k];
    shift(passing.arrival, passing.gap.n, passing.slope, z, left);
    return;
  }
  FlownArc& arc = *program.arcs[k];
  program.dQ = by.qfrc.size() > 0 ? by.qfrc : program.zero;
  if (by.control.size() > 0) program.dQ += arc.arc.Q_u * by.control;
  for (std::size_t i = 0; i < tape.input.wrenches.size(); ++i) {
    const Vec3 force = row_of(by.forces, i), torque = row_of(by.torques, i);
    if (force.isZero(0) && torque.isZero(0)) continue;
    add_push(model, arc.arc.s.w, tape.input.wrenches[i], force, torque, program.dQ);
  }
  const double dtau = duration_of(piece, by.h, left);
  push_flown(model, arc, program.dQ, dtau, program.friction, z);
  left = piece.kind == Kind::rest ? 0 : left - dtau;
}

void push_program(const ModelData& model, const Tape& tape, const StepDirection& by, Order order,
                  StepProgram& program, Tangent& z) {
  if (by.h != 0) check_time(program, "by its duration");
  double left = by.h;
  z.h = by.h;
  if (program.start.q.size() > 0) z.energy = program.start.dot(z);
  for (const StepProgram::Piece& piece : program.pieces) {
    push_piece(model, tape, by, order, piece, program, z, left);
  }
  if (!program.has_rest) return;
  z.q += left * program.motion.q;
  z.p += left * program.motion.p;
}

namespace {

/// Of one impulse. What does not rebound has another motion after it than what does a little.
void add_restitution(const NodeDerivative& node, int contact, double restitution, double of_e,
                     ParameterGradient* to) {
  if (to == nullptr || !(restitution > 0)) return;
  to->restitution.emplace_back(node.pairs[static_cast<std::size_t>(contact)], of_e);
}

/// Back over the instant of a contact.
void pull_instant(const ModelData& model, int contact, const Tangent& flow, double slope,
                  double left, NodeDerivative& node, Tangent& z, ParameterGradient* to) {
  const auto k = static_cast<std::size_t>(contact);
  const double of_gap = shift_back(flow, node.gaps[k].n, slope, z, left);
  if (to != nullptr) add_gap_placements(model, node.kin, node.pairs[k], of_gap, to->placement);
}

/// What the impulse itself has by the model.
void add_impulse_gradient(const ModelData& model, const ImpulseDerivative& impulse,
                          const VecX& p_hat, double of_lambda, NodeDerivative& node,
                          ParameterGradient& to) {
  evaluate_at_compression(model, impulse, node);
  const double factor = of_lambda * (1 + impulse.restitution) / impulse.G;
  add_node_gradient(model, node.w, impulse.w, factor, to);
  add_impulse_placements(model, node, impulse, p_hat, of_lambda, to.placement);
}

double pull_impact(const ModelData& model, double left, ImpactPieces& impact, Tangent& z,
                   Rubbing& friction, ParameterGradient* to) {
  if (impact.is_together) {
    VecX extra, residual;
    pull_kick(impact.kick, VecX(), z, extra, residual, friction);
    if (to != nullptr && residual.size() > 0) {
      add_kick_gradient(model, impact.node.q, impact.kick, residual, z.p, impact.node.w, *to);
    }
    pull_instant(model, impact.first, impact.flow, impact.slope, left, impact.node, z, to);
    return 0;
  }
  double of_e = 0;
  for (auto each = impact.rubbing.rbegin(); each != impact.rubbing.rend(); ++each) {
    const double of_own = pull_friction(model, *each, impact.node, z, friction, to);
    add_restitution(impact.node, each->contact, each->restitution, of_own, to);
    of_e += of_own;
    pull_instant(model, each->contact, each->flow, each->slope, left, impact.node, z, to);
  }
  for (auto each = impact.impulses.rbegin(); each != impact.impulses.rend(); ++each) {
    const GapDerivative& gap = impact.node.gaps[static_cast<std::size_t>(each->contact)];
    const VecX p_hat = z.p;
    const double of_lambda = pull_impulse(gap, *each, z);
    const double of_own = -each->u / each->G * of_lambda;
    add_restitution(impact.node, each->contact, each->restitution, of_own, to);
    of_e += of_own;
    if (to != nullptr) add_impulse_gradient(model, *each, p_hat, of_lambda, impact.node, *to);
    pull_instant(model, each->contact, each->flow, each->slope, left, impact.node, z, to);
  }
  return of_e;
}

}  // namespace

void pull_program(const ModelData& model, const Tape& tape, StepProgram& program, Tangent& z,
                  StepDirection& to, ParameterGradient* parameters) {
  if (parameters != nullptr) parameters->start(model);
  to.control.setZero(model.forces.n_u());
  to.qfrc.setZero(model.tree.n_v);
  to.restitution.setZero(program.n_impacts);
  Rubbing& friction = program.friction;
  friction.value.setZero(static_cast<Eigen::Index>(friction.pairs.size()));
  const std::vector<AppliedWrench>& wrenches = tape.input.wrenches;
  for (MatX* each : {&to.forces, &to.torques}) {
    each->setZero(static_cast<Eigen::Index>(wrenches.size()), 3);
  }
  to.h = 0;
  double left = 0;
  if (program.has_rest) left = program.motion.q.dot(z.q) + program.motion.p.dot(z.p);
  for (auto piece = program.pieces.rbegin(); piece != program.pieces.rend(); ++piece) {
    const auto k = static_cast<std::size_t>(piece->index);
    if (piece->kind == Kind::impact) {
      to.restitution[piece->index] =
          pull_impact(model, left, *program.impacts[k], z, friction, parameters);
      continue;
    }
    if (piece->kind == Kind::pass) {
      const Passing& passing = program.passings[k];
      const double of_gap = shift_back(passing.arrival, passing.gap.n, passing.slope, z, left);
      if (parameters != nullptr) {
        add_gap_placements(model, passing.kin, passing.pair, of_gap, parameters->placement);
      }
      continue;
    }
    FlownArc& arc = *program.arcs[k];
    program.dQ.setZero(model.tree.n_v);
    const double of_tau = pull_flown(model, arc, program.dQ, z, friction, parameters);
    to.qfrc += program.dQ;
    if (to.control.size() > 0) to.control += arc.arc.Q_u.transpose() * program.dQ;
    for (std::size_t i = 0; i < wrenches.size(); ++i) {
      const PulledWrench by = pull_push(model, arc.arc.s.w, wrenches[i], program.dQ);
      to.forces.row(static_cast<Eigen::Index>(i)) += by.force.transpose();
      to.torques.row(static_cast<Eigen::Index>(i)) += by.torque.transpose();
    }
    if (piece->kind == Kind::rest) left = of_tau;
    if (piece->kind == Kind::part) to.h += piece->part * (of_tau - left);
  }
  if (program.start.q.size() > 0) program.start.pull(z.energy, z);
  to.friction = friction.value;
  to.h += left + z.h;
}

}  // namespace saltus
