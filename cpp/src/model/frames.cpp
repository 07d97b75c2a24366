#include "saltus/model/frames.hpp"

#include <cmath>

#include "saltus/lagrangian/packed_point.hpp"
#include "saltus/tree/coordinates.hpp"

namespace saltus {
Frames::Frames(const Model& model) : Frames(model, model.neutral()) {}

Frames::Frames(const Model& model, const VecRef& q)
    : model_(model), w_(model->packed), forces_(model->packed), zero_(VecX::Zero(model.n_v())) {
  if (model->equalities.rows > 0) loops_.emplace(*model);
  set(q);
}

namespace {

/// Nothing is to be said of this q, and nothing to be made of it.
bool is_good(const Tree& tree, const VecRef& q) {
  if (q.size() != tree.n_q || !q.allFinite()) return false;
  for (const Ball& ball : tree.balls) {
    if (std::abs(q.segment<4>(ball.coordinate).squaredNorm() - 1) > 1e-15) return false;
  }
  return true;
}

}  // namespace

void Frames::set(const VecRef& q, const std::string& what) {
  if (is_good(model_->tree, q)) {
    q_ = q;  // does not allocate
  } else {
    q_ = model_.checked_q(q, what);
  }
  set_coordinates(model_->tree, model_->packed, q_, w_);
  place(model_->packed, w_);
  summed_ = false;
}

Vec3 Frames::origin(int tree) const {
  const PackedPlace& at_tree = model_->packed.trees[static_cast<std::size_t>(tree)];
  const PackedGroup& g = model_->packed.groups[static_cast<std::size_t>(at_tree.group)];
  const double* p = at(w_.p, g.first + at_tree.lane);
  // p_WO = step of the root - p of the root
  return {p[3 * lanes] - p[0], p[4 * lanes] - p[lanes], p[5 * lanes] - p[2 * lanes]};
}

Pose Frames::pose(const AttachedFrame& frame) const {
  if (frame.joint < 0) return frame.X_JF;
  const int slot = model_->packed.slot[static_cast<std::size_t>(frame.joint)];
  const double *R = at(w_.R, slot), *p = at(w_.p, slot);
  Pose X_WJ;
  for (int c = 0; c < 9; ++c) X_WJ.R.data()[c] = R[c * lanes];  // both by columns
  X_WJ.p = Vec3(p[0], p[lanes], p[2 * lanes]) +
           origin(model_->packed.tree[static_cast<std::size_t>(frame.joint)]);
  return X_WJ * frame.X_JF;
}

namespace {

template <class Items, class FrameOf>
MatX poses_of(const Frames& frames, const Items& items, const FrameOf& frame_of) {
  MatX out(static_cast<Eigen::Index>(items.size()), 16);
  double* to = out.data();
  for (const auto& item : items) {
    const Pose X = frames.pose(frame_of(item));
    Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> T(to);
    T << X.R, X.p, 0, 0, 0, 1;
    to += 16;
  }
  return out;
}

}  // namespace

MatX Frames::all_poses() const {
  return poses_of(*this, model_->links,
                  [](const Link& link) { return AttachedFrame{link.joint, link.X_JL}; });
}

MatX Frames::all_shape_poses() const {
  return poses_of(*this, model_->shapes,
                  [](const PlacedShape& shape) { return AttachedFrame{shape.joint, shape.X_JG}; });
}

void Frames::jacobian(const AttachedFrame& frame, MatX& out) const {
  const Tree& tree = model_->tree;
  out.setZero(6, model_.n_v());
  if (frame.joint < 0) return;
  const int slot = model_->packed.slot[static_cast<std::size_t>(frame.joint)];
  const double *R = at(w_.R, slot), *p_OJ = at(w_.p, slot);
  Vec3 p(p_OJ[0], p_OJ[lanes], p_OJ[2 * lanes]);  // of the frame from O
  for (int c = 0; c < 3; ++c) {
    p += frame.X_JF.p[c] * Vec3(R[3 * c * lanes], R[(3 * c + 1) * lanes], R[(3 * c + 2) * lanes]);
  }
  for (int i = frame.joint; i >= 0; i = tree.parent[i]) {
    const Drive& drive = tree.drive[i];
    const Vec6 S = six(at(w_.S_W, model_->packed.slot[static_cast<std::size_t>(i)]));
    out.col(drive.velocity) +=
        drive.multiplier * spatial(angular(S), linear(S) + angular(S).cross(p));
  }
}

MatX Frames::jacobian(int link) const {
  MatX J;
  jacobian(link_frame(model_, link), J);
  return J;
}

MatX Frames::jacobian(int link, const Vec3& p_L) const {
  AttachedFrame at_point = link_frame(model_, link);
  at_point.X_JF.p = at_point.X_JF * p_L;
  MatX J;
  jacobian(at_point, J);
  return J.bottomRows<3>();
}

void Frames::sum_masses() {
  if (summed_) return;
  mass_pass(model_->packed, w_);
  summed_ = true;
}

double Frames::mass() const {
  double mass = 0;
  for (const PackedPlace& tree : model_->packed.trees) {
    const PackedGroup& g = model_->packed.groups[static_cast<std::size_t>(tree.group)];
    mass += *at(model_->packed.weight, g.first + tree.lane);
  }
  return mass;
}

Vec3 Frames::centre_of_mass() {
  sum_masses();
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < model_->packed.trees.size(); ++k) {
    const PackedPlace& tree = model_->packed.trees[k];
    const int root = model_->packed.groups[static_cast<std::size_t>(tree.group)].first + tree.lane;
    const double* h = at(w_.I_h, root) + 6 * lanes;
    sum += Vec3(h[0], h[lanes], h[2 * lanes]) +
           *at(model_->packed.weight, root) * origin(static_cast<int>(k));
  }
  const double whole = mass();
  if (!(whole > 0)) throw ModelError("nothing that moves has mass: there is no centre of mass");
  return sum / whole;
}

