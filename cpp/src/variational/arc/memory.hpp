// Memory: what the arcs before say of the next one. Guesses only: no step needs it.
//
// The velocities of the last arcs, at their middle times, are values of one smooth function until
// an impact; up to four of them are extrapolated (Lagrange form), which leaves an error of O(h^4).
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "variational/arc/rows.hpp"

namespace saltus {

class GuessHistory {
 public:
  explicit GuessHistory(int n_v) {
    for (VecX& v : v_) v.setZero(n_v);
  }
  void clear() { count_ = 0; }

  void add(double t_mid, const VecX& v) {
    newest_ = (newest_ + 1) % most;
    t_[newest_] = t_mid;
    v_[newest_] = v;
    if (count_ < most) ++count_;
  }

  /// Writes `v` (n_v); leaves it alone and returns false without history.
  bool extrapolate(double t_mid, VecX& v) const {
    std::array<double, most> weight;
    for (int count = count_; count > 0; --count) {
      double size = 0;
      for (int i = 0; i < count; ++i) {
        weight[i] = 1;
        for (int j = 0; j < count; ++j) {
          if (j != i) weight[i] *= (t_mid - t_at(j)) / (t_at(i) - t_at(j));
        }
        size += std::abs(weight[i]);
      }
      // Equal steps give 1, 3, 7, 15. Arcs cut short by impacts lie close together and would
      // magnify their rounding: then fewer are used.
      if (!(size <= 32)) continue;
      v.setZero();
      for (int i = 0; i < count; ++i) v += weight[i] * v_[index(i)];
      return true;
    }
    return false;
  }

 private:
  static constexpr int most = 4;
  int index(int i) const { return (newest_ + most - i) % most; }
  double t_at(int i) const { return t_[index(i)]; }

  std::array<double, most> t_{};
  std::array<VecX, most> v_;
  int newest_ = 0;
  int count_ = 0;
};

/// Written by this file, and `rate` by the flight that ends where a gap closes.
struct Memory {
  Memory(int n_v, int pool) : velocities(n_v), impulses(static_cast<std::size_t>(pool)) {
    rate.setZero(n_v);
  }

  GuessHistory velocities;
  bool has_rate = false;                ///< the arc ended where a gap closed:
  VecX rate;                            ///< (n_v) its dv/dtau, the acceleration there
  std::vector<ImpulseMemory> impulses;  ///< (pool) of rows
  std::vector<ImpulseMemory> dry;       ///< of joints with dry friction
  int arcs = 0;                         ///< numbers them
};

/// Of the arc from t on that has been flown, with its rows.
void remember(const Arc& arc, double t, const Rows& rows, Memory& memory);

/// After an impact velocities and impulses are others, but the acceleration goes on, nearly.
inline void forget_velocities(Memory& memory) {
  memory.velocities.clear();
  ++memory.arcs;
}

/// No arc of before is a guess.
inline void forget(Memory& memory) {
  forget_velocities(memory);
  memory.has_rate = false;
}

}  // namespace saltus
