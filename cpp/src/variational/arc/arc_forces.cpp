#include "variational/arc/arc_forces.hpp"

namespace saltus {
namespace {

/// A wrench in the world's axes, and where it acts from the tree's reference point O.
struct PlacedWrench {
  Vec3 r, force, torque;
};

Eigen::Map<const Vec3, 0, Eigen::InnerStride<lanes>> three(const double* x) {
  return Eigen::Map<const Vec3, 0, Eigen::InnerStride<lanes>>(x);
}

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
  s.w.coupled = s.forces.coupled;
  s.w.coupled_slope = s.forces.slope;
}

void add_forces(const ModelData& model, const VecX& v, ArcScratch& s) {
  static const ForceInput nothing;
  const ForceInput& input = s.input != nullptr ? *s.input : nothing;
  set_forces(model.forces, s.q, v, input, s.forces);
  s.wrench_force.setZero();
  for (const AppliedWrench& wrench : input.wrenches) add_wrench(model, wrench, s);
  s.forces.Q += s.wrench_force;
  for (int c = 0; c < model.tree.n_v; ++c) {
    const int slot = model.packed.slot_of_velocity[c];
    at(s.w.first, slot)[lanes] += s.forces.Q[c];
    if (s.w.slope.empty()) continue;
    double* slope = at(s.w.slope, slot);
    slope[0] = s.forces.Q_q[c];
    slope[lanes] = s.forces.Q_v[c];
  }
  if (s.w.coupled.cols() > 0) s.w.coupled_slope = s.forces.slope;
}

void add_ball_forces(const ModelData& model, double tau, const VecX& v, ArcScratch& s) {
  for (const PackedBall& ball : model.packed.balls) {
    const Vec3 Q = s.forces.Q.segment<3>(ball.velocity);
    if (Q.isZero(0)) continue;
    const double c2 = at(s.w.ball_arc, ball.slot[2])[lanes];
    const Vec3 f = tau * v.segment<3>(ball.velocity), more = tau / 2 * c2 * f.cross(Q);
    for (int axis = 0; axis < 3; ++axis) {
      double* arc = at(s.w.arc, ball.slot[axis]);
      arc[0] += more[axis];
      arc[lanes] += Q[axis];
    }
  }
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