// The momentum of a tree is sum I_k V_k = sum U_i s'_i, U_i the wrench that a unit rate of joint i
// gives its subtree.
Vec6 Frames::momentum(const VecRef& v) {
  check_vector(v, model_.n_v(), "v", "velocities");
  sum_masses();
  Vec6 sum = Vec6::Zero();
  for (int i = 0; i < model_->tree.joints(); ++i) {
    const std::size_t joint = static_cast<std::size_t>(i);
    const Drive& drive = model_->tree.drive[joint];
    const Vec6 U = six(at(w_.U_F_G, model_->packed.slot[joint]));
    const Vec3 p_WO = origin(model_->packed.tree[joint]);
    sum += drive.multiplier * v[drive.velocity] *
           spatial(angular(U) + p_WO.cross(linear(U)), linear(U));
  }
  return sum;
}

void Frames::gravity_forces(VecX& out) {
  sum_masses();
  gravity_pass(model_->packed, w_, forces_);
  out.resize(model_.n_v());
  gather(model_->tree, model_->packed, forces_.tau, 0, out);
}

void Frames::move(const VecRef& v) {
  set_rates(model_->tree, model_->packed, v, w_);
  saltus::move(model_->packed, w_);
}

void Frames::set_tree_forces(const VecRef& v, const VecRef& a, VecX& out) {
  move(v);
  set_accelerations(model_->tree, model_->packed, a, forces_);
  newton_euler(model_->packed, w_, forces_);
  out.resize(model_.n_v());
  gather(model_->tree, model_->packed, forces_.tau, 0, out);
}

void Frames::factorize_mass() {
  if (!M_) {
    M_.emplace(model_->tree, model_->packed);
    M_->lock = locks_of(model_->tree, model_->equalities);
  }
  sum_masses();
  if (factorize(model_->tree, model_->packed, w_, 0, *M_)) return;
  throw StepError("the mass matrix is singular at this configuration", 0, 0, 0);
}

void Frames::inverse_dynamics(const VecRef& v, const VecRef& a, VecX& out, double t) {
  check_vector(v, model_.n_v(), "v", "velocities");
  check_vector(a, model_.n_v(), "a", "velocities");
  if (!std::isfinite(t)) throw ModelError("t is not finite");
  if (loops_) {
    set_loops(*model_, q_, v, t, *loops_);
    check_accelerations(*model_, a, *loops_);
  }
  set_tree_forces(v, a, out);
  if (!loops_) return;
  factorize_mass();
  factorize_loops(*model_, t, *M_, *loops_);
  take_out_loops(*model_, *M_, *loops_, out);
}

void Frames::accelerations(const VecRef& v, const VecRef& forces, VecX& out, double t) {
  check_vector(v, model_.n_v(), "v", "velocities");
  check_vector(forces, model_.n_v(), "forces", "velocities");
  if (!std::isfinite(t)) throw ModelError("t is not finite");
  if (loops_) set_loops(*model_, q_, v, t, *loops_);
  set_tree_forces(v, zero_, out);
  out = forces - out;
  factorize_mass();
  solve(model_->tree, model_->packed, *M_, out);
  if (!loops_) return;
  factorize_loops(*model_, t, *M_, *loops_);
  hold_accelerations(*loops_, out);
}

Gaps Frames::gaps() {
  Kinematics kin(model_->tree);
  copy_poses(model_->tree, model_->packed, w_, kin);
  return gaps_at(model_, kin);
}

}  // namespace saltus
