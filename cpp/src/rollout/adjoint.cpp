#include "saltus/rollout/adjoint.hpp"

#include <algorithm>
#include <map>

namespace saltus {
namespace {

/// Steps whose tapes are kept at once, of about 64 MB: a tape has some twenty vectors.
Eigen::Index block_length(const Model& model) {
  constexpr Eigen::Index bytes = 64 << 20, least = 16, most = 4096;
  return std::clamp<Eigen::Index>(bytes / (2000 + 200 * model.n_v()), least, most);
}

/// Steps before a block, so that guesses are those of steps before: the guess takes four arcs.
constexpr Eigen::Index warm_up = 5;

struct Backwards {
  const Model& model;
  const RunRows& rows;
  const std::function<void()>& goes_on;
  Stepper stepper;
  StepDerivatives derivatives;
  std::vector<Tape> tapes;
  std::map<int, PairGradient> pairs;  ///< sums, by number
  Eigen::Index count = 0;

  Backwards(const Model& with, const StepOptions& options, const RunRows& of,
            const std::function<void()>& asked)
      : model(with), rows(of), goes_on(asked), stepper(with, options), derivatives(with, options) {}

  void ask() {
    if (goes_on && count++ % 256 == 0) goes_on();
  }

  void add(const PairGradient& each) {
    PairGradient& sum = pairs.try_emplace(each.pair, PairGradient{each.pair, 0, 0}).first->second;
    sum.restitution += each.restitution;
    sum.friction += each.friction;
  }

  ForceInput input_of(Eigen::Index k) const {
    ForceInput input;
    if (rows.control.cols() > 0) input.control = rows.control.row(k).transpose();
    input.qfrc = rows.qfrc;
    input.wrenches = rows.wrenches;
    return input;
  }

  /// What was applied is not in the rows: with something else steps end elsewhere.
  void check_end(Eigen::Index k, const State& end) const {
    if (rows.qfrc.size() == 0 && rows.wrenches.empty()) return;
    const VecX p = rows.p.row(k + 1).transpose();
    const double away = (end.p - p).norm();
    if (away <= 1e-6 * (1 + p.norm())) return;  // far beyond what rounding does to a step
    throw ModelError("step " + std::to_string(k) + " made again ends with other momenta than the " +
                     "run has, by " + std::to_string(away) +
                     ": forces or qfrc are not those that were applied");
  }

  /// Tapes of the steps [first, last). A block continues its own states and not the rows: these may
  /// differ in the last bits, and a step from elsewhere has no guess.
  void record(Eigen::Index first, Eigen::Index last) {
    tapes.resize(std::max(tapes.size(), static_cast<std::size_t>(last - first)));
    Eigen::Index k = std::max<Eigen::Index>(first - warm_up, 0);
    State state{rows.t[k], rows.q.row(k).transpose(), rows.p.row(k).transpose()};
    stepper.forget();
    for (; k < last; ++k) {
      ask();
      stepper.record(k >= first);
      stepper.step(state, input_of(k));
      if (k < first) continue;
      if (k == first) check_end(k, state);
      if (stepper.tape() != nullptr) tapes[static_cast<std::size_t>(k - first)] = *stepper.tape();
    }
  }

