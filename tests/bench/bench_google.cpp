// The kernels of bench_kernels.cpp by Google Benchmark, whose options and outputs are many people's
// habit: bench_google [--benchmark_...] [floating:]FILE[@ANGLE]...
#include <benchmark/benchmark.h>
#include <saltus/saltus.hpp>

#include <memory>
#include <string>

#include "clock.hpp"

namespace {

using namespace saltus;

void register_model(const bench::Job& job) {
  UrdfOptions options;
  options.effects = JointEffects::none;  // as the peers: bare mechanics
  if (job.floating) options.root_joint = JointType::floating;
  const Model model = load_urdf(job.file, options);
  const int n = model.n_v();
  const VecX q = model.integrate(model.neutral(), VecX::Constant(n, job.angle));
  const VecX v = VecX::Constant(n, 0.1);
  benchmark::RegisterBenchmark((model->name + "/lagrangian").c_str(), [=](benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(model.lagrangian(q, v));
  });
  benchmark::RegisterBenchmark((model->name + "/step").c_str(), [=](benchmark::State& state) {
    StepOptions smooth;
    smooth.h = 1e-3;
    smooth.collisions = false;
    Stepper stepper(model, smooth);
    State x = model.state(q, VecX::Zero(n));
    for (auto _ : state) stepper.step(x);
  });
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);  // takes its own arguments out
  try {
    for (int i = 1; i < argc; ++i) register_model(bench::job(argv[i]));
    benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
