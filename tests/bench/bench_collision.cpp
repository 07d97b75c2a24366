// What collisions cost: bench_collision SECONDS prints one JSON object.
//
//   gaps     a gap with normal and witnesses of each two kinds of shape, over 64 poses, near and
//   far gradient two balls on a joint each: the gap and phi_q broad    find_candidates for n balls,
//   in a row, a square, a cube; equally dense cradle   a step of 1000 touching balls, the first
//   swinging, and of 1000 pendulums without pairs
#include <saltus/collision/broad_phase.hpp>
#include <saltus/saltus.hpp>

#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include "clock.hpp"
#include "poses.hpp"

namespace {

using namespace saltus;
using bench::Time;
using bench::time_of;

constexpr int poses = 64;

bench::RandomPoses random_poses;

Pose pose_at(double distance) {
  const Mat3 R = random_poses.rotation();
  return {R, distance * random_poses.direction()};
}

Convex ball_hull(int points) {
  std::vector<Vec3> cloud;
  for (int k = 0; k < points; ++k) cloud.push_back(0.3 * random_poses.direction());
  return {std::make_shared<const Hull>(convex_hull(cloud))};
}

Shape example(const std::string& kind) {
  if (kind == "sphere") return Sphere{0.3};
  if (kind == "capsule") return Capsule{0.2, 0.3};
  if (kind == "box") return Box{{0.2, 0.3, 0.4}};
  if (kind == "cylinder") return Cylinder{0.2, 0.3};
  if (kind == "ellipsoid") return Ellipsoid{{0.2, 0.3, 0.4}};
  if (kind == "convex") return ball_hull(32);
  return HalfSpace{};
}

void print_gaps(double budget) {
  std::cout << "\"gaps\": {";
  bool first = true;
  for (const auto& [kind_a, kind_b] : gap_table()) {
    const Shape a = example(kind_a), b = example(kind_b);
    random_poses = {};  // as in bench_coal.cpp
    std::vector<Pose> X;
    for (int k = 0; k < poses; ++k) X.push_back(pose_at(random_poses.uniform(0.5, 2)));
    double sum = 0;
    const Time time = time_of(budget, [&] {
      for (const Pose& X_WA : X) sum += gap(a, X_WA, b, {}).phi;
    });
    if (!std::isfinite(sum)) std::cerr << kind_a << "-" << kind_b << " is not finite\n";
    std::cout << (first ? "" : ", ") << "\"" << kind_a << "-" << kind_b
              << "\": " << Time{time.least / poses, time.median / poses};
    first = false;
  }
  std::cout << "}";
}

void add_ball(ModelBuilder& b, int i, const Vec3& at, const Vec3& axis) {
  const std::string name = std::to_string(i);
  b.add_link({name, solid_sphere(1, 0.5)});
  b.add_joint({.name = name,
               .type = JointType::prismatic,
               .parent = "world",
               .child = name,
               .X_PJ = {Mat3::Identity(), at},
               .axis = axis});
  b.add_shape(name, Sphere{0.5});
}

Time gradient(double budget) {
  ModelBuilder b("two");
  add_ball(b, 0, Vec3::Zero(), Vec3::UnitX());
  add_ball(b, 1, {1.5, 0.2, 0.1}, Vec3::UnitX());
  const Model model = b.build();
  const Pair pair = model.pair(0);
  Kinematics kin(model->tree);
  set_configuration(model->tree, VecX::Zero(2), kin);
  VecX phi_q = VecX::Zero(2);
  return time_of(budget, [&] {
    const Gap g = pair_gap(model->tree, kin, pair);
    phi_q.setZero();
    add_gap_gradient(model->tree, kin, pair, g, phi_q);
  });
}

/// The time of `work` alone, which follows `prepare` as it does in a step: what that has written is
/// in the caches. Less what a look at the clock costs. The mean of `period` calls is a sample, so
/// that what only some calls do is paid for.
template <class Prepare, class Work>
Time timed_after(double budget, int period, const Prepare& prepare, const Work& work) {
  double clock = HUGE_VAL;
  for (int k = 0; k < 1000; ++k) {
    const double begin = bench::cpu_seconds();
    clock = std::min(clock, bench::cpu_seconds() - begin);
  }
  std::vector<double> seconds;
  double spent = 0;
  for (int samples = 0; spent < budget || samples < 5; ++samples) {
    double took = 0;
    for (int k = 0; k < period; ++k) {
      prepare();
      const double begin = bench::cpu_seconds();
      work();
      took += bench::cpu_seconds() - begin - clock;
    }
    if (samples > 0) seconds.push_back(took / period);  // the first sorts and builds
    spent += took;
  }
  return bench::summary(seconds);
}

/// n balls of radius 0.5 in a row, square or cube with 1.5 m for each.
Time broad_phase(double budget, int n, int dimensions) {
  const double side = 1.5 * std::pow(n, 1.0 / dimensions);
  Tree tree;
  std::vector<PlacedShape> shapes;
  for (int i = 0; i < n; ++i) {
    Pose X_PJ = pose_at(1);
    for (int k = 0; k < 3; ++k) X_PJ.p[k] = k < dimensions ? random_poses.uniform(0, side) : 0;
    add_joint(tree, -1, {Joint::Kind::prismatic, 0}, X_PJ, {i, 1, 0});
    PlacedShape shape;
    shape.shape = Sphere{0.5};
    shape.joint = i;
    shapes.push_back(shape);
  }
  PairRules rules;
  rules.group.assign(shapes.size(), 0);
  const PairTable pairs(shapes, rules);
  BroadPhase bp(tree, shapes, pairs);
  VecX dq(n);
  for (double& x : dq) x = random_poses.uniform(-0.02, 0.02);
  Kinematics kin(tree);
  constexpr int period = 128;
  int call = 0;
  return timed_after(
      budget, period,
      [&] {  // to and fro along the motion
        const VecX q = std::abs(period / 2 - call++ % period) * dq;
        set_configuration(tree, q, kin);
      },
      [&] { find_candidates(tree, shapes, pairs, kin, dq, 0, bp); });
}

void print_broad_phase(double budget) {
  const char* const names[] = {"row", "square", "cube"};
  std::cout << "\"broad\": [";
  for (int dimensions = 1; dimensions <= 3; ++dimensions) {
    for (const int n : {100, 1000, 10000}) {
      std::cout << (dimensions == 1 && n == 100 ? "" : ", ") << "{\"scene\": \""
                << names[dimensions - 1] << "\", \"n\": " << n
                << ", \"time\": " << broad_phase(budget, n, dimensions) << "}";
    }
  }
  std::cout << "]";
}

/// Steps of 1 ms while the first of the balls swings and the others hang.
Time cradle_step(double budget, const Model& model, bool collisions) {
  Stepper stepper(model, {.h = 1e-3, .collisions = collisions});
  VecX q = model.neutral();
  q[0] = 0.3;
  const State start = model.state(q, VecX::Zero(model.n_v()));
  State state = start;
  for (int k = 0; k < 10; ++k) stepper.step(state);
  int steps = 0;
  return time_of(budget, [&] {
    if (++steps > 400) {  // before the impact at 0.5 s
      steps = 0;
      state = start;
    }
    stepper.step(state);
  });
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << argv[0] << " SECONDS CRADLE.urdf\n";
    return 2;
  }
  try {
    const double budget = std::stod(argv[1]);
    const Model cradle = load_urdf(argv[2]);
    std::cout << "{";
    print_gaps(budget);
    std::cout << ", \"gradient\": " << gradient(budget) << ", ";
    print_broad_phase(budget);
    std::cout << ", \"cradle\": {\"pairs\": " << cradle->pairs.size()
              << ", \"step\": " << cradle_step(10 * budget, cradle, true)
              << ", \"without\": " << cradle_step(10 * budget, cradle, false) << "}}" << std::endl;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
