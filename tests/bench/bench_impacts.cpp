// What impacts cost: bench_impacts SECONDS CRADLE@LIFT... steps each cradle, its first ball lifted
// by LIFT [rad], through 5 s, and times every step by itself.
//
// A step's time is the least of all passes, which are equal to the bit; the medians of the steps
// with and without impacts are printed, less what reading the clock costs.
#include <saltus/saltus.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

#include "clock.hpp"

namespace {

using namespace saltus;
using bench::cpu_seconds;
using bench::passes;

constexpr double duration = 5;  // [s] of motion: five swings

struct Steps {
  std::vector<double> seconds;  ///< a step, the least of all passes
  std::vector<int> impacts;     ///< a step
  int impulses = 0, arcs = 0, contacts = 0;
};

Steps time_steps(const Model& model, const State& start, double h) {
  StepOptions options;
  options.h = h;
  const int count = static_cast<int>(std::lround(duration / h));
  Steps out;
  out.seconds.assign(count, HUGE_VAL);
  out.impacts.assign(count, 0);
  for (int pass = 0; pass < passes; ++pass) {
    Stepper stepper(model, options);
    State state = start;
    out.impulses = out.arcs = out.contacts = 0;
    for (int i = 0; i < count; ++i) {
      const double begin = cpu_seconds();
      stepper.step(state);
      out.seconds[i] = std::min(out.seconds[i], cpu_seconds() - begin);
      const StepReport& report = stepper.report();
      out.impacts[i] = static_cast<int>(report.impacts.size());
      if (report.impacts.empty()) continue;
      out.impulses += static_cast<int>(report.impulses.size());
      out.arcs += report.arcs;
      for (const Impact& impact : report.impacts) {
        out.contacts = std::max(out.contacts, impact.contacts);
      }
    }
  }
  return out;
}

double least_clock_reading() {
  double least = HUGE_VAL;
  for (int i = 0; i < 1000; ++i) {
    const double begin = cpu_seconds();
    least = std::min(least, cpu_seconds() - begin);
  }
  return least;
}

/// [us], of the steps with impacts or of those without.
double median(const Steps& steps, bool with_impacts, double clock) {
  std::vector<double> chosen;
  for (std::size_t i = 0; i < steps.seconds.size(); ++i) {
    if ((steps.impacts[i] > 0) == with_impacts) chosen.push_back(steps.seconds[i] - clock);
  }
  return chosen.empty() ? 0 : bench::summary(chosen).median;
}

void run(double /*budget*/, const bench::Job& job) {
  const Model model = load_urdf(job.file);
  const State start = model.state({{"swing_0", job.angle}});
  const double clock = least_clock_reading();
  for (const double h : {1e-3, 1e-2}) {
    const Steps steps = time_steps(model, start, h);
    int impacts = 0, hit = 0;
    for (const int count : steps.impacts) {
      impacts += count;
      hit += count > 0;
    }
    std::cout << "{\"model\": \"" << model->name << "\", \"n\": " << model.n_q() << ", \"h\": " << h
              << ", \"smooth\": " << median(steps, false, clock)
              << ", \"impact\": " << median(steps, true, clock) << ", \"steps\": " << hit
              << ", \"impacts\": " << impacts << ", \"contacts\": " << steps.contacts
              << ", \"impulses\": " << steps.impulses << ", \"arcs\": " << steps.arcs << "}"
              << std::endl;
  }
}

}  // namespace

int main(int argc, char** argv) { return saltus::bench::main(argc, argv, run); }
