// A fixed amount of work for an instruction counter: bench_instructions WORKLOAD FILE prints how
// many calls it made. WORKLOAD is step, driven, impact, rest, fall or lagrangian; FILE is as in
// clock.hpp.
//
// Only what runs inside `saltus_bench_counted` is meant to be counted (callgrind:
// --toggle-collect=saltus_bench_counted).
#include <saltus/saltus.hpp>

#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include "clock.hpp"

namespace {
const std::function<void()>* counted_work;
}

// With C linkage and never inlined, so that its name is one that a tool can be told.
extern "C" [[gnu::noinline]] void saltus_bench_counted() { (*counted_work)(); }

namespace {

using namespace saltus;

constexpr int calls = 50;
constexpr int steps_before = 10;  // the first guess needs four arcs of history

void count(const std::function<void()>& work) {
  counted_work = &work;
  saltus_bench_counted();
}

void count_steps(const Model& model, double h, int before, State state) {
  Stepper stepper(model, {.h = h});
  for (int i = 0; i < before; ++i) stepper.step(state);
  for (int i = 0; i < calls; ++i) count([&] { stepper.step(state); });
}

/// Steps of what rests and has not for long: after a few more it stands still, and steps are not
/// made again.
void count_resting_steps(const Model& model, const State& start) {
  constexpr int before = 3, counted = 5;
  static_assert(calls % counted == 0);
  Stepper stepper(model, {.h = 1e-2});
  for (int i = 0; i < calls / counted; ++i) {
    State state = start;
    for (int k = 0; k < before; ++k) stepper.step(state);
    for (int k = 0; k < counted; ++k) count([&] { stepper.step(state); });
  }
}

/// The first step with an impact, again and again, each time after the same steps before it.
void count_steps_with_an_impact(const Model& model, State state) {
  Stepper stepper(model, {.h = 1e-2});
  std::vector<State> states;
  while (stepper.report().impacts.empty()) {
    states.push_back(state);
    stepper.step(state);
  }
  for (int i = 0; i < calls; ++i) {
    State again = states.at(states.size() - 1 - steps_before);
    for (int k = 0; k < steps_before; ++k) stepper.step(again);
    count([&] { stepper.step(again); });
  }
}

/// Damping and a servo on each joint of one coordinate.
Model with_servos(ModelBuilder builder) {
  const std::vector<JointSpec> joints = builder.description().joints;
  for (const JointSpec& joint : joints) {
    if (joint.type != JointType::revolute && joint.type != JointType::continuous) continue;
    builder.set_effects(joint.name, JointEffects::damping | JointEffects::motors);
    builder.set_damping(joint.name, 0.1);
    builder.add_position_servo(joint.name, joint.name, 10, 1);
  }
  return builder.build();
}

void run(const std::string& workload, const bench::Job& job) {
  UrdfOptions options;
  options.effects = JointEffects::none;  // as the peers: bare mechanics
  if (job.floating) options.root_joint = JointType::floating;
  const bool is_driven = workload == "driven";
  const Model model =
      is_driven ? with_servos(read_urdf(job.file, options)) : load_urdf(job.file, options);
  const int n = model.n_v();
  const VecX q = model.integrate(model.neutral(), VecX::Constant(n, job.angle));
  const VecX v = VecX::Constant(n, 0.1);
  if (workload == "step" || is_driven) {
    count_steps(model, 1e-3, steps_before, model.state(q, VecX::Zero(n)));
  } else if (workload == "rest") {
    count_resting_steps(model, model.state(q, VecX::Zero(n)));
  } else if (workload == "fall") {
    count_steps(model, 1e-2, 0, model.state(q, VecX::Zero(n)));
  } else if (workload == "impact") {
    count_steps_with_an_impact(model, model.state({{"swing_0", job.angle}}));
  } else if (workload == "lagrangian") {
    for (int i = 0; i < calls; ++i) count([&] { model.lagrangian(q, v); });
  } else {
    throw ModelError("no workload \"" + workload +
                     "\"; workloads are step, driven, impact, rest, fall, lagrangian");
  }
  std::cout << calls << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << argv[0] << " WORKLOAD [floating:]FILE[@ANGLE]\n";
    return 2;
  }
  try {
    run(argv[1], saltus::bench::job(argv[2]));
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
