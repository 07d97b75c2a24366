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

/// Axes of a joint's parent.
Mat3 rotation_above(const Tree& tree, const Kinematics& kin, int joint) {
  const int parent = tree.parent[joint];
  return parent < 0 ? Mat3(Mat3::Identity()) : kin.joint[parent].R;
}

void set_stop(const ModelData& model, const Pair& pair, FrameDerivative& out) {
  const Drive& drive = model.tree.drive[pair.on_a.joint];
  set_joint_frame(model, drive.velocity, out);
  out.row[0] *= pair.stop.side * drive.multiplier;
}

/// A frame at a configuration, and how it goes with its gap.
struct Frame {
  Gap gap;
  GapMotion motion;
  PlacedRows at;
};

Frame frame_at(const ModelData& model, const Kinematics& kin, const Pair& pair,
               const FrameChoice& choice) {
  const Gap gap = pair_gap(model.tree, kin, pair);
  return {gap, gap_motion(gap), place_rows(model, kin, pair, gap, choice)};
}

/// What a unit of a screw makes of it: at P and at the gap's center it moves by xi and `center`.
struct FrameChange {
  std::array<Vec3, 3> d;
  Vec3 P;
};

FrameChange change_of(const Frame& frame, const FrameChoice& choice, double sign, const Vec3& w,
                      const Vec3& xi, const Vec3& center) {
  Vec6 t;
  t << sign * w, sign * center;
  const bool moves_b = sign < 0;
  const PlacedRows& at = frame.at;
  FrameChange out;
  out.d[0] = frame.motion.n * t;
  if (moves_b) out.d[0] += w.cross(frame.gap.n_W);
  out.P = choice.at_a ? Vec3(frame.motion.p_WA * t)
                      : Vec3((frame.motion.p_WA + frame.motion.p_WB) * t / 2);
  if (moves_b) out.P += xi;
  if (choice.axis >= 0) {
    const Tangents change = turned({at.d[1], at.d[2]}, frame.gap.n_W, choice.axis, out.d[0]);
    out.d[1] = change.t0;
    out.d[2] = change.t1;
  } else {
    for (int i = 1; i < 3; ++i) out.d[i] = moves_b ? Vec3(w.cross(at.d[i])) : Vec3(Vec3::Zero());
  }
  return out;
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
  const Frame frame = frame_at(model, kin, pair, choice);
  const PlacedRows& at = frame.at;
  for (const ChainJoint& joint_j : pair.chain) {
    const Screw j = screw_at(tree, kin, joint_j.joint, at.P);
    const Screw center = screw_at(tree, kin, joint_j.joint, frame.gap.center_W);
    const FrameChange by_j = change_of(frame, choice, joint_j.sign, j.w, j.xi, center.xi);
    const Drive& drive_j = tree.drive[joint_j.joint];
    for (const ChainJoint& joint_k : pair.chain) {
      const Screw k = screw_at(tree, kin, joint_k.joint, at.P);
      Vec3 change = k.w.cross(by_j.P);
      if (turns_below(tree, joint_j.joint, joint_k.joint)) {
        change += j.w.cross(k.xi) - k.w.cross(j.xi);
      }
      const Drive& drive_k = tree.drive[joint_k.joint];
      const double by = drive_j.multiplier * drive_k.multiplier * joint_k.sign;
      for (int i = 0; i < 3; ++i) {
        out.H[i](index(drive_k), index(drive_j)) +=
            by * (by_j.d[i].dot(k.xi) + at.d[i].dot(change));
      }
    }
    for (int i = 0; i < 3; ++i) {
      out.row[i][drive_j.velocity] += drive_j.multiplier * joint_j.sign * at.d[i].dot(j.xi);
    }
  }
}

void add_row_placements(const ModelData& model, const Kinematics& kin, const Pair& pair,
                        const FrameChoice& choice, const RowCovectors& hat, MatX& to) {
  if (pair.is_stop()) return;
  const Tree& tree = model.tree;
  const Frame frame = frame_at(model, kin, pair, choice);
  const PlacedRows& at = frame.at;
  for (const ChainJoint& joint_j : pair.chain) {
    const Mat3 R = rotation_above(tree, kin, joint_j.joint);
    for (int c = 0; c < 3; ++c) {
      const Vec3 e = R.col(c);
      const FrameChange by_j = change_of(frame, choice, joint_j.sign, Vec3::Zero(), e, e);
      double sum = 0;
      for (int i = 0; i < 3; ++i) sum += joint_j.sign * hat.motion[i] * at.d[i].dot(e);
      for (const ChainJoint& joint_k : pair.chain) {
        const Screw k = screw_at(tree, kin, joint_k.joint, at.P);
        Vec3 change = k.w.cross(by_j.P);
        if (tree.is_ancestor(joint_j.joint, joint_k.joint)) change -= k.w.cross(e);
        const Drive& drive = tree.drive[joint_k.joint];
        for (int i = 0; i < 3; ++i) {
          if (hat.row[i].size() == 0) continue;
          sum += hat.row[i][drive.velocity] * drive.multiplier * joint_k.sign *
                 (by_j.d[i].dot(k.xi) + at.d[i].dot(change));
        }
      }
      to(joint_j.joint, c) += sum;
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
