#include "variational/flight/held_path.hpp"

#include <cmath>

namespace saltus {

HeldPath::HeldPath(const Scene& scene) {
  for (VecX& v : v_) v.setZero(scene.model.tree.n_v);
}

void HeldPath::add(double tau, const VecX& v) {
  int at = -1;
  for (int i = 0; i < count_; ++i) {
    if (tau_[i] == tau) at = i;
  }
  if (at < 0 && count_ < most) at = count_++;
  if (at < 0) {
    at = 0;
    for (int i = 1; i < most; ++i) {
      if (std::abs(tau_[i] - tau) > std::abs(tau_[at] - tau)) at = i;
    }
  }
  tau_[at] = tau;
  v_[at] = v;
}

void HeldPath::velocity(double tau, VecX& v) const {
  v.setZero();
  for (int i = 0; i < count_; ++i) {
    double weight = 1;
    for (int j = 0; j < count_; ++j) {
      if (j != i) weight *= (tau - tau_[j]) / (tau_[i] - tau_[j]);
    }
    v += weight * v_[i];
  }
}

}  // namespace saltus
