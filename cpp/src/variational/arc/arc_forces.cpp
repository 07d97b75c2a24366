#include "variational/arc/arc_forces.hpp"

namespace saltus {
namespace {

/// A wrench in the world's axes, and where it acts from the tree's reference point O.
struct PlacedWrench {
  Vec3 r, force, torque;
};

PlacedWrench place_wrench(const ModelData& model, const AppliedWrench& wrench, const Packed& w) {
  const int slot = model.packed.slot[wrench.joint];
  Mat3 R;
  for (int c = 0; c < 3; ++c) R.col(c) = three(at(w.R, slot) + 3 * c * lanes);
  const Vec3 r = three(at(w.p, slot)) + R * wrench.point_J;
  if (!wrench.in_body) return {r, wrench.force, wrench.torque};
  return {r, R * wrench.force, R * wrench.torque};
}

void add_wrench(const ModelData& model, const AppliedWrench& wrench, ArcScratch& s) {
  const PlacedWrench placed = place_wrench(model, wrench, s.w);
  const Tree& tree = model.tree;
  for (int i = wrench.joint; i >= 0; i = tree.parent[i]) {
    const double* S = at(s.w.S_W, model.packed.slot[i]);
    const Vec3 turn = three(S), move = three(S + 3 * lanes) + turn.cross(placed.r);
    const Drive& drive = tree.drive[i];
    const double push = move.dot(placed.force) + turn.dot(placed.torque);
    s.wrench_force[drive.velocity] += drive.multiplier * push;
    const double size = move.cwiseAbs().dot(placed.force.cwiseAbs()) +
                        turn.cwiseAbs().dot(placed.torque.cwiseAbs());
    s.forces.size[drive.velocity] += std::abs(drive.multiplier) * size;
  }
}

}  // namespace

void prepare_forces(const ModelData& model, ArcScratch& s) {
  s.forces = ForceValues(model.forces, model.tree.n_v);
  s.wrench_force.setZero(model.tree.n_v);
  s.has_forces = model.forces.acts();
  if (!s.has_forces) return;
  s.w.slope.resize(static_cast<std::size_t>(model.packed.slots / lanes));
  s.dampers = pack_dampers(model);
  s.point_pull.setZero(model.tree.n_v);
  const Eigen::Index own = model.packed.columns, geared = s.forces.coupled.cols();
  for (MatX* each : {&s.w.coupled, &s.w.coupled_q, &s.w.coupled_v}) {
    each->setZero(model.tree.n_v, own + geared + model.forces.n_columns());
  }
  s.w.coupled.middleCols(own, geared) = s.forces.coupled;
  Eigen::Index column = own + geared + static_cast<Eigen::Index>(3 * s.dampers.size());
  for (const FunctionForce& each : model.forces.functions) {
    for (const int c : each.velocities) s.w.coupled(c, column++) = 1;
  }
}

namespace {

/// Slopes of actuators over several coordinates, along their columns.
void set_geared_slopes(const ModelData& model, ArcScratch& s) {
  const Eigen::Index own = model.packed.columns;
  for (Eigen::Index r = 0; r < s.forces.coupled.cols(); ++r) {
    s.w.coupled_q.col(own + r) = s.forces.slope[2 * r] * s.forces.coupled.col(r);
    s.w.coupled_v.col(own + r) = s.forces.slope[2 * r + 1] * s.forces.coupled.col(r);
  }
}

void add_dampers(const ModelData& model, ArcScratch& s) {
  if (s.dampers.empty()) return;
  if (model.forces.damping.size() == 0) s.forces.damping.setZero();
  s.point_pull.setZero();
  for (PlacedDamper& each : s.dampers) add_damper(s.w, each, s.point_pull, s.forces.size);
  s.forces.damping += s.point_pull;
  s.forces.Q += s.point_pull;
}

}  // namespace

void add_forces(const ModelData& model, double t, const VecX& v, ArcScratch& s) {
  static const ForceInput nothing;
  const ForceInput& input = s.input != nullptr ? *s.input : nothing;
  set_forces(model.forces, s.q, v, input, s.forces);
  s.wrench_force.setZero();
  for (const AppliedWrench& wrench : input.wrenches) add_wrench(model, wrench, s);
  s.forces.Q += s.wrench_force;
  add_dampers(model, s);
  add_functions(model.forces, {t, s.q, v}, s.forces);
  for (int c = 0; c < model.tree.n_v; ++c) {
    const int slot = model.packed.slot_of_velocity[c];
    at(s.w.first, slot)[lanes] += s.forces.Q[c];
    if (s.w.slope.empty()) continue;
    double* slope = at(s.w.slope, slot);
    slope[0] = s.forces.Q_q[c];
    slope[lanes] = s.forces.Q_v[c];
    if (s.shift.size() > 0) slope[lanes] -= s.shift[c] * model.forces.damping[c];
  }
  set_geared_slopes(model, s);
}

namespace {

/// Of functions, whose columns are one for each coordinate that they push.
void set_function_slopes(const ModelData& model, Eigen::Index column, ArcScratch& s) {
  for (std::size_t k = 0; k < s.forces.answers.size(); ++k) {
    const ForceAnswer& answer = s.forces.answers[k];
    const auto m = static_cast<Eigen::Index>(model.forces.functions[k].velocities.size());
    const auto take = [&](const MatX& from, MatX& to) {
      if (from.size() > 0) {
        to.middleCols(column, m) = from.transpose();
      } else {
        to.middleCols(column, m).setZero();
      }
    };
    take(answer.Q_q, s.w.coupled_q);
    take(answer.Q_v, s.w.coupled_v);
    column += m;
  }
}

}  // namespace

void add_force_partials(const ModelData& model, ArcScratch& s) {
  Eigen::Index column = model.packed.columns + s.forces.coupled.cols();
  for (const PlacedDamper& each : s.dampers) {
    add_damper_partials(each, column, s.w);
    column += 3;
  }
  set_function_slopes(model, column, s);
  add_wrench_partials(model, s);
}

void add_wrench_partials(const ModelData& model, ArcScratch& s) {
  if (s.input == nullptr) return;
  for (const AppliedWrench& wrench : s.input->wrenches) {
    if (wrench.in_body) continue;
    const PlacedWrench placed = place_wrench(model, wrench, s.w);
    for (int i = wrench.joint; i >= 0; i = model.tree.parent[i]) {
      const int slot = model.packed.slot[i];
      const double* S = at(s.w.S_W, slot);
      const Vec3 turn = three(S), move = three(S + 3 * lanes) + turn.cross(placed.r);
      const Vec3 G = move.cross(placed.force);
      double* to = at(s.w.U_F_G, slot) + 12 * lanes;
      for (int c = 0; c < 3; ++c) to[c * lanes] += G[c];
    }
  }
}

}  // namespace saltus
