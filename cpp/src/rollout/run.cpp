#include "rollout/run.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "variational/step/step_input.hpp"
#include "variational/terms/check_options.hpp"

namespace saltus {
namespace {

/// Asking the machine for more may well succeed and end in the kernel's killing the program.
constexpr double most_gigabytes = 16;

void check_numbers(double duration, const SimulateOptions& options) {
  check_options(options.step);
  std::ostringstream text;
  if (!(duration > 0) || !std::isfinite(duration)) {
    text << "duration = " << duration << " s; it must be positive and finite";
  } else if (options.record_every < 1) {
    text << "record_every = " << options.record_every << "; it must be at least 1";
  } else if (options.control_every < 1) {
    text << "control_every = " << options.control_every << "; it must be at least 1";
  }
  if (!text.str().empty()) throw ModelError(text.str());
}

long count_steps(double duration, double h) {
  std::ostringstream text;
  const double steps = std::round(duration / h);
  if (std::abs(steps * h - duration) > 1e-9 * duration) {
    text << "duration = " << duration << " s is no whole number of steps of h = " << h
         << " s; the nearest is " << steps * h << " s";
    throw ModelError(text.str());
  }
  if (steps > 1e12) {
    text << "duration / h = " << steps << " steps are more than 1e12";
    throw ModelError(text.str());
  }
  return static_cast<long>(steps);
}

void add_report(const StepReport& report, RunOutcome& outcome) {
  const int shift = static_cast<int>(outcome.impulses.size());
  for (Impact impact : report.impacts) {
    impact.first += shift;
    outcome.impacts.push_back(impact);
  }
  outcome.impulses.insert(outcome.impulses.end(), report.impulses.begin(), report.impulses.end());
  outcome.settlings.insert(outcome.settlings.end(), report.settlings.begin(),
                           report.settlings.end());
  outcome.fallbacks.insert(outcome.fallbacks.end(), report.fallbacks.begin(),
                           report.fallbacks.end());
  outcome.certificates.insert(outcome.certificates.end(), report.certificates.begin(),
                              report.certificates.end());
  outcome.iterations += report.iterations;
  outcome.residual = std::max(outcome.residual, report.residual);
}

/// Of a step that ends at t. Needs the outcome of the steps before it.
void add_contacts(const StepReport& report, double t, const Plan& plan, RunOutcome& outcome) {
  std::vector<RecordedContact>& all = *outcome.contacts;
  int index = static_cast<int>(outcome.impacts.size());
  for (const Impact& impact : report.impacts) {
    for (int i = impact.first; i < impact.first + impact.count; ++i) {
      all.push_back({outcome.rows, impact.t, index, report.impulses[i]});
    }
    ++index;
  }
  for (const ContactImpulse& each : report.contacts) all.push_back({outcome.rows, t, -1, each});
  if (static_cast<double>(all.size()) <= plan.most_contacts) return;
  std::ostringstream text;
  text << all.size() << " recorded contacts by t = " << t << " s are more than the "
       << static_cast<std::size_t>(plan.most_contacts) << " that a run has room for in "
       << most_gigabytes << " GB; make runs shorter, or record no contacts (record_contacts)";
  throw ModelError(text.str());
}

}  // namespace

Plan make_plan(double duration, const SimulateOptions& options) {
  check_numbers(duration, options);
  Plan plan;
  plan.step = options.step;
  plan.steps = count_steps(duration, options.step.h);
  plan.record_every = options.record_every;
  plan.record_contacts = options.record_contacts;
  plan.control_every = options.control_every;
  plan.rows = (plan.steps + options.record_every - 1) / options.record_every + 1;
  return plan;
}

void check_memory(const Model& model, Plan& plan, Eigen::Index runs) {
  const double doubles = static_cast<double>(runs) * static_cast<double>(plan.rows);
  const double gigabytes =
      doubles * (4 + model.n_q() + 2 * model.n_v() + 2 * model->forces.n_u() + 3) * 8e-9;
  const double bytes = static_cast<double>(runs) * sizeof(RecordedContact);  // one contact a run
  plan.most_contacts = (most_gigabytes - gigabytes) * 1e9 / bytes;
  if (gigabytes <= most_gigabytes) return;
  std::ostringstream text;
  if (runs > 1) text << runs << " runs of ";
  text << plan.rows << " rows of " << model.n_q() << " coordinates are " << gigabytes
       << " GB, more than " << most_gigabytes << "; record fewer with record_every, now "
       << plan.record_every;
  throw ModelError(text.str());
}

VecX row_times(const Plan& plan, double t0) {
  VecX t(plan.rows);
  for (Eigen::Index row = 0; row < plan.rows; ++row) {
    const long k = std::min<long>(row * plan.record_every, plan.steps);
    t[row] = t0 + static_cast<double>(k) * plan.step.h;
  }
  return t;
}

namespace {

/// Controls of a run, and the work done in it.
struct Driven {
  ForceInput input;
  VecX work;  ///< (n_u + 3) [J] until now

  void record(Eigen::Index row, RunRows& rows) const {
    rows.work.row(row) = work;
    record_control(row, rows);
  }

  void record_control(Eigen::Index row, RunRows& rows) const {
    if (input.control.size() > 0) rows.control.row(row) = input.control;
    if (input.control.size() == 0) rows.control.row(row).setZero();
  }
};

}  // namespace

void run(const Model& model, const Plan& plan, const State& start, const GoOn& go_on,
         const Policy& policy, Stepper& stepper, EnergyMeter& meter, RunRows rows,
         RunOutcome& outcome) {
  stepper.forget();
  Driven driven{{}, VecX::Zero(model->forces.n_u() + 3)};
  if (plan.record_contacts) outcome.contacts.emplace();
  State state = start;
  state.q = model.checked_q(start.q, "state.q");
  measure(*model, state, plan.step.h, meter);
  record(state, meter, 0, rows);
  driven.record(0, rows);
  StepReport nothing;  // of no step: with all that a report has room for
  nothing.work.setZero(model->forces.n_u() + 3);
  nothing.loops.setZero(model->equalities.rows);
  bool is_measured = true;
  long k = 0;
  for (; k < plan.steps && go_on(k); ++k) {
    if (policy && k % plan.control_every == 0) {
      if (!is_measured) measure(*model, state, plan.step.h, meter);
      policy({k, state, meter.v, k == 0 ? nothing : stepper.report()}, driven.input);
      check_input(model, driven.input);  // before it is recorded
    }
    if (is_measured) driven.record_control(outcome.rows - 1, rows);
    stepper.step(state, driven.input);
    driven.work += stepper.report().work;
    if (plan.record_contacts) {
      const double t = start.t + static_cast<double>(k + 1) * plan.step.h;
      add_contacts(stepper.report(), t, plan, outcome);
    }
    add_report(stepper.report(), outcome);
    is_measured = (k + 1) % plan.record_every == 0 || k + 1 == plan.steps;
    if (!is_measured) continue;
    measure(*model, state, plan.step.h, meter);
    record(state, meter, outcome.rows++, rows);
    driven.record(outcome.rows - 1, rows);
  }
  outcome.complete = k == plan.steps;
}

}  // namespace saltus
