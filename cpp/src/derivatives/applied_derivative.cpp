#include "derivatives/applied_derivative.hpp"

#include "derivatives/placed_numbers.hpp"
#include "lagrangian/packed/potentials.hpp"

namespace saltus {
namespace {

/// Where a wrench acts from O, the axes that it is told in, and those of derivatives by it.
struct Place {
  Vec3 P;
  Mat3 R, along;
};

Place place_of(const ModelData& model, const Packed& w, const AppliedWrench& wrench) {
  const int slot = model.packed.slot[static_cast<std::size_t>(wrench.joint)];
  const Mat3 R = rotation_of(w, slot);
  const Vec3 P = position_of(w, slot) + R * wrench.point_J;
  if (!wrench.in_body) return {P, Mat3::Identity(), Mat3::Identity()};
  return {P, R, R * wrench.axes};
}

/// Calls f(joint, move, turn) for the joints above P: what a unit of the velocity moves P by, and
/// turns the body.
template <class F>
void for_each_mover(const ModelData& model, const Packed& w, int joint, const Vec3& P, const F& f) {
  for (int i = joint; i >= 0; i = model.tree.parent[i]) {
    const Vec6 S = six(at(w.S_W, model.packed.slot[i]));
    const double k = model.tree.drive[i].multiplier;
    f(i, Vec3(k * velocity_at(S, P)), Vec3(k * angular(S)));
  }
}

int velocity_of(const ModelData& model, int joint) { return model.tree.drive[joint].velocity; }

/// Columns that a wrench needs: of what a torque does as joints above turn those below it, one for
/// each of these, and three each of a force and of a torque that turn with the body.
Eigen::Index columns_of(const ModelData& model, const AppliedWrench& wrench) {
  Eigen::Index out = 0;
  if (!wrench.torque.isZero(0)) {
    for (int i = wrench.joint; i >= 0; i = model.tree.parent[i]) ++out;
    if (wrench.in_body) out += 3;
  }
  return out + (wrench.in_body && !wrench.force.isZero(0) ? 3 : 0);
}

/// dQ_k = n.(a_j x a_k) dq_j of the joints j that turn k.
void add_turned_axes(const ModelData& model, const Packed& w, int joint, const Vec3& torque,
                     Eigen::Index& column, Packed& to) {
  const Vec3 none = Vec3::Zero();
  for_each_mover(model, w, joint, none, [&](int k, const Vec3&, const Vec3& turn_k) {
    to.coupled(velocity_of(model, k), column) = 1;
    for_each_mover(model, w, k, none, [&](int j, const Vec3&, const Vec3& turn_j) {
      if (j == k || are_of_one_ball(model.tree, j, k)) return;
      to.coupled_q(velocity_of(model, j), column) += torque.dot(turn_j.cross(turn_k));
    });
    ++column;
  });
}

/// dQ = J^T (a_j x f) dq_j of a vector f that turns with the body; J of its point, or of its turn.
void add_turned_vector(const ModelData& model, const Packed& w, int joint, const Vec3& P,
                       const Vec3& f, bool is_force, Eigen::Index& column, Packed& to) {
  for_each_mover(model, w, joint, P, [&](int i, const Vec3& move, const Vec3& turn) {
    const int c = velocity_of(model, i);
    to.coupled.row(c).segment<3>(column) += (is_force ? move : turn).transpose();
    to.coupled_q.row(c).segment<3>(column) += turn.cross(f).transpose();
  });
  column += 3;
}

/// Q.(J_a - J_b)^T n.
double along(const Packed& w, const PackedPoint& a, const Vec3& P_a, const PackedPoint& b,
             const Vec3& P_b, const Vec3& n, const VecX& Q) {
  VecX push = VecX::Zero(Q.size()), size = push;
  add_pull(w, a, P_a, n, push, size);
  add_pull(w, b, P_b, -n, push, size);
  return push.dot(Q);
}

}  // namespace

void add_push(const ModelData& model, const Packed& w, const AppliedWrench& wrench,
              const Vec3& force, const Vec3& torque, VecX& Q) {
  if (wrench.joint < 0) return;
  const Place at = place_of(model, w, wrench);
  for_each_mover(model, w, wrench.joint, at.P, [&](int i, const Vec3& move, const Vec3& turn) {
    Q[velocity_of(model, i)] += move.dot(at.along * force) + turn.dot(at.along * torque);
  });
}

PulledWrench pull_push(const ModelData& model, const Packed& w, const AppliedWrench& wrench,
                       const VecX& Q) {
  PulledWrench out{Vec3::Zero(), Vec3::Zero()};
  if (wrench.joint < 0) return out;
  const Place at = place_of(model, w, wrench);
  for_each_mover(model, w, wrench.joint, at.P, [&](int i, const Vec3& move, const Vec3& turn) {
    out.force += Q[velocity_of(model, i)] * move;
    out.torque += Q[velocity_of(model, i)] * turn;
  });
  return {at.along.transpose() * out.force, at.along.transpose() * out.torque};
}

void add_wrench_slopes(const ModelData& model, const std::vector<AppliedWrench>& wrenches,
                       Eigen::Index own, Packed& w) {
  Eigen::Index column = own, columns = own;
  for (const AppliedWrench& each : wrenches) columns += columns_of(model, each);
  if (columns == w.coupled.cols() && columns == own) return;
  for (MatX* each : {&w.coupled, &w.coupled_q, &w.coupled_v}) {
    each->conservativeResize(model.tree.n_v, columns);
    each->rightCols(columns - own).setZero();
  }
  for (const AppliedWrench& each : wrenches) {
    if (each.joint < 0 || columns_of(model, each) == 0) continue;
    const Place at = place_of(model, w, each);
    const Vec3 force = at.R * each.force, torque = at.R * each.torque;
    if (!torque.isZero(0)) {
      add_turned_axes(model, w, each.joint, torque, column, w);
      if (each.in_body) {
        add_turned_vector(model, w, each.joint, at.P, torque, false, column, w);
      }
    }
    if (!each.in_body || force.isZero(0)) continue;
    add_turned_vector(model, w, each.joint, at.P, force, true, column, w);
    // what the point's own motion does, as of a force in the world's axes (packed_point.hpp)
    for_each_mover(model, w, each.joint, at.P, [&](int i, const Vec3&, const Vec3&) {
      const int slot = model.packed.slot[i];
      const Vec3 G = velocity_at(six(saltus::at(w.S_W, slot)), at.P).cross(force);
      double* to = saltus::at(w.U_F_G, slot) + 12 * lanes;
      for (int c = 0; c < 3; ++c) to[c * lanes] += G[c];
    });
  }
}

void add_spring_gradient(const ModelData& model, const ArcDerivative& arc, const VecX& Q,
                         ParameterGradient& to) {
  const Packed& w = arc.s.w;
  const auto& springs = model.mass.potentials.springs;
  for (std::size_t k = 0; k < springs.size(); ++k) {
    const PackedSpring& s = model.packed.potentials->springs[k];
    const Packed::PlacedSpring& x = w.springs[k];
    if (!(x.d > 0)) continue;  // of length 0 it pulls nothing there; others have no step there
    const double push = along(w, s.a, x.P_a, s.b, x.P_b, x.r / x.d, Q);
    const auto row = static_cast<Eigen::Index>(k);
    to.springs(row, 0) -= (x.d - springs[k].length) * push;
    to.springs(row, 1) += springs[k].stiffness * push;
  }
  for (std::size_t k = 0; k < arc.s.dampers.size(); ++k) {
    const PlacedDamper& x = arc.s.dampers[k];
    const double push = along(w, x.a, x.P_a, x.b, x.P_b, x.n, Q);
    to.dampers[static_cast<Eigen::Index>(k)] -= x.n.dot(x.r_rate) * push;
  }
}

}  // namespace saltus
