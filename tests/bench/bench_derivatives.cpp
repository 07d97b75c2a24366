// What derivatives of a step cost: bench_derivatives SECONDS FILE...
//
// Arguments and clock are those of clock.hpp. Of a model with shapes whose first ball is lifted the
// step is the first with an impact; of others one of a calm motion.
#include <saltus/saltus.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

#include "../cpp/count_allocations.hpp"
#include "clock.hpp"

namespace {

using namespace saltus;
using bench::cpu_seconds;
using bench::passes;
using bench::Time;
using bench::time_of;

constexpr int steps_before = 10;  // the first guess needs four arcs of history

/// A step that is made again and again, each time after the same steps before it.
struct Again {
  Again(const Model& model, const StepOptions& options, std::vector<State> with, bool record)
      : stepper(model, options), states(std::move(with)) {
    stepper.record(record);
  }
  /// @return [us] of the last step
  double run() {
    State state = states.front();
    double begin = 0;
    for (std::size_t k = 0; k < states.size(); ++k) {
      begin = cpu_seconds();
      stepper.step(state);
    }
    return 1e6 * (cpu_seconds() - begin);
  }
  Stepper stepper;
  std::vector<State> states;
};

double least_clock_reading() {
  double least = HUGE_VAL;
  for (int i = 0; i < 1000; ++i) {
    const double begin = cpu_seconds();
    least = std::min(least, cpu_seconds() - begin);
  }
  return 1e6 * least;
}

/// [us] The least and the median of the last step.
Time time_of_step(double budget, Again& again) {
  std::vector<double> us;
  const double end = cpu_seconds() + budget;
  while (us.size() < passes || cpu_seconds() < end) us.push_back(again.run());
  std::sort(us.begin(), us.end());
  const double clock = least_clock_reading();
  return {us.front() - clock, us[us.size() / 2] - clock};
}

/// The starts of the steps that lead to the one that is differentiated, and its own.
std::vector<State> states_to(const Model& model, const StepOptions& options, State state,
                             bool to_impact) {
  Stepper stepper(model, options);
  std::vector<State> states;
  do {
    states.push_back(state);
    stepper.step(state);
  } while (to_impact ? stepper.report().impacts.empty()
                     : static_cast<int>(states.size()) <= steps_before);
  const auto kept = std::min<std::size_t>(states.size(), steps_before + 1);
  return {states.end() - static_cast<std::ptrdiff_t>(kept), states.end()};
}

void run(double budget, const bench::Job& job) {
  UrdfOptions urdf;
  urdf.effects = JointEffects::none;  // as the peers: bare mechanics
  if (job.floating) urdf.root_joint = JointType::floating;
  const Model model = load_urdf(job.file, urdf);
  const int n = model.n_v();
  const bool has_pairs = !model->pairs.empty();
  StepOptions options;
  options.h = has_pairs ? 1e-2 : 1e-3;
  options.collisions = has_pairs;
  VecX rates = VecX::Constant(n, job.rate);
  if (job.floating) rates.head(6).setZero();
  const State start =
      has_pairs
          ? model.state({{"swing_0", job.angle}})
          : model.state(model.integrate(model.neutral(), VecX::Constant(n, job.angle)), rates);
  const auto states = states_to(model, options, start, has_pairs);
  Again plain(model, options, states, false), recorded(model, options, states, true);
  std::cout << "{\"model\": \"" << model->name << "\", \"n\": " << n
            << ", \"step\": " << time_of_step(budget, plain)
            << ", \"recorded\": " << time_of_step(budget, recorded);
  recorded.run();
  const Tape& tape = *recorded.stepper.tape();
  StepDerivatives all(model, options);
  StateDirection hat{VecX::Ones(n), VecX::Ones(n)}, end;
  StepDirection along, back;
  along.q = along.p = VecX::Ones(n);
  ModelGradient by_model;
  MatX A, B;
  const auto print = [&](const char* name, const std::function<void()>& work) {
    work();
    const long allocated = test::allocations;
    work();
    const long count = test::allocations - allocated;
    std::cout << ", \"" << name << "\": " << time_of(budget, work) << ", \"" << name
              << "_allocations\": " << count;
  };
  print("linearize", [&] { all.linearize(tape); });
  print("jvp", [&] { end = all.jvp(along); });
  print("vjp", [&] { back = all.vjp(hat); });
  print("vjp_model", [&] { back = all.vjp(hat, by_model); });
  print("dense", [&] {
    all.linearize(tape);
    all.derivative(A, B);
  });
  std::cout << "}" << std::endl;
}

}  // namespace

int main(int argc, char** argv) { return saltus::bench::main(argc, argv, run); }
