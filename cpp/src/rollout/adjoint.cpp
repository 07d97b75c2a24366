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

/// Steps before a part, so that guesses are those of steps before: the guess takes four arcs.
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

  Eigen::Index steps() const {
    return rows.steps > 0 ? rows.steps : rows.every * (rows.t.size() - 1);
  }
  Eigen::Index step_of(Eigen::Index row) const { return std::min(row * rows.every, steps()); }
  bool is_by_step() const { return rows.by_step.size() > 0; }

  State state_of(Eigen::Index row) const {
    return {rows.t[row], rows.q.row(row).transpose(), rows.p.row(row).transpose()};
  }

  ForceInput input_of(Eigen::Index k) const {
    ForceInput input;
    if (is_by_step()) {
      input.control = rows.by_step.row(k).transpose();
    } else if (rows.control.cols() > 0) {
      input.control = rows.control.row(k / rows.every).transpose();
    }
    input.qfrc = rows.qfrc;
    input.wrenches = rows.wrenches;
    return input;
  }

  /// What was applied is not in the rows, and controls not between them: with something else steps
  /// end elsewhere. Where rounding has grown they go on from the row.
  void meet_row(Eigen::Index row, State& state) const {
    const VecX p = rows.p.row(row).transpose();
    const double away = (state.p - p).norm() / (1 + p.norm());
    if (away <= 1e-12) return;
    if (away <= 1e-6) {  // far beyond what rounding does to a step
      if (rows.every > 1) state = state_of(row);
      return;
    }
    throw ModelError("step " + std::to_string(step_of(row) - 1) +
                     " made again ends with other momenta than the run has, by " +
                     std::to_string((state.p - p).norm()) +
                     ": control, forces or qfrc are not those that were applied");
  }

  /// Makes step k. @param is_asked its end is compared with the run's row, if it has one
  void step(Eigen::Index k, bool is_asked, State& state) {
    ask();
    stepper.step(state, input_of(k));
    const Eigen::Index row = (k + rows.every) / rows.every;  // k + 1, rounded up
    if (is_asked && step_of(row) == k + 1) meet_row(row, state);
  }

  /// Rows a step each are asked once a part: states may leave them by rounding, and stay lawful.
  bool is_asked(Eigen::Index k, Eigen::Index first) const {
    if (rows.every > 1) return true;
    return k == first &&
           (rows.qfrc.size() > 0 || !rows.wrenches.empty() || model->equalities.rows > 0);
  }

  /// A state that a part begins with, a few steps before its first.
  struct Mark {
    Eigen::Index step;
    State state;
  };

  /// Marks of the parts of [first, last), `block` steps each: the first is a row.
  std::vector<Mark> marks_of(Eigen::Index first, Eigen::Index last, Eigen::Index block) {
    const Eigen::Index row = std::max<Eigen::Index>(first - warm_up, 0) / rows.every;
    std::vector<Mark> marks{{step_of(row), state_of(row)}};
    State state = marks.front().state;
    stepper.forget();
    stepper.record(false);
    Eigen::Index k = marks.front().step;
    for (Eigen::Index next = first + block; next < last; next += block) {
      for (; k < next - warm_up; ++k) step(k, is_asked(k, first), state);
      marks.push_back({k, state});
    }
    return marks;
  }

  /// Tapes of the steps [first, last). A part continues its own states and not the rows: these may
  /// differ in the last bits, and a step from elsewhere has no guess.
  void record(const Mark& from, Eigen::Index first, Eigen::Index last) {
    tapes.resize(std::max(tapes.size(), static_cast<std::size_t>(last - first)));
    State state = from.state;
    stepper.forget();
    for (Eigen::Index k = from.step; k < last; ++k) {
      stepper.record(k >= first);
      step(k, is_asked(k, first), state);
      if (k < first || stepper.tape() == nullptr) continue;
      tapes[static_cast<std::size_t>(k - first)] = *stepper.tape();
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
    const Eigen::Index row = k / rows.every;
    to.control.row(is_by_step() ? k : row) += back.control.transpose();
    to.qfrc.row(row) += back.qfrc.transpose();
    for (Eigen::Index i = 0; i < back.forces.rows(); ++i) {
      to.forces.block<1, 3>(row, 3 * i) += back.forces.row(i);
      to.torques.block<1, 3>(row, 3 * i) += back.torques.row(i);
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

void check_steps(const Model& model, const RunRows& rows) {
  const Eigen::Index parts = rows.t.size() - 1, every = std::max<Eigen::Index>(rows.every, 1);
  const Eigen::Index steps = rows.steps > 0 ? rows.steps : every * parts;
  if (rows.every < 1 || (steps + every - 1) / every != parts) {
    throw ModelError("the run has " + std::to_string(parts + 1) + " rows, " +
                     std::to_string(rows.every) + " steps apart; that is not a run of " +
                     std::to_string(steps) + " steps");
  }
  const MatX& told = rows.by_step;
  if (told.size() == 0 || (told.rows() == steps && told.cols() == model->forces.n_u())) return;
  throw ModelError("control is " + std::to_string(told.rows()) + " by " +
                   std::to_string(told.cols()) + "; it is " + std::to_string(steps) + " by " +
                   std::to_string(model->forces.n_u()) + ", a row for each step");
}

void check_rows(const Model& model, const RunRows& rows, const MatX& q_hat, const MatX& p_hat) {
  const auto check = [&](const MatX& x, Eigen::Index columns, const char* name) {
    if (x.rows() == rows.t.size() && x.cols() == columns) return;
    throw ModelError(std::string(name) + " is " + std::to_string(x.rows()) + " by " +
                     std::to_string(x.cols()) + "; it is " + std::to_string(rows.t.size()) +
                     " by " + std::to_string(columns) + ", a row for each of the run's");
  };
  if (rows.t.size() == 0) throw ModelError("the run has no rows");
  check_steps(model, rows);
  check(rows.q, model.n_q(), "q");
  check(rows.p, model.n_v(), "p");
  check(rows.control, model->forces.n_u(), "control");
  if (rows.qfrc.size() > 0) check_vector(rows.qfrc, model.n_v(), "qfrc", "velocities");
  check(q_hat, model.n_v(), "q_hat");
  check(p_hat, model.n_v(), "p_hat");
}

RunGradient zero_of(const Model& model, const RunRows& rows) {
  const int n = model.n_v();
  const Eigen::Index parts = rows.t.size() - 1;
  RunGradient out;
  const Eigen::Index controls = rows.by_step.size() > 0 ? rows.by_step.rows() : parts;
  out.control.setZero(controls, model->forces.n_u());
  out.qfrc.setZero(parts, n);
  for (MatX* each : {&out.forces, &out.torques}) {
    each->setZero(parts, static_cast<Eigen::Index>(3 * rows.wrenches.size()));
  }
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
  const Eigen::Index parts = rows.t.size() - 1, block = block_length(model);
  RunGradient out = zero_of(model, rows);
  StepOptions plain = options;
  plain.certify = false;  // proofs change no step
  Backwards run(model, plain, rows, goes_on);
  StateDirection hat{q_hat.row(parts).transpose(), p_hat.row(parts).transpose()};
  const Eigen::Index at_once = std::max<Eigen::Index>(block / rows.every, 1);
  for (Eigen::Index row = parts; row > 0;) {
    const Eigen::Index first_row = std::max<Eigen::Index>(row - at_once, 0);
    const Eigen::Index start = run.step_of(first_row), end = run.step_of(row);
    const auto marks = run.marks_of(start, end, block);
    for (std::size_t part = marks.size(); part-- > 0;) {
      const Eigen::Index first = start + static_cast<Eigen::Index>(part) * block;
      const Eigen::Index last = std::min(first + block, end);
      run.record(marks[part], first, last);
      for (Eigen::Index k = last - 1; k >= first; --k) {
        run.pull(k, run.tapes[static_cast<std::size_t>(k - first)], hat, out);
        if (k % rows.every != 0) continue;
        hat.q += q_hat.row(k / rows.every).transpose();
        hat.p += p_hat.row(k / rows.every).transpose();
      }
    }
    row = first_row;
  }
  for (const auto& each : run.pairs) out.model.pairs.push_back(each.second);
  out.q = std::move(hat.q);
  out.p = std::move(hat.p);
  return out;
}

}  // namespace saltus
