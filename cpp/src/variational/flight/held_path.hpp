// The velocity of an arc as a function of its duration, between durations that it was solved for.
//
// With what contacts hold closed an arc costs far more than a look at a gap along this path, so
// that its root is the next duration to solve for: three or four of them tell an impact's time.
#pragma once

#include <array>

#include "variational/node/node.hpp"

namespace saltus {

class HeldPath {
 public:
  explicit HeldPath(const Scene& scene);

  void start() { count_ = 0; }
  /// Of more than three the one farthest from the new one is forgotten.
  void add(double tau, const VecX& v);
  /// The polynomial through all of them.
  void velocity(double tau, VecX& v) const;
  int count() const { return count_; }

 private:
  static constexpr int most = 3;
  int count_ = 0;
  std::array<double, most> tau_{};
  std::array<VecX, most> v_;
};

}  // namespace saltus
