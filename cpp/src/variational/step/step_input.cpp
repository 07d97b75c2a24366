// What drives a step, and the work that it does.
#include "variational/step/step_input.hpp"

#include <cmath>
#include <sstream>

#include "saltus/force/most_number.hpp"
#include "saltus/model/stiff_damping.hpp"
#include "variational/arc/arc_forces.hpp"
#include "variational/step/stepper_impl.hpp"

namespace saltus {

// The gradient of kappa is there for one-degree joints alone.
void check_law(const ModelData& model, ImpactLaw law) {
  if (law == ImpactLaw::custom && model.equalities.rows > 0) {
    throw ModelError("a law of your own is not for models with loops, as \"" +
                         model.equalities.all.front().name + "\" is; nodal_energy is",
                     "loop", model.equalities.all.front().name);
  }
  if (law != ImpactLaw::compensated) return;
  for (const PotentialFunction& each : model.mass.potentials.functions) {
    throw ModelError("law compensated needs third derivatives, which potential \"" + each.name +
                         "\" does not give; shadow_energy and discrete_energy do without",
                     "potential", each.name);
  }
  if (model.tree.balls.empty()) return;
  for (const JointInfo& joint : model.joints) {
    if (joint.type != JointType::floating && joint.type != JointType::spherical) continue;
    throw ModelError("law compensated is not for floating and spherical joints, as \"" +
                         joint.name + "\" is; shadow_energy and discrete_energy are",
                     "joint", joint.name);
  }
}

namespace {

/// What is too large for arithmetic is told before it is a residual that is no number.
void check_size(const VecRef& x, const char* what) {
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    if (std::abs(x[k]) <= most_number) continue;
    std::ostringstream text;
    text << what << "[" << k << "] = " << x[k] << "; it is at most " << most_number
         << ", beyond which arithmetic ends";
    throw ModelError(text.str());
  }
}

}  // namespace

void check_input(const Model& model, const ForceInput& input) {
  const int n_u = model->forces.n_u();
  if (input.control.size() > 0) check_vector(input.control, n_u, "control", "actuators");
  if (input.qfrc.size() > 0) check_vector(input.qfrc, model.n_v(), "qfrc", "velocities");
  check_size(input.control, "control");
  check_size(input.qfrc, "qfrc");
  for (const AppliedWrench& wrench : input.wrenches) {
    if (wrench.joint < 0 || wrench.joint >= model->tree.joints()) {
      throw ModelError("a wrench acts on a body that is fixed to the world");
    }
    const bool is_finite =
        wrench.point_J.allFinite() && wrench.force.allFinite() && wrench.torque.allFinite();
    if (!is_finite) throw ModelError("a wrench has a number that is not finite");
    check_size(wrench.force, "force of a wrench");
    check_size(wrench.torque, "torque of a wrench");
  }
}

namespace {

bool are_same(const VecX& a, const VecX& b) { return a.size() == b.size() && a == b; }

}  // namespace

void Stepper::Impl::take(const ForceInput& with) {
  check_input(scene.shared, with);
  const bool has_forces = scene.model.forces.acts() || with.acts();
  if (has_forces && scene.options.law == ImpactLaw::compensated && !scene.model.forces.acts()) {
    throw ModelError("law compensated takes no applied forces; nodal_energy does");
  }
  input_is_same = with.wrenches.empty() && input.wrenches.empty() &&
                  are_same(input.control, with.control) && are_same(input.qfrc, with.qfrc);
  input = with;
  if (recorded) recorded->is_whole = false;
  ArcScratch& arc = flight.work.scratch;
  arc.input = &input;
  arc.has_forces = has_forces;
}

// Of the arc just flown, whose middle was evaluated last.
void Stepper::Impl::add_work() {
  done = done_size = 0;
  const ArcScratch& s = flight.work.scratch;
  const Arc& arc = flight.work.arc;
  if (s.has_forces) add_work(arc.tau, arc.v, s.forces, s.wrench_force);
}

