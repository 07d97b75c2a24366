#include "saltus/model/motion.hpp"

#include "saltus/model/frames.hpp"

namespace saltus {
namespace {

void check_rows(const Eigen::Ref<const MatX>& x, int n, const std::string& what,
                const std::string& unit) {
  if (x.cols() != n) {
    throw ModelError("rows of " + what + " have " + counted(x.cols(), "entry") +
                     "; the model has " + std::to_string(n) + " " + unit);
  }
  for (Eigen::Index row = 0; row < x.rows(); ++row) {
    if (x.row(row).allFinite()) continue;
    throw ModelError("row " + std::to_string(row) + " of " + what + " is not finite");
  }
}

VecX row_of(const Model& model, const Eigen::Ref<const MatX>& q, Eigen::Index row) {
  return model.checked_q(q.row(row).transpose(), "row " + std::to_string(row) + " of q");
}

}  // namespace

AttachedFrame link_frame(const Model& model, int link) {
  const Link& l = model->links.at(static_cast<std::size_t>(link));
  return {l.joint, l.X_JL};
}

AttachedFrame shape_frame(const Model& model, int shape) {
  const PlacedShape& s = model->shapes.at(static_cast<std::size_t>(shape));
  return {s.joint, s.X_JG};
}

MatX poses(const Model& model, const AttachedFrame& frame, const Eigen::Ref<const MatX>& q) {
  check_rows(q, model.n_q(), "q", "coordinates");
  Frames frames(model);
  MatX out(q.rows(), 16);
  for (Eigen::Index row = 0; row < q.rows(); ++row) {
    frames.set(q.row(row).transpose(), "row " + std::to_string(row) + " of q");
    const Pose X_WF = frames.pose(frame);
    Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> T(out.row(row).data());
    T << X_WF.R, X_WF.p, 0, 0, 0, 1;
  }
  return out;
}

MatX velocities(const Model& model, const AttachedFrame& frame, const Eigen::Ref<const MatX>& q,
                const Eigen::Ref<const MatX>& v) {
  check_rows(q, model.n_q(), "q", "coordinates");
  check_rows(v, model.n_v(), "v", "velocities");
  if (q.rows() != v.rows()) {
    throw ModelError("q has " + counted(q.rows(), "row") + " and v " + std::to_string(v.rows()));
  }
  Kinematics kin(model->tree);
  MatX out = MatX::Zero(q.rows(), 6);
  if (frame.joint < 0) return out;
  for (Eigen::Index row = 0; row < q.rows(); ++row) {
    set_configuration(model->tree, row_of(model, q, row), kin);
    set_velocity(model->tree, v.row(row).transpose(), kin);
    const JointMotion& joint = kin.joint[static_cast<std::size_t>(frame.joint)];
    const Vec3 p = joint.p + joint.R * frame.X_JF.p;  // from O, as the twist V is
    out.row(row) << angular(joint.V).transpose(),
        (linear(joint.V) + angular(joint.V).cross(p)).transpose();
  }
  return out;
}

}  // namespace saltus
