// Random poses, the same for every engine and on every machine.
#pragma once

#include <Eigen/Geometry>
#include <random>

namespace saltus::bench {

/// Starts anew where one is made; those who ask in the same order are given the same.
class RandomPoses {
 public:
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_()) / 4294967296.0;
  }
  Eigen::Vector3d direction() {
    Eigen::Vector3d x;
    do x = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    while (x.norm() > 1 || x.norm() < 0.1);
    return x.normalized();
  }
  Eigen::Matrix3d rotation() {
    const double angle = uniform(-3, 3);
    return Eigen::AngleAxisd(angle, direction()).toRotationMatrix();
  }

 private:
  std::mt19937 engine_{1};
};

}  // namespace saltus::bench
