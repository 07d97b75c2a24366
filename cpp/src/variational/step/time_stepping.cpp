// A step at any price: arcs by time stepping where no others are found.
#include <algorithm>
#include <utility>

#include "variational/step/contact_report.hpp"
#include "variational/step/stepper_impl.hpp"

namespace saltus {
namespace {

/// Arcs of time stepping in a step that others are tried beside.
constexpr int most_stepped = 4;

}  // namespace

// As step_once, and where an arc or its impact fails, one of time stepping in its place. After a
// few of these nothing else is tried in the step.
void Stepper::Impl::step_at_any_price(State& state, bool is_own) {
  clear(report);
  start(state, is_own);
  start_tape(state);
  refuse("an arc by time stepping (StepReport.fallbacks tells of it)");
  set_shift();
  const double t_start = state.t, h = scene.options.h, H = node_energy(scene, node);
  int stepped = 0;
  for (double left = h; left > 0;) {
    const StepReport told = report;
    const State at{node.t, node.q, node.p};
    const double tau = std::min(left, longest);
    blames_contact = false;
    try {
      const bool is_spent = report.iterations > most_work() || pile_work() > most_pile_work;
      if (stepped > most_stepped || is_spent) fail_work();
      const Launch* launch = has_approach(node) ? collide() : nullptr;
      fly_one_arc(tau, launch);
      const double rest = flight.work.arc.tau < left ? left - flight.work.arc.tau : 0;
      end_arc(t_start + (h - rest));
      left = rest;
    } catch (const StepError&) {
      if (!blames_contact) throw;
      const int spent = report.iterations;  // counts towards the bound, whatever it was good for
      report = told;
      report.iterations = spent;
      place_node(scene, at.t, at.q, at.p, node);
      if (!set_velocity_at_node(scene, node) || !find_contacts(scene, node)) throw;
      left = tau < left ? left - tau : 0;
      fly_unlocated(tau, t_start + (h - left));
      ++stepped;
    }
  }
  check_step_energy(H);
  end_step(nullptr);  // an approach at the end is the next step's
  state = last;
}

void Stepper::Impl::fly_unlocated(double tau, double t) {
  const double start = node.t, lowest = lowest_gap(node);
  const Rung rung = step_unlocated(scene, tau, t, node, end, flight.work.scratch, unlocated);
  ++report.arcs;
  tell(unlocated.impulses, report);
  report.friction_residual = std::max(report.friction_residual, unlocated.residual);
  if (unlocated.v_middle.size() > 0) {
    add_work(tau, unlocated.v_middle, unlocated.forces, unlocated.wrench_force);
  }
  report.fallbacks.push_back({start, tau, rung, unlocated.energy, unlocated.pair});
  energy = node_energy(scene, node);  // what lifts comes out of it
  lift_out();
  check_closed(lowest);
  saltus::forget(memory);
  middle.is_known = false;
}

}  // namespace saltus