  /// hat <- the covector of step k's start; adds to `to`.
  void pull(Eigen::Index k, const Tape& tape, StateDirection& hat, RunGradient& to) {
    ask();
    ModelGradient by_model;
    StepDirection back;
    try {
      derivatives.linearize(tape);
      back = derivatives.vjp(hat, by_model);
    } catch (const ModelError& error) {
      throw ModelError("step " + std::to_string(k) + ", at t = " + std::to_string(tape.t) +
                       " s: " + error.what());
    }
    to.control.row(k) = back.control.transpose();
    to.qfrc.row(k) = back.qfrc.transpose();
    for (Eigen::Index i = 0; i < back.forces.rows(); ++i) {
      to.forces.block<1, 3>(k, 3 * i) = back.forces.row(i);
    }
    to.h += back.h;
    to.model.inertia += by_model.inertia;
    to.model.stiffness += by_model.stiffness;
    to.model.rest += by_model.rest;
    to.model.damping += by_model.damping;
    to.model.armature += by_model.armature;
    to.model.actuators += by_model.actuators;
    to.model.springs += by_model.springs;
    to.model.dampers += by_model.dampers;
    to.model.placements += by_model.placements;
    for (const PairGradient& each : by_model.pairs) add(each);
    hat.q = std::move(back.q);
    hat.p = std::move(back.p);
  }
};

void check_rows(const Model& model, const RunRows& rows, const MatX& q_hat, const MatX& p_hat) {
  const auto check = [&](const MatX& x, Eigen::Index columns, const char* name) {
    if (x.rows() == rows.t.size() && x.cols() == columns) return;
    throw ModelError(std::string(name) + " is " + std::to_string(x.rows()) + " by " +
                     std::to_string(x.cols()) + "; it is " + std::to_string(rows.t.size()) +
                     " by " + std::to_string(columns) + ", a row for each of the run's");
  };
  if (rows.t.size() == 0) throw ModelError("the run has no rows");
  check(rows.q, model.n_q(), "q");
  check(rows.p, model.n_v(), "p");
  check(rows.control, model->forces.n_u(), "control");
  if (rows.qfrc.size() > 0) check_vector(rows.qfrc, model.n_v(), "qfrc", "velocities");
  check(q_hat, model.n_v(), "q_hat");
  check(p_hat, model.n_v(), "p_hat");
}

RunGradient zero_of(const Model& model, const RunRows& rows, Eigen::Index steps) {
  const int n = model.n_v();
  RunGradient out;
  out.control.setZero(steps, model->forces.n_u());
  out.qfrc.setZero(steps, n);
  out.forces.setZero(steps, static_cast<Eigen::Index>(3 * rows.wrenches.size()));
  ModelGradient& g = out.model;
  g.inertia.setZero(static_cast<Eigen::Index>(model->links.size()), 10);
  for (VecX* each : {&g.stiffness, &g.rest, &g.damping, &g.armature}) each->setZero(n);
  g.actuators.setZero(model->forces.n_u(), 4);
  g.springs.setZero(static_cast<Eigen::Index>(model->mass.potentials.springs.size()), 2);
  g.dampers.setZero(static_cast<Eigen::Index>(model->forces.dampers.size()));
  g.placements.setZero(static_cast<Eigen::Index>(model->joints.size()), 3);
  return out;
}

}  // namespace

RunGradient adjoint(const Model& model, const StepOptions& options, const RunRows& rows,
                    const MatX& q_hat, const MatX& p_hat, const std::function<void()>& goes_on) {
  check_rows(model, rows, q_hat, p_hat);
  const Eigen::Index steps = rows.t.size() - 1, block = block_length(model);
  RunGradient out = zero_of(model, rows, steps);
  StepOptions plain = options;
  plain.certify = false;  // proofs change no step
  Backwards run(model, plain, rows, goes_on);
  StateDirection hat{q_hat.row(steps).transpose(), p_hat.row(steps).transpose()};
  for (Eigen::Index last = steps; last > 0;) {
    const Eigen::Index first = std::max<Eigen::Index>(last - block, 0);
    run.record(first, last);
    for (Eigen::Index k = last - 1; k >= first; --k) {
      run.pull(k, run.tapes[static_cast<std::size_t>(k - first)], hat, out);
      hat.q += q_hat.row(k).transpose();
      hat.p += p_hat.row(k).transpose();
    }
    last = first;
  }
  for (const auto& each : run.pairs) out.model.pairs.push_back(each.second);
  out.q = std::move(hat.q);
  out.p = std::move(hat.p);
  return out;
}

}  // namespace saltus
