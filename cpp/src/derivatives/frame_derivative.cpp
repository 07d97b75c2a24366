#include "derivatives/frame_derivative.hpp"

#include <algorithm>

#include "derivatives/selected.hpp"
#include "saltus/collision/gap_motion.hpp"

namespace saltus {
namespace {

/// Where a contact's rows act, and along what.
struct PlacedRows {
  Vec3 P;
  std::array<Vec3, 3> d;  ///< n, t0, t1
};

PlacedRows place_rows(const ModelData& model, const Kinematics& kin, const Pair& pair,
                      const Gap& gap, const FrameChoice& choice) {
  PlacedRows out;
  out.P = contact_point(gap);
  if (choice.at_a) out.P = gap.p_WA;
  out.d[0] = gap.n_W;
  if (choice.axis >= 0) {
    const Tangents t = tangents(gap.n_W, choice.axis);
    out.d[1] = t.t0;
    out.d[2] = t.t1;
  } else {
    const Mat3 R = kin.X_WJ(model.tree, pair.on_b.joint).R;
    for (int k = 0; k < 2; ++k) out.d[k + 1] = R * choice.t_B[k];
  }
  return out;
}

bool turns_below(const Tree& tree, int j, int k) {
  return j != k && tree.is_ancestor(j, k) && !are_of_one_ball(tree, j, k);
}

void set_stop(const ModelData& model, const Pair& pair, FrameDerivative& out) {
  const Drive& drive = model.tree.drive[pair.on_a.joint];
  set_joint_frame(model, drive.velocity, out);
  out.row[0] *= pair.stop.side * drive.multiplier;
}

}  // namespace

void set_frame(const ModelData& model, const Kinematics& kin, const Pair& pair,
               const FrameChoice& choice, FrameDerivative& out) {
  const Tree& tree = model.tree;
  for (VecX& each : out.row) each.setZero(tree.n_v);
  if (pair.is_stop()) return set_stop(model, pair, out);
  list_velocities(tree, pair, out.velocities);
  const auto n = static_cast<Eigen::Index>(out.velocities.size());
  for (MatX& each : out.H) each.setZero(n, n);
  const auto index = [&](const Drive& drive) {
    return std::lower_bound(out.velocities.begin(), out.velocities.end(), drive.velocity) -
           out.velocities.begin();
  };
  const Gap gap = pair_gap(tree, kin, pair);
  const GapMotion motion = gap_motion(gap);
  const PlacedRows at = place_rows(model, kin, pair, gap, choice);
  for (const ChainJoint& joint_j : pair.chain) {
    const Screw j = screw_at(tree, kin, joint_j.joint, at.P);
    const Screw center = screw_at(tree, kin, joint_j.joint, gap.center_W);
    Vec6 t;
    t << joint_j.sign * j.w, joint_j.sign * center.xi;
    const bool moves_b = joint_j.sign < 0;
    std::array<Vec3, 3> d;
    d[0] = motion.n * t;
    if (moves_b) d[0] += j.w.cross(gap.n_W);
    Vec3 dP = choice.at_a ? Vec3(motion.p_WA * t) : Vec3((motion.p_WA + motion.p_WB) * t / 2);
    if (moves_b) dP += j.xi;
    if (choice.axis >= 0) {
      const Tangents change = turned({at.d[1], at.d[2]}, gap.n_W, choice.axis, d[0]);
      d[1] = change.t0;
      d[2] = change.t1;
    } else {
      for (int i = 1; i < 3; ++i) d[i] = moves_b ? Vec3(j.w.cross(at.d[i])) : Vec3(Vec3::Zero());
    }
    const Drive& drive_j = tree.drive[joint_j.joint];
    for (const ChainJoint& joint_k : pair.chain) {
      const Screw k = screw_at(tree, kin, joint_k.joint, at.P);
      Vec3 change = k.w.cross(dP);
      if (turns_below(tree, joint_j.joint, joint_k.joint)) {
        change += j.w.cross(k.xi) - k.w.cross(j.xi);
      }
      const Drive& drive_k = tree.drive[joint_k.joint];
      const double by = drive_j.multiplier * drive_k.multiplier * joint_k.sign;
      for (int i = 0; i < 3; ++i) {
        out.H[i](index(drive_k), index(drive_j)) += by * (d[i].dot(k.xi) + at.d[i].dot(change));
      }
    }
    for (int i = 0; i < 3; ++i) {
      out.row[i][drive_j.velocity] += drive_j.multiplier * joint_j.sign * at.d[i].dot(j.xi);
    }
  }
}

void set_joint_frame(const ModelData& model, int velocity, FrameDerivative& out) {
  for (VecX& each : out.row) each.setZero(model.tree.n_v);
  out.velocities.assign(1, velocity);
  for (MatX& each : out.H) each.setZero(1, 1);
  out.row[0][velocity] = 1;
}

void add_row_change(const FrameDerivative& frame, int i, const VecX& dq, double factor, VecX& to) {
  add_selected(frame.H[i], frame.velocities, dq, factor, to);
}

void add_row_covector(const FrameDerivative& frame, int i, const VecX& row_hat, double factor,
                      VecX& q) {
  add_selected(frame.H[i].transpose(), frame.velocities, row_hat, factor, q);
}

}  // namespace saltus
