// Distances of Coal between the shapes and poses of bench_collision.cpp: bench_coal SECONDS.
//
// coal::distance with normal and nearest points, its own tolerances, the guess of the call before.
#include <coal/distance.h>
#include <coal/shape/geometric_shapes.h>

#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "clock.hpp"
#include "poses.hpp"

namespace {

using Eigen::Vector3d;
using saltus::bench::Time;
using saltus::bench::time_of;

constexpr int poses = 64;

saltus::bench::RandomPoses random_poses;

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
      random_poses = {};
      std::vector<coal::Transform3s> X;
      for (int k = 0; k < poses; ++k) {
        const double distance = random_poses.uniform(0.5, 2);
        const Eigen::Matrix3d R = random_poses.rotation();
        X.emplace_back(R, Vector3d(distance * random_poses.direction()));
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
