#include "saltus/rollout/simulate.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

#include "rollout/run.hpp"

namespace saltus {
namespace {

/// Asks the caller's progress function ten times a second at most.
class Progress {
 public:
  explicit Progress(const std::function<bool(double)>& call) : call_(call) {}
  bool go_on(double done) {
    if (!call_) return true;
    if (++steps_ < stride_ && done < 1) return true;
    const auto now = Clock::now();
    // asking the clock costs a hundredth of a short step: look about once a millisecond
    if (now - looked_ < std::chrono::milliseconds(1)) {
      stride_ = std::min(2 * stride_, 1024);
    } else {
      stride_ = std::max(stride_ / 2, 1);
    }
    looked_ = now;
    steps_ = 0;
    if (now - called_ < std::chrono::milliseconds(100) && done < 1) return true;
    called_ = now;
    return call_(done);
  }

 private:
  using Clock = std::chrono::steady_clock;
  const std::function<bool(double)>& call_;
  Clock::time_point called_ = Clock::now(), looked_ = called_;
  int stride_ = 1, steps_ = 0;  ///< steps between looks at the clock, and since the last
};

}  // namespace

Trajectory simulate(const Model& model, const State& start, double duration,
                    const SimulateOptions& options) {
  Trajectory out = empty_trajectory(model, 0);
  simulate(model, start, duration, options, out);
  return out;
}

Trajectory simulate(const Model& model, const State& start, double duration,
                    const StepOptions& step) {
  return simulate(model, start, duration, SimulateOptions{.step = step});
}

void simulate(const Model& model, const State& start, double duration,
              const SimulateOptions& options, Trajectory& out) {
  Plan plan = make_plan(duration, options);
  Stepper stepper(model, plan.step);
  EnergyMeter meter(*model);
  Progress progress(options.progress);

  model.checked_q(start.q, "state.q");
  check_vector(start.p, model.n_v(), "state.p", "velocities");
  check_memory(model, plan, 1);
  out = empty_trajectory(model, plan.rows);
  out.options = plan.step;
  out.t = row_times(plan, start.t);
  out.q.row(0) = start.q;  // what is known of a start that cannot be measured
  out.p.row(0) = start.p;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  out.v.row(0).setConstant(nan);
  out.kinetic[0] = out.potential[0] = out.shadow[0] = nan;
  const auto go_on = [&](long k) {
    return progress.go_on(static_cast<double>(k) / static_cast<double>(plan.steps));
  };
  RunOutcome outcome;
  const auto keep = [&] {
    if (outcome.rows != plan.rows) truncate(out, outcome.rows);
    take_outcome(std::move(outcome), out);
  };
  try {
    run(model, plan, start, go_on, options.policy, stepper, meter,
        {out.q, out.v, out.p, out.control, out.work, out.kinetic, out.potential, out.shadow},
        outcome);
  } catch (...) {
    keep();
    throw;
  }
  keep();
  if (out.complete) progress.go_on(1);
}

}  // namespace saltus
