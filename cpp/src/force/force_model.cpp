#include "saltus/force/force_model.hpp"

#include <algorithm>
#include <cmath>

namespace saltus {
namespace {

/// f and its slopes by l and l'; 0 where the effort limits it.
struct Push {
  double f, size, by_l, by_rate, rate;
};

Push push_of(const Actuator& a, const VecRef& q, const VecRef& v, double u) {
  double l = 0, rate = 0, size_l = 0, size_rate = 0;
  for (const Gear& gear : a.gears) {
    l += gear.ratio * q[gear.coordinate];
    rate += gear.ratio * v[gear.velocity];
    size_l += std::abs(gear.ratio * q[gear.coordinate]);
    size_rate += std::abs(gear.ratio * v[gear.velocity]);
  }
  const double asked = a.gain * std::clamp(u, a.lower, a.upper);
  const double f = asked + a.bias + a.bias_l * l + a.bias_v * rate;
  if (std::abs(f) >= a.effort) return {std::copysign(a.effort, f), a.effort, 0, 0, rate};
  const double size = std::abs(asked) + std::abs(a.bias) + std::abs(a.bias_l) * size_l +
                      std::abs(a.bias_v) * size_rate;
  return {f, size, a.bias_l, a.bias_v, rate};
}

void add_coupled(const Actuator& a, const Push& push, int column, ForceValues& out) {
  for (const Gear& gear : a.gears) {
    out.Q[gear.velocity] += gear.ratio * push.f;
    out.size[gear.velocity] += std::abs(gear.ratio) * push.size;
  }
  out.slope[2 * column] = push.by_l;
  out.slope[2 * column + 1] = push.by_rate;
}

/// All that move one coordinate, in one loop over plain numbers: a robot has many.
void add_singles(const VecRef& q, const VecRef& v, const ForceInput& input, ForceValues& out) {
  const double* u = input.control.size() > 0 ? input.control.data() : nullptr;
  for (const SingleActuator& a : out.singles) {
    const double l = a.ratio * q[a.coordinate], rate = a.ratio * v[a.velocity];
    const double told = std::min(std::max(u ? u[a.index] : 0, a.lower), a.upper);
    const double asked = a.gain * told, by_l = a.bias_l * l, by_rate = a.bias_v * rate;
    const double f = asked + a.bias + by_l + by_rate;
    const bool is_limited = std::abs(f) >= a.effort;
    const double push = is_limited ? std::copysign(a.effort, f) : f;
    out.effort[a.index] = push;
    out.rate[a.index] = rate;
    out.single[a.velocity] += a.ratio * push;
    if (is_limited) {
      out.size[a.velocity] += std::abs(a.ratio) * a.effort;
      continue;
    }
    out.size[a.velocity] += std::abs(a.ratio) * (std::abs(asked) + std::abs(a.bias) +
                                                 std::abs(by_l) + std::abs(by_rate));
    out.Q_q[a.velocity] += a.ratio * a.ratio * a.bias_l;
    out.Q_v[a.velocity] += a.ratio * a.ratio * a.bias_v;
  }
}

/// The joint's limit on the sum of its actuators, each of which keeps its share.
void limit_single(const ForceModel& forces, ForceValues& out) {
  if (forces.effort.size() == 0) return;
  for (Eigen::Index k = 0; k < out.effort.size(); ++k) {
    const Actuator& a = forces.actuators[static_cast<std::size_t>(k)];
    if (!a.is_single()) continue;
    const int c = a.gears.front().velocity;
    const double sum = std::abs(out.single[c]);
    if (sum > forces.effort[c]) out.effort[k] *= forces.effort[c] / sum;
  }
  for (Eigen::Index c = 0; c < out.single.size(); ++c) {
    if (!(std::abs(out.single[c]) > forces.effort[c])) continue;
    out.single[c] = std::copysign(forces.effort[c], out.single[c]);
    out.Q_q[c] = out.Q_v[c] = 0;
  }
}

}  // namespace

int ForceModel::n_coupled() const {
  return static_cast<int>(std::count_if(actuators.begin(), actuators.end(),
                                        [](const Actuator& a) { return !a.is_single(); }));
}

int ForceModel::n_columns() const {
  std::size_t columns = 3 * dampers.size();
  for (const FunctionForce& each : functions) columns += each.velocities.size();
  return static_cast<int>(columns);
}

ForceValues::ForceValues(const ForceModel& forces, int n_v) {
  const int columns = forces.n_coupled();
  for (VecX* each : {&Q, &size, &Q_q, &Q_v, &damping, &single}) each->setZero(n_v);
  for (VecX* each : {&effort, &rate}) each->setZero(forces.n_u());
  coupled.setZero(n_v, columns);
  slope.setZero(2 * columns);
  answers.resize(forces.functions.size());
  int column = 0;
  for (int k = 0; k < forces.n_u(); ++k) {
    const Actuator& a = forces.actuators[static_cast<std::size_t>(k)];
    if (a.is_single()) {
      const Gear& gear = a.gears.front();
      singles.push_back({k, gear.velocity, gear.coordinate, gear.ratio, a.gain, a.bias, a.bias_l,
                         a.bias_v, a.effort, a.lower, a.upper});
      continue;
    }
    geared.push_back(k);
    for (const Gear& gear : a.gears) coupled(gear.velocity, column) += gear.ratio;
    ++column;
  }
}

void set_forces(const ForceModel& forces, const VecRef& q, const VecRef& v, const ForceInput& input,
                ForceValues& out) {
  for (VecX* each : {&out.Q_q, &out.Q_v, &out.single, &out.Q, &out.size}) each->setZero();
  add_singles(q, v, input, out);
  int column = 0;
  for (const int k : out.geared) {
    const Actuator& a = forces.actuators[static_cast<std::size_t>(k)];
    const Push push = push_of(a, q, v, input.control.size() > 0 ? input.control[k] : 0);
    out.effort[k] = push.f;
    out.rate[k] = push.rate;
    add_coupled(a, push, column++, out);
  }
  limit_single(forces, out);
  out.Q += out.single;
  if (forces.damping.size() > 0) {
    out.damping = -forces.damping.cwiseProduct(v);
    out.Q += out.damping;
    out.Q_v -= forces.damping;
    out.size += out.damping.cwiseAbs();
  }
  if (input.qfrc.size() > 0) {
    out.Q += input.qfrc;
    out.size += input.qfrc.cwiseAbs();
  }
}

void add_functions(const ForceModel& forces, const ForceMoment& now, ForceValues& out) {
  for (std::size_t k = 0; k < forces.functions.size(); ++k) {
    const FunctionForce& force = forces.functions[k];
    ask(force, now, out.answers[k]);
    for (std::size_t i = 0; i < force.velocities.size(); ++i) {
      const double Q = out.answers[k].Q[static_cast<Eigen::Index>(i)];
      out.Q[force.velocities[i]] += Q;
      out.size[force.velocities[i]] += std::abs(Q);
    }
  }
}

}  // namespace saltus
