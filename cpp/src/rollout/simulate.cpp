#include "saltus/rollout/simulate.hpp"

#include <chrono>
#include <cmath>
#include <sstream>

#include "rollout/recorder.hpp"

namespace saltus {
namespace {

long count_steps(double duration, const SimulateOptions& options) {
  std::ostringstream text;
  if (!(options.h > 0) || !std::isfinite(options.h)) {
    text << "h = " << options.h << " s; it must be positive and finite";
  } else if (!(duration > 0) || !std::isfinite(duration)) {
    text << "duration = " << duration << " s; it must be positive and finite";
  } else if (options.record_every < 1) {
    text << "record_every = " << options.record_every << "; it must be at least 1";
  }
  if (!text.str().empty()) throw ModelError(text.str());
  const double steps = std::round(duration / options.h);
  if (std::abs(steps * options.h - duration) > 1e-9 * duration) {
    text << "duration = " << duration << " s is no whole number of steps of h = " << options.h
         << " s; the nearest is " << steps * options.h << " s";
    throw ModelError(text.str());
  }
  if (steps > 1e12) {
    text << "duration / h = " << steps << " steps are more than 1e12";
    throw ModelError(text.str());
  }
  return static_cast<long>(steps);
}

/// Asks the caller's progress function ten times a second at most.
class Progress {
 public:
  explicit Progress(const std::function<bool(double)>& call) : call_(call) {}
  bool go_on(double done) {
    if (!call_) return true;
    const auto now = Clock::now();
    if (now - last_ < std::chrono::milliseconds(100) && done < 1) return true;
    last_ = now;
    return call_(done);
  }

 private:
  using Clock = std::chrono::steady_clock;
  const std::function<bool(double)>& call_;
  Clock::time_point last_ = Clock::now();
};

/// Rows for the start, every n-th step and the last.
Trajectory allocate(const Model& model, long steps, int record_every) {
  // Asking the machine for more may well succeed and end in the kernel's killing the program.
  constexpr double most_gigabytes = 16;
  const long rows = (steps + record_every - 1) / record_every + 1;
  const double gigabytes = static_cast<double>(rows) * (4 + 3 * model.n_q()) * 8e-9;
  if (gigabytes <= most_gigabytes) return empty_trajectory(model, rows);
  std::ostringstream text;
  text << rows << " rows of " << model.n_q() << " coordinates are " << gigabytes
       << " GB, more than " << most_gigabytes << "; record fewer with record_every, now "
       << record_every;
  throw ModelError(text.str());
}

void add_report(const StepReport& report, Trajectory& run) {
  const int shift = static_cast<int>(run.impulses.size());
  for (Impact impact : report.impacts) {
    impact.first += shift;
    run.impacts.push_back(impact);
  }
  run.impulses.insert(run.impulses.end(), report.impulses.begin(), report.impulses.end());
  run.iterations += report.iterations;
  run.residual = std::max(run.residual, report.residual);
}

}  // namespace

Trajectory simulate(const Model& model, const State& start, double duration,
                    const SimulateOptions& options) {
  const long steps = count_steps(duration, options);
  StepOptions step_options = options.step;
  step_options.h = options.h;
  step_options.law = options.law;
  step_options.collisions = options.collisions;
  Stepper stepper(model, step_options);
  EnergyMeter meter(*model);
  Progress progress(options.progress);

  check_vector(start.q, model.n_q(), "state.q");
  check_vector(start.p, model.n_q(), "state.p");
  Trajectory run = allocate(model, steps, options.record_every);
  run.options = step_options;
  State state = start;
  measure(*model, state, options.h, meter);
  record(state, state.t, meter, 0, run);
  Eigen::Index rows = 1;
  long k = 0;
  for (; k < steps && progress.go_on(static_cast<double>(k) / static_cast<double>(steps)); ++k) {
    stepper.step(state);
    add_report(stepper.report(), run);
    if ((k + 1) % options.record_every != 0 && k + 1 != steps) continue;
    measure(*model, state, options.h, meter);
    // t0 + k h, not the sum of k times h, so that rows fall on round times
    record(state, start.t + static_cast<double>(k + 1) * options.h, meter, rows++, run);
  }
  run.complete = k == steps;
  if (rows != run.t.size()) truncate(run, rows);
  if (run.complete) progress.go_on(1);
  return run;
}

}  // namespace saltus
