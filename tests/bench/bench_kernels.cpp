// Times of saltus' kernels, without Python's calls: bench_kernels SECONDS FILE...
//
// Arguments and clock are those of clock.hpp.
#include <saltus/lagrangian/composite.hpp>
#include <saltus/lagrangian/energy.hpp>
#include <saltus/saltus.hpp>

#include <algorithm>
#include <iostream>
#include <vector>

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
      : model(with),
        kin(model->tree),
        comp(model->tree),
        L_q(VecX::Zero(model.n_q())),
        L_v(L_q),
        M(MatX::Zero(0, 0)) {}

  void first(const VecX& q, const VecX& v) {
    set_configuration(model->tree, q, kin);
    set_velocity(model->tree, v, kin);
    first_pass(model->tree, model->mass, kin, comp);
    to_coordinates(model->tree, comp.L_q, L_q);
    to_coordinates(model->tree, comp.L_v, L_v);
    value = 0.5 * v.dot(L_v) - potential_energy(model->tree, model->mass, kin);
  }
  void generators(const VecX& q, const VecX& v) {
    first(q, v);
    second_pass(model->tree, model->mass, kin, comp);
  }
  void allocate_dense() { M = L_vq = L_qq = MatX::Zero(model.n_q(), model.n_q()); }

  /// The products of the generators: all entries of the second partials that are not zero.
  void dense(const VecX& q, const VecX& v) {
    generators(q, v);
    const Tree& tree = model->tree;
    for (int j = 0; j < tree.joints(); ++j) {
      const JointComposite& c = comp.joint[j];
      for (int i = j; i >= 0; i = tree.parent[i]) {
        const JointMotion& m = kin.joint[i];
        M(j, i) = m.S.dot(c.U);
        L_qq(j, i) = m.W.dot(c.F) + angular(m.S).dot(c.G);
        L_vq(j, i) = m.W.dot(c.U);
        L_vq(i, j) = m.S.dot(c.F);
      }
    }
  }

  Model model;
  Kinematics kin;
  Composite comp;
  VecX L_q, L_v;
  MatX M, L_vq, L_qq;  // lower triangles of M and L_qq
  double value = 0;
};

struct StepTime {
  Time time;
  double iterations = 0, residual = 0;  ///< a step; the worst
};

/// Steps of 1 ms from the same start in every pass, contacts off.
StepTime time_of_steps(const Model& model, const State& start) {
  StepOptions options;
  options.h = 1e-3;
  options.collisions = false;
  Stepper stepper(model, options);
  StepTime out;
  std::vector<double> seconds;
  for (int pass = 0; pass < passes; ++pass) {
    State state = start;
    for (int i = 0; i < steps_before; ++i) stepper.step(state);
    const double begin = cpu_seconds();
    for (int i = 0; i < steps_timed; ++i) {
      stepper.step(state);
      out.iterations += stepper.report().iterations;
      out.residual = std::max(out.residual, stepper.report().residual);
    }
    seconds.push_back((cpu_seconds() - begin) / steps_timed);
  }
  out.iterations /= passes * steps_timed;
  out.time = bench::summary(seconds);
  return out;
}

void run(double budget, const bench::Job& job) {
  UrdfOptions options;
  if (job.floating) options.root_joint = JointType::floating;
  const Model model = load_urdf(job.file, options).build();
  const int n = model.n_q();
  const VecX q = VecX::Constant(n, job.angle), v = VecX::Constant(n, 0.1);
  Partials partials(model);
  std::cout << "{\"model\": \"" << model->name << "\", \"n\": " << n;
  std::cout << ", \"first\": " << time_of(budget, [&] { partials.first(q, v); });
  std::cout << ", \"generators\": " << time_of(budget, [&] { partials.generators(q, v); });
  if (model->tree.one_to_one) {
    partials.allocate_dense();
    std::cout << ", \"partials\": " << time_of(budget, [&] { partials.dense(q, v); });
  }
  if (n <= largest_dense) {
    std::cout << ", \"lagrangian\": " << time_of(budget, [&] { model.lagrangian(q, v); });
  }
  const StepTime step = time_of_steps(model, model.state(q, VecX::Zero(n)));
  std::cout << ", \"step\": " << step.time << ", \"iterations\": " << step.iterations
            << ", \"residual\": " << step.residual << "}" << std::endl;
}

}  // namespace

int main(int argc, char** argv) { return saltus::bench::main(argc, argv, run); }
