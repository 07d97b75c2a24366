// A trajectory of states that somebody else computed.
#include <cmath>

#include "rollout/recorder.hpp"
#include "saltus/rollout/trajectory.hpp"

namespace saltus {
namespace {

void check_shape(const Eigen::Ref<const MatX>& x, Eigen::Index rows, int n,
                 const std::string& what) {
  if (x.rows() == rows && x.cols() == n) return;
  throw ModelError(what + " has shape (" + std::to_string(x.rows()) + ", " +
                   std::to_string(x.cols()) + "); with these times and this model it has (" +
                   std::to_string(rows) + ", " + std::to_string(n) + ")");
}

void check_times(const VecRef& t) {
  if (t.size() == 0) throw ModelError("t has no entries; a trajectory has at least one row");
  for (Eigen::Index row = 0; row < t.size(); ++row) {
    const std::string entry = "t[" + std::to_string(row) + "]";
    if (!std::isfinite(t[row])) throw ModelError(entry + " is not finite");
    if (row > 0 && t[row] < t[row - 1]) {
      throw ModelError(entry + " = " + std::to_string(t[row]) + " is before the time of the row " +
                       "above, " + std::to_string(t[row - 1]) + "; times do not decrease");
    }
  }
}

}  // namespace

Trajectory from_states(const Model& model, const VecRef& t, const Eigen::Ref<const MatX>& q,
                       const Eigen::Ref<const MatX>& v_or_p, RowsOf kind, double h) {
  check_times(t);
  check_shape(q, t.size(), model.n_q(), "q");
  check_shape(v_or_p, t.size(), model.n_v(), kind == RowsOf::velocities ? "v" : "p");
  if (!(std::isfinite(h) && h > 0)) {
    throw ModelError("h = " + std::to_string(h) + " s; it is positive and finite");
  }
  Trajectory run = empty_trajectory(model, t.size());
  run.options.h = h;
  run.t = t;
  RunRows rows{run.q, run.v, run.p, run.control, run.work, run.kinetic, run.potential, run.shadow};
  EnergyMeter meter(*model);
  for (Eigen::Index row = 0; row < t.size(); ++row) {
    const std::string of_row = "row " + std::to_string(row) + " of ";
    State state{t[row], model.checked_q(q.row(row).transpose(), of_row + "q"), {}};
    const VecX given = v_or_p.row(row).transpose();
    if (kind == RowsOf::velocities) {
      check_vector(given, model.n_v(), of_row + "v", "velocities");
      state = model.state(state.q, given, state.t);
    } else {
      check_vector(given, model.n_v(), of_row + "p", "velocities");
      state.p = given;
    }
    measure(*model, state, h, meter);
    record(state, meter, row, rows);
    if (kind == RowsOf::velocities) run.v.row(row) = given.transpose();  // not M^-1 M v
  }
  run.complete = true;
  return run;
}

}  // namespace saltus
