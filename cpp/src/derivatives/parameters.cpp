#include "derivatives/parameters.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "derivatives/applied_derivative.hpp"
#include "derivatives/placed_numbers.hpp"

namespace saltus {
namespace {

using Ten = Eigen::Matrix<double, 10, 1>;

Ten contract(const Vec6& V, const Vec6& dV, const Vec6& turn, const Vec3& g) {
  const Vec3 w = V.head<3>(), v = V.tail<3>(), dw = dV.head<3>(), dv = dV.tail<3>();
  Ten out;
  out[0] = v.dot(dv) + g.dot(turn.tail<3>());
  out.segment<3>(1) = dv.cross(w) + v.cross(dw) + g.cross(turn.head<3>());
  out.tail<6>() << w.x() * dw.x(), w.x() * dw.y() + w.y() * dw.x(), w.x() * dw.z() + w.z() * dw.x(),
      w.y() * dw.y(), w.y() * dw.z() + w.z() * dw.y(), w.z() * dw.z();
  return out;
}

/// A covector of the ten parameters about a joint's origin as one of those about a link's, whose
/// frame is placed by X. With h' = R h the parameters are m, h' + m p and
/// R I R^T + m (p.p 1 - p p^T) + 2 h'.p 1 - h' p^T - p h'^T.
Ten of_link(const Ten& of_joint, const Pose& X) {
  const auto at = [&](int k) { return of_joint[k]; };
  Mat3 G;  // the covector of I, of which off the diagonal each number stands for two
  G << at(4), at(5) / 2, at(6) / 2, at(5) / 2, at(7), at(8) / 2, at(6) / 2, at(8) / 2, at(9);
  const Vec3 p = X.p, Gp = G * p, of_h = of_joint.segment<3>(1) + 2 * (G.trace() * p - Gp);
  const Mat3 I = X.R.transpose() * G * X.R;
  Ten out;
  out[0] = at(0) + of_joint.segment<3>(1).dot(p) + G.trace() * p.dot(p) - p.dot(Gp);
  out.segment<3>(1) = X.R.transpose() * of_h;
  out.tail<6>() << I(0, 0), 2 * I(0, 1), 2 * I(0, 2), I(1, 1), 2 * I(1, 2), I(2, 2);
  return out;
}

void add_own_gradient(const ModelData& model, const Packed& w, const VecX& x, const VecX& y,
                      double factor, ParameterGradient& to) {
  for (int c = 0; c < model.tree.n_v; ++c) {
    const int slot = model.packed.slot_of_velocity[static_cast<std::size_t>(c)];
    to.armature[c] += factor * y[c] * *at(w.s_dot, slot);
    const double* own = model.packed.own.empty() ? nullptr : at(model.packed.own, slot);
    const double stiffness = own ? own[lanes] : 0, rest = own ? own[2 * lanes] : 0;
    to.stiffness[c] -= factor * x[c] * (*at(w.s, slot) - rest);
    to.rest[c] += factor * x[c] * stiffness;
  }
}

/// The actuator pushes all that it can, or its joint bears: nothing of its own changes that.
bool is_limited(const ForceModel& forces, const ForceValues& at, int k) {
  const Actuator& a = forces.actuators[static_cast<std::size_t>(k)];
  if (std::abs(at.effort[k]) >= a.effort) return true;
  const int c = a.gears.front().velocity;
  return a.is_single() && forces.effort.size() > 0 && std::abs(at.single[c]) >= forces.effort[c];
}

void add_actuators(const ForceModel& forces, const ArcDerivative& arc, const VecX& Q,
                   ParameterGradient& to) {
  for (int k = 0; k < forces.n_u(); ++k) {
    if (is_limited(forces, arc.s.forces, k)) continue;
    const Actuator& a = forces.actuators[static_cast<std::size_t>(k)];
    const VecX& control = arc.s.input->control;
    const double u = std::clamp(control.size() > 0 ? control[k] : 0, a.lower, a.upper);
    double push = 0, l = 0, rate = 0;
    for (const Gear& gear : a.gears) {
      push += gear.ratio * Q[gear.velocity];
      l += gear.ratio * arc.s.q[gear.coordinate];
      rate += gear.ratio * arc.v[gear.velocity];
    }
    to.actuators.row(k) += push * Eigen::RowVector4d(u, 1, l, rate);
  }
}

}  // namespace

void ParameterGradient::start(const ModelData& model) {
  body.setZero(model.tree.joints(), 10);
  for (VecX* each : {&stiffness, &rest, &damping, &armature}) each->setZero(model.tree.n_v);
  actuators.setZero(model.forces.n_u(), 4);
  springs.setZero(static_cast<Eigen::Index>(model.mass.potentials.springs.size()), 2);
  dampers.setZero(static_cast<Eigen::Index>(model.forces.dampers.size()));
  restitution.clear();
  for (auto* each : {&twist, &turn}) each->resize(static_cast<std::size_t>(model.tree.joints()));
  placement.start(model);
}

void add_gradient(const ModelData& model, const Packed& w, const VecX& x, const VecX& y,
                  double factor, ParameterGradient& to) {
  const Tree& tree = model.tree;
  for (int i = 0; i < tree.joints(); ++i) {
    const int slot = model.packed.slot[i], parent = tree.parent[i];
    const double* S_W = at(w.S_W, slot);
    const Vec6 S = six(S_W), W = six(S_W + 6 * lanes), V = six(at(w.V, slot));
    const Drive& drive = tree.drive[i];
    const double x_i = drive.multiplier * x[drive.velocity];
    const double y_i = drive.multiplier * y[drive.velocity];
    Vec6 &twist = to.twist[i], &turn = to.turn[i];
    twist = y_i * S + x_i * W;
    turn = x_i * S;
    if (parent >= 0) {
      twist += to.twist[parent];
      turn += to.turn[parent];
    }
    const Mat3 R = rotation_of(w, slot);
    const Vec3 p = position_of(w, slot), g = R.transpose() * model.mass.gravity;
    const Vec6 own = in_joint(R, p, V), change = in_joint(R, p, twist);
    to.body.row(i) += factor * contract(own, change, in_joint(R, p, turn), g).transpose();
    set_body(model.mass.body[i], model.mass.gravity, R, own, change, turn, twist,
             to.placement.body[i]);
  }
  add_own_gradient(model, w, x, y, factor, to);
}

void add_node_gradient(const ModelData& model, const Packed& w, const VecX& y, double factor,
                       ParameterGradient& to) {
  const VecX none = VecX::Zero(model.tree.n_v);
  add_gradient(model, w, none, y, factor, to);
  add_placements(model, w, factor, to.placement);
}

void add_arc_gradient(const ModelData& model, const ArcDerivative& arc, const VecX& Q,
                      ParameterGradient& to) {
  add_gradient(model, arc.s.w, Q, arc.of_L_v, 1, to);
  to.damping -= arc.v.cwiseProduct(Q);
  add_actuators(model.forces, arc, Q, to);
  add_spring_gradient(model, arc, Q, to);
  add_point_forces(model, arc, to.placement);
  add_placements(model, arc.s.w, 1, to.placement);
  if (arc.s.shift.size() == 0) return;
  // stiff damping opens the arc with more: tau/2 shift d v, of joints of one degree
  to.damping += arc.tau / 2 * arc.s.shift.cwiseProduct(arc.v).cwiseProduct(arc.of_L_v);
}

MatX by_link(const ModelData& model, const ParameterGradient& gradient) {
  MatX out = MatX::Zero(static_cast<Eigen::Index>(model.links.size()), 10);
  for (const Link& link : model.links) {
    if (link.joint < 0) continue;
    out.row(link.index) = of_link(gradient.body.row(link.joint).transpose(), link.X_JL).transpose();
  }
  return out;
}

std::vector<PairGradient> by_pair(const ParameterGradient& gradient, const Rubbing& friction) {
  std::map<int, PairGradient> all;
  const auto of = [&](int pair) -> PairGradient& {
    return all.try_emplace(pair, PairGradient{pair, 0, 0}).first->second;
  };
  for (const auto& [pair, by_e] : gradient.restitution) of(pair).restitution += by_e;
  for (const int pair : friction.pairs) of(pair).friction += friction.of(pair);
  std::vector<PairGradient> out;
  for (const auto& each : all) out.push_back(each.second);
  return out;
}

}  // namespace saltus