void Stepper::Impl::add_work(double tau, const VecX& v, const ForceValues& forces,
                             const VecX& wrench_force) {
  const auto n = forces.effort.size();
  const auto add = [&](Eigen::Index source, double power) {
    const double each = tau * power;
    report.work[source] += each;
    done += each;
    done_size += std::abs(each);
  };
  for (Eigen::Index k = 0; k < n; ++k) add(k, forces.effort[k] * forces.rate[k]);
  const ForceModel& own = scene.model.forces;
  if (own.damping.size() > 0 || !own.dampers.empty()) add(n, forces.damping.dot(v));
  double applied = wrench_force.dot(v);
  if (input.qfrc.size() > 0) applied += input.qfrc.dot(v);
  for (std::size_t k = 0; k < forces.answers.size(); ++k) {
    const std::vector<int>& pushed = own.functions[k].velocities;
    for (std::size_t i = 0; i < pushed.size(); ++i) {
      applied += forces.answers[k].Q[static_cast<Eigen::Index>(i)] * v[pushed[i]];
    }
  }
  add(n + 2, applied);
}

// Of the kick that opened the arc: half the impulse times the rates before and after it.
void Stepper::Impl::add_dry_work() {
  if (node.dry.empty() || !node.has_factors) return;
  ArcWork& arc = flight.work;
  VecX& after = arc.scratch.x;
  after = arc.rows.momentum;
  solve(scene.model.tree, scene.model.packed, node.M, after);
  if (node.loops.some) node.loops.solver.meet(node.loops.values.drive, after);
  for (const int i : arc.rows.active) {
    const Row& row = arc.rows.row[i];
    if (!row.is_joint()) continue;
    const ContactVector& n = contact_of(node, row).n;
    const double rates = dot(scene.trees, n, node.v) + dot(scene.trees, n, after);
    report.work[scene.model.forces.n_u() + 1] += row.p[0] * rates / 2;
  }
}

// What moves joints as they are told does work at the node, where it pushes.
void Stepper::Impl::add_loop_work(const VecX& impulse) {
  const double work = impulse.dot(node.loops.values.drive);
  report.work[scene.model.forces.n_u() + 2] += work;
  done += work;
  done_size += std::abs(work);
}

std::vector<int> perhaps_stiff(const Scene& scene) {
  std::vector<int> out;
  if (scene.model.forces.damping.size() == 0) return out;
  const VecX z = damping_ratios(scene.shared, scene.options.h, scene.shared.neutral());
  for (int c = 0; c < z.size(); ++c) {
    if (z[c] > most_damping / 4) out.push_back(c);
  }
  return out;
}

// By the inertia at the start of the step.
void Stepper::Impl::set_shift() {
  if (damped.empty()) return;
  if (!scene.model.has_gaps()) place_frames(scene, node);
  if (!node.has_factors && !set_velocity_at_node(scene, node)) fail(FlightOutcome::not_converged);
  VecX& x = flight.work.scratch.x;
  for (const int c : damped) {
    x.setZero();
    x[c] = 1;
    solve(scene.model.tree, scene.model.packed, node.M, x);
    if (node.loops.some) node.loops.solver.hold(x);
    const double z = scene.options.h * scene.model.forces.damping[c] * x[c];
    flight.work.scratch.shift[c] = damping_shift(z);
  }
}

// The arc's work is tau F.v - tau^2/2 F.M^-1 (2 beta - 1) Q, F all of the second half kick: of the
// two kicks by the rates that they find.
void Stepper::Impl::add_shift_work() {
  ArcScratch& s = flight.work.scratch;
  if (damped.empty() || s.shift.isZero(0)) return;
  if (!node.has_factors && !set_velocity_at_node(scene, node)) return;
  s.x = shifted_damping(scene.model, flight.work.arc.v, s);
  solve(scene.model.tree, scene.model.packed, node.M, s.x);
  const double tau = flight.work.arc.tau, work = -tau * tau / 2 * s.L_q.dot(s.x);
  report.work[scene.model.forces.n_u()] += work;
  done += work;
  done_size += std::abs(work);
}

}  // namespace saltus
