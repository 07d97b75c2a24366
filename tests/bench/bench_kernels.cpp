// Times of saltus' kernels, without Python's calls: bench_kernels SECONDS FILE...
//
// Arguments and clock are those of clock.hpp.
#include <saltus/lagrangian/packed_matrix.hpp>
#include <saltus/saltus.hpp>

#include <algorithm>
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
constexpr int steps_timed = 200;
constexpr int largest_dense = 700;  // coordinates; above, n x n arrays outgrow the caches and us

/// Everything that the derivatives of L need, allocated once.
struct Partials {
  explicit Partials(const Model& with)
      : model(with), w(model->packed), L_q(VecX::Zero(model.n_v())), L_v(L_q) {}

  void first(const VecX& q, const VecX& v) {
    set_coordinates(model->tree, model->packed, q, w);
    set_rates(model->tree, model->packed, v, w);
    place(model->packed, w);
    move(model->packed, w);
    first_pass(model->packed, w);
    gather(model->tree, model->packed, w.first, 0, L_v);
    gather(model->tree, model->packed, w.first, 1, L_q);
    value = 0.5 * v.dot(L_v) - potential_energy(model->packed, w);
  }
  void generators(const VecX& q, const VecX& v) {
    first(q, v);
    second_pass(model->packed, w);
  }
  void allocate_products() { products = SecondPartials(model->packed); }

  /// All entries of the second partials that are not zero.
  void second(const VecX& q, const VecX& v) {
    generators(q, v);
    multiply_pairs(model->packed, w, products);
  }

  Model model;
  Packed w;
  SecondPartials products;
  VecX L_q, L_v;
  double value = 0;
};

/// One Newton iteration of a step of 1 ms: residual, matrix, factors, solution.
struct Newton {
  explicit Newton(const Model& with) : partials(with), J(with->tree, with->packed) {}
  void iterate(const VecX& q, const VecX& v) {
    partials.generators(q, v);
    factorize(partials.model->tree, partials.model->packed, partials.w, 1e-3, J);
    x = v;
    solve(partials.model->tree, partials.model->packed, J, x);
  }
  Partials partials;
  PackedMatrix J;
  VecX x;
};

struct StepTime {
  Time time;
  double iterations = 0, residual = 0;  ///< a step; the worst
  long allocations = 0;                 ///< of heap memory, in all timed steps together
};

/// Steps of length h [s] from the same start in every pass, contacts off.
StepTime time_of_steps(const Model& model, const State& start, double h) {
  StepOptions options;
  options.h = h;
  options.collisions = false;
  Stepper stepper(model, options);
  StepTime out;
  std::vector<double> seconds;
  for (int pass = 0; pass < passes; ++pass) {
    State state = start;
    for (int i = 0; i < steps_before; ++i) stepper.step(state);
    const long allocated = test::allocations;
    const double begin = cpu_seconds();
    for (int i = 0; i < steps_timed; ++i) {
      stepper.step(state);
      out.iterations += stepper.report().iterations;
      out.residual = std::max(out.residual, stepper.report().residual);
    }
    const double end = cpu_seconds();
    out.allocations += test::allocations - allocated;
    seconds.push_back((end - begin) / steps_timed);
  }
  out.iterations /= passes * steps_timed;
  out.time = bench::summary(seconds);
  return out;
}

/// The long step that trep's published figures are of; chains that are too long do not converge.
void print_long_step(const Model& model, const State& start) {
  try {
    const StepTime step = time_of_steps(model, start, 1e-2);
    std::cout << ", \"step_10ms\": " << step.time << ", \"iterations_10ms\": " << step.iterations;
  } catch (const StepError&) {  // no such number, then
  }
}

/// Inverse and forward dynamics, kinematics included, as Pinocchio's rnea and aba have them.
void print_dynamics(double budget, const Model& model, const VecX& q, const VecX& v) {
  Frames frames(model);
  VecX forces, a;
  std::cout << ", \"inverse_dynamics\": " << time_of(budget, [&] {
    frames.set(q);
    frames.inverse_dynamics(v, v, forces);
  });
  std::cout << ", \"accelerations\": " << time_of(budget, [&] {
    frames.set(q);
    frames.accelerations(v, forces, a);
  });
}

void run(double budget, const bench::Job& job) {
  UrdfOptions options;
  options.effects = JointEffects::none;  // as the peers: bare mechanics
  if (job.floating) options.root_joint = JointType::floating;
  const Model model = load_urdf(job.file, options);
  const int n = model.n_v();
  const VecX q = model.integrate(model.neutral(), VecX::Constant(n, job.angle));
  const VecX v = VecX::Constant(n, 0.1);
  Partials partials(model);
  std::cout << "{\"model\": \"" << model->name << "\", \"n\": " << n;
  std::cout << ", \"first\": " << time_of(budget, [&] { partials.first(q, v); });
  std::cout << ", \"generators\": " << time_of(budget, [&] { partials.generators(q, v); });
  partials.allocate_products();
  std::cout << ", \"partials\": " << time_of(budget, [&] { partials.second(q, v); });
  Newton newton(model);
  std::cout << ", \"newton\": " << time_of(budget, [&] { newton.iterate(q, v); });
  if (n <= largest_dense) {
    std::cout << ", \"lagrangian\": " << time_of(budget, [&] { model.lagrangian(q, v); });
  }
  print_dynamics(budget, model, q, v);
  VecX rates = VecX::Constant(n, job.rate);
  if (job.floating) rates.head(6).setZero();
  const State start = model.state(q, rates);
  print_long_step(model, start);
  const StepTime step = time_of_steps(model, start, 1e-3);
  std::cout << ", \"step\": " << step.time << ", \"iterations\": " << step.iterations
            << ", \"residual\": " << step.residual << ", \"allocations\": " << step.allocations
            << "}" << std::endl;
}

}  // namespace

int main(int argc, char** argv) { return saltus::bench::main(argc, argv, run); }
