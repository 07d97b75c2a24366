// Distances of Coal between the shapes and poses of bench_collision.cpp: bench_coal SECONDS.
//
// coal::distance with normal and nearest points, its own tolerances, the guess of the call before.
#include <coal/distance.h>
#include <coal/shape/geometric_shapes.h>

#include <iostream>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "clock.hpp"

namespace {

using Eigen::Vector3d;
using saltus::bench::Time;
using saltus::bench::time_of;

constexpr int poses = 64;

std::mt19937 engine(1);

double uniform(double low, double high) {
  return low + (high - low) * static_cast<double>(engine()) / 4294967296.0;
}

Vector3d direction() {
  Vector3d x;
  do x = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
  while (x.norm() > 1 || x.norm() < 0.1);
  return x.normalized();
}

std::unique_ptr<coal::ShapeBase> example(const std::string& kind) {
  if (kind == "sphere") return std::make_unique<coal::Sphere>(0.3);
  if (kind == "capsule") return std::make_unique<coal::Capsule>(0.2, 0.6);
  if (kind == "box") return std::make_unique<coal::Box>(0.4, 0.6, 0.8);
  if (kind == "cylinder") return std::make_unique<coal::Cylinder>(0.2, 0.6);
  if (kind == "ellipsoid") return std::make_unique<coal::Ellipsoid>(0.2, 0.3, 0.4);
  return std::make_unique<coal::Halfspace>(Vector3d::UnitZ(), 0);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << argv[0] << " SECONDS\n";
    return 2;
  }
  const double budget = std::stod(argv[1]);
  const std::vector<std::string> kinds = {"sphere",   "capsule",    "box",
                                          "cylinder", "half_space", "ellipsoid"};
  bool first = true;
  std::cout << "{";
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    for (std::size_t j = i; j < kinds.size(); ++j) {
      if (kinds[i] == "half_space" && kinds[j] == "half_space") continue;
      const auto a = example(kinds[i]), b = example(kinds[j]);
      std::vector<coal::Transform3s> X;
      for (int k = 0; k < poses; ++k) {
        const double distance = uniform(0.5, 2);
        const Eigen::AngleAxisd turn(uniform(-3, 3), direction());
        X.emplace_back(turn.toRotationMatrix(), Vector3d(distance * direction()));
      }
      const coal::Transform3s identity = coal::Transform3s::Identity();
      coal::DistanceRequest request(true, true);
      coal::DistanceResult result;
      double sum = 0;
      const Time time = time_of(budget, [&] {
        for (const coal::Transform3s& pose : X) {
          result.clear();
          sum += coal::distance(a.get(), pose, b.get(), identity, request, result);
        }
      });
      if (sum == 0) std::cerr << "nothing was measured\n";
      std::cout << (first ? "" : ", ") << "\"" << kinds[i] << "-" << kinds[j]
                << "\": " << Time{time.least / poses, time.median / poses};
      first = false;
    }
  }
  std::cout << "}" << std::endl;
}
