// Starts into a batch, single runs out of it.
#include <cmath>
#include <sstream>

#include "rollout/batch_storage.hpp"

namespace saltus {
namespace {

std::vector<std::string> coordinate_names(const Model& model) {
  std::vector<std::string> names;
  for (const Coordinate& each : model->coordinates) names.push_back(each.name);
  return names;
}

void check_array(const std::vector<std::string>& names, const std::string& unit,
                 const Eigen::Ref<const MatX>& x, const std::string& what) {
  std::ostringstream text;
  if (x.cols() != static_cast<Eigen::Index>(names.size())) {
    text << what << " has shape (" << x.rows() << ", " << x.cols()
         << "); it must have a column for each of the " << names.size() << " " << unit;
    throw ModelError(text.str());
  }
  for (Eigen::Index row = 0; row < x.rows(); ++row) {
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      if (std::isfinite(x(row, i))) continue;
      text << what << "[" << row << ", \"" << names[i] << "\"] = " << x(row, i) << " is not finite";
      throw ModelError(text.str());
    }
  }
}

/// Names the coordinate, as check_vector cannot.
void check_start(const std::vector<std::string>& names, const std::string& unit, const VecX& x,
                 const std::string& what) {
  const auto n = static_cast<Eigen::Index>(names.size());
  for (Eigen::Index i = 0; i < x.size() && x.size() == n; ++i) {
    if (std::isfinite(x[i])) continue;
    std::ostringstream text;
    text << what << "[\"" << names[i] << "\"] = " << x[i] << " is not finite";
    throw ModelError(text.str());
  }
  check_vector(x, static_cast<int>(n), what, unit);
}

}  // namespace

std::vector<State> states(const Model& model, const Eigen::Ref<const MatX>& q,
                          const Eigen::Ref<const MatX>& v, double t) {
  check_array(coordinate_names(model), "coordinates", q, "q");
  check_array(model->velocity_names, "velocities", v, "v");
  if (q.rows() != v.rows()) {
    throw ModelError("q has " + counted(q.rows(), "row") + " and v has " +
                     std::to_string(v.rows()) + "; a row is a run");
  }
  std::vector<State> out;
  out.reserve(static_cast<std::size_t>(q.rows()));
  for (Eigen::Index i = 0; i < q.rows(); ++i) {
    out.push_back(model.state(VecX(q.row(i)), VecX(v.row(i)), t));
  }
  return out;
}

void check_starts(const Model& model, std::span<const State> starts) {
  if (starts.empty()) throw ModelError("no starts; a batch has at least one run");
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const std::string name = "states[" + std::to_string(i) + "]";
    check_start(coordinate_names(model), "coordinates", starts[i].q, name + ".q");
    check_start(model->velocity_names, "velocities", starts[i].p, name + ".p");
    model.checked_q(starts[i].q, name + ".q");
    std::ostringstream text;
    if (!std::isfinite(starts[i].t)) {
      text << name << ".t = " << starts[i].t << " is not finite";
    } else if (starts[i].t != starts[0].t) {
      text << name << ".t = " << starts[i].t << " s, and states[0].t = " << starts[0].t
           << " s; the runs of a batch start at the same time";
    }
    if (!text.str().empty()) throw ModelError(text.str());
  }
}

BatchTrajectory empty_batch(const Model& model, const Plan& plan, std::span<const State> starts) {
  const auto runs = static_cast<Eigen::Index>(starts.size());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  BatchTrajectory out{.model = model, .options = plan.step, .t = row_times(plan, starts[0].t)};
  out.q.setConstant(runs * plan.rows, model.n_q(), nan);
  for (MatX* x : {&out.v, &out.p}) x->setConstant(runs * plan.rows, model.n_v(), nan);
  out.control.setConstant(runs * plan.rows, model->forces.n_u(), nan);
  out.work.setConstant(runs * plan.rows, model->forces.n_u() + 3, nan);
  for (MatX* x : {&out.kinetic, &out.potential, &out.shadow}) x->setConstant(runs, plan.rows, nan);
  out.outcome.resize(starts.size());
  for (RunOutcome& each : out.outcome) {
    if (plan.record_contacts) each.contacts.emplace();
  }
  for (Eigen::Index i = 0; i < runs; ++i) {
    out.q.row(i * plan.rows) = starts[i].q;
    out.p.row(i * plan.rows) = starts[i].p;
  }
  return out;
}

RunRows rows_of(BatchTrajectory& batch, Eigen::Index i) {
  const Eigen::Index rows = batch.t.size();
  const auto energies = [&](MatX& x) { return Eigen::Map<VecX>(x.data() + i * rows, rows); };
  const auto own = [&](MatX& x) { return x.middleRows(i * rows, rows); };
  return {own(batch.q),
          own(batch.v),
          own(batch.p),
          own(batch.control),
          own(batch.work),
          energies(batch.kinetic),
          energies(batch.potential),
          energies(batch.shadow)};
}

Trajectory BatchTrajectory::run(int i) const {
  if (i < 0 || i >= runs()) {
    throw ModelError("no run " + std::to_string(i) + "; the batch has " + std::to_string(runs()));
  }
  const RunOutcome& own = outcome[i];
  const Eigen::Index first = i * t.size(), rows = own.rows;
  Trajectory out = empty_trajectory(model, 0);
  out.options = options;
  out.t = t.head(rows);
  out.q = q.middleRows(first, rows);
  out.v = v.middleRows(first, rows);
  out.p = p.middleRows(first, rows);
  out.control = control.middleRows(first, rows);
  out.work = work.middleRows(first, rows);
  out.kinetic = kinetic.row(i).head(rows);
  out.potential = potential.row(i).head(rows);
  out.shadow = shadow.row(i).head(rows);
  take_outcome(RunOutcome(own), out);
  return out;
}

VecX BatchTrajectory::energy_error() const {
  VecX out(runs());
  for (int i = 0; i < runs(); ++i) {
    const Eigen::Index rows = outcome[i].rows;
    out[i] =
        saltus::energy_error(VecX(kinetic.row(i).head(rows)), VecX(potential.row(i).head(rows)),
                             work.middleRows(i * t.size(), rows));
  }
  return out;
}

std::map<int, std::string> BatchTrajectory::failures() const {
  std::map<int, std::string> out;
  for (int i = 0; i < runs(); ++i) {
    if (!outcome[i].failure.empty()) out[i] = outcome[i].failure;
  }
  return out;
}

}  // namespace saltus
