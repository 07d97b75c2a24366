#include "derivatives/loop_rows.hpp"

#include <algorithm>

#include "derivatives/placed_numbers.hpp"
#include "saltus/tree/coordinates.hpp"

namespace saltus {
namespace {

struct Side {
  const Equality::End* end;
  double sign;
  Vec3 P;  ///< the point of its body that moves with it
};

/// A row d.(P_a - P_b), or d.(turn of a against b).
struct Ends {
  LoopType type;
  bool is_turn = false;
  Pose X_WA, X_WB;
  Quaternion Q;  ///< of a turn
  int axis = 0;  ///< which of the three of a point or a turn
  Vec3 d;
  Side a, b;
};

const Equality& equality_of(const ModelData& model, int number) {
  const auto& all = model.equalities.all;
  return *std::find_if(all.begin(), all.end(), [&](const Equality& e) {
    return number >= e.first && number < e.first + rows_of(e.type);
  });
}

bool is_of_joints(const Equality& e) {
  return e.type == LoopType::coupling || e.type == LoopType::prescribed;
}

Vec3 axis_of_turn(const Ends& at) {
  return at.Q.w() * Vec3::Unit(at.axis) + at.Q.vec().cross(Vec3::Unit(at.axis));
}

Ends ends_of(const ModelData& model, const Kinematics& kin, const Equality& e, int number) {
  Ends out;
  out.type = e.type;
  out.X_WA = kin.X_WJ(model.tree, e.a.joint) * e.a.X_JE;
  out.X_WB = kin.X_WJ(model.tree, e.b.joint) * e.b.X_JE;
  out.a = {&e.a, 1, out.X_WA.p};
  out.b = {&e.b, -1, e.type == LoopType::on_plane ? out.X_WA.p : out.X_WB.p};
  out.is_turn = number - e.first >= 3;
  out.axis = (number - e.first) % 3;
  if (out.is_turn) {
    out.Q = Quaternion(out.X_WB.R.transpose() * out.X_WA.R);
    if (out.Q.w() < 0) out.Q.coeffs() = -out.Q.coeffs();
    out.d = out.X_WB.R * axis_of_turn(out);
  } else if (e.type == LoopType::distance) {
    out.d = (out.X_WA.p - out.X_WB.p).stableNormalized();
  } else {
    out.d = e.type == LoopType::on_plane ? Vec3(out.X_WB.R.col(2)) : Vec3(Vec3::Unit(out.axis));
  }
  return out;
}

/// A motion of all that is beyond a joint: by its own screw, or along one axis of its placement.
struct Nudge {
  const Tree& tree;
  const Kinematics& kin;
  int joint;
  std::optional<Vec3> along;

  Screw at(const Vec3& P) const {
    return along ? Screw{Vec3::Zero(), *along} : screw_at(tree, kin, joint, P);
  }
  bool moves(const Equality::End& end) const {
    return end.joint >= 0 && tree.is_ancestor(joint, end.joint);
  }
  bool turns(int i) const {
    if (!tree.is_ancestor(joint, i)) return false;
    return along || (i != joint && !are_of_one_ball(tree, joint, i));
  }
};

struct EndsChange {
  Vec3 d = Vec3::Zero(), P_a = Vec3::Zero(), P_b = Vec3::Zero();
};

EndsChange change_of(const Ends& at, const Nudge& nudge) {
  EndsChange out;
  const Vec3 none = Vec3::Zero();
  const bool moves_a = nudge.moves(*at.a.end), moves_b = nudge.moves(*at.b.end);
  const Vec3 w = nudge.at(none).w;
  if (moves_a) out.P_a = nudge.at(at.X_WA.p).xi;
  if (moves_b) out.P_b = nudge.at(at.X_WB.p).xi;
  if (at.is_turn) {
    const Vec3 turned = (moves_a ? w : none) - (moves_b ? w : none);
    const Vec3 omega = at.X_WB.R.transpose() * turned;
    const Vec3 v = (at.Q.w() * omega + omega.cross(at.Q.vec())) / 2;
    const double scalar = -omega.dot(at.Q.vec()) / 2;
    out.d = at.X_WB.R * (scalar * Vec3::Unit(at.axis) + v.cross(Vec3::Unit(at.axis)));
    if (moves_b) out.d += w.cross(at.d);
  } else if (at.type == LoopType::distance) {
    const Vec3 r = at.X_WA.p - at.X_WB.p, rate = out.P_a - out.P_b;
    out.d = (rate - at.d.dot(rate) * at.d) / r.stableNorm();
  } else if (at.type == LoopType::on_plane) {
    if (moves_b) out.d = w.cross(at.d);
    out.P_b = out.P_a;  // one place for both
  }
  return out;
}

/// Of joint i of one side.
double row_at(const Ends& at, const Side& side, const Screw& i) {
  return side.sign * at.d.dot(at.is_turn ? i.w : i.xi);
}

double change_at(const Ends& at, const Side& side, int i, const Screw& own, const Nudge& nudge,
                 const EndsChange& by) {
  const Screw j = nudge.at(side.P);
  Vec3 change = Vec3::Zero();
  if (nudge.turns(i)) {
    change = at.is_turn ? Vec3(j.w.cross(own.w)) : Vec3(j.w.cross(own.xi) - own.w.cross(j.xi));
  }
  if (at.is_turn) return side.sign * (by.d.dot(own.w) + at.d.dot(change));
  change += own.w.cross(side.sign > 0 ? by.P_a : by.P_b);
  return side.sign * (by.d.dot(own.xi) + at.d.dot(change));
}

/// Calls f(joint) for joints at and above both ends, each once.
template <class F>
void for_each_joint(const Tree& tree, const Equality& e, const F& f) {
  for (int i = e.a.joint; i >= 0; i = tree.parent[i]) f(i);
  for (int i = e.b.joint; i >= 0; i = tree.parent[i]) {
    if (e.a.joint < 0 || !tree.is_ancestor(i, e.a.joint)) f(i);
  }
}

/// Calls f(side, joint, its screw at the side's point).
template <class F>
void for_each_arm(const Tree& tree, const Kinematics& kin, const Ends& at, const F& f) {
  for (const Side* side : {&at.a, &at.b}) {
    for (int i = side->end->joint; i >= 0; i = tree.parent[i]) {
      f(*side, i, screw_at(tree, kin, i, side->P));
    }
  }
}

/// Rows of displacements: x_a - f(x_b), or x_a alone.
void set_joint_rows(const ModelData& model, const Kinematics& kin, const Equality& e,
                    FrameDerivative& out) {
  const auto at = [&](int velocity) {
    return std::lower_bound(out.velocities.begin(), out.velocities.end(), velocity) -
           out.velocities.begin();
  };
  const Drive& a = model.tree.drive[e.a.joint];
  out.velocities = {a.velocity};
  out.row[0][a.velocity] += a.multiplier;
  if (e.type == LoopType::prescribed) {
    out.H[0].setZero(1, 1);
    return;
  }
  const Drive& b = model.tree.drive[e.b.joint];
  if (b.velocity != a.velocity) out.velocities.push_back(b.velocity);
  std::sort(out.velocities.begin(), out.velocities.end());
  const auto n = static_cast<Eigen::Index>(out.velocities.size());
  out.H[0].setZero(n, n);
  const double x = kin.joint[e.b.joint].s;
  double slope = 0, second = 0;  // of the polynomial, by Horner's rule
  for (std::size_t k = e.polynomial.size(); k-- > 1;) {
    slope = slope * x + static_cast<double>(k) * e.polynomial[k];
    if (k > 1) second = second * x + static_cast<double>(k * (k - 1)) * e.polynomial[k];
  }
  out.row[0][b.velocity] -= b.multiplier * slope;
  out.H[0](at(b.velocity), at(b.velocity)) -= b.multiplier * b.multiplier * second;
}

}  // namespace

void set_loop_row(const ModelData& model, const Kinematics& kin, int number, FrameDerivative& out) {
  const Tree& tree = model.tree;
  for (VecX& each : out.row) each.setZero(tree.n_v);
  const Equality& e = equality_of(model, number);
  if (is_of_joints(e)) return set_joint_rows(model, kin, e, out);
  out.velocities.clear();
  for_each_joint(tree, e, [&](int i) { out.velocities.push_back(tree.drive[i].velocity); });
  std::sort(out.velocities.begin(), out.velocities.end());
  out.velocities.erase(std::unique(out.velocities.begin(), out.velocities.end()),
                       out.velocities.end());
  const auto index = [&](int velocity) {
    return std::lower_bound(out.velocities.begin(), out.velocities.end(), velocity) -
           out.velocities.begin();
  };
  const auto n = static_cast<Eigen::Index>(out.velocities.size());
  out.H[0].setZero(n, n);
  const Ends at = ends_of(model, kin, e, number);
  for_each_arm(tree, kin, at, [&](const Side& side, int i, const Screw& own) {
    const Drive& drive = tree.drive[i];
    out.row[0][drive.velocity] += drive.multiplier * row_at(at, side, own);
  });
  for_each_joint(tree, e, [&](int j) {
    const Nudge nudge{tree, kin, j, {}};
    const EndsChange by = change_of(at, nudge);
    const Drive& drive_j = tree.drive[j];
    for_each_arm(tree, kin, at, [&](const Side& side, int i, const Screw& own) {
      const Drive& drive_i = tree.drive[i];
      out.H[0](index(drive_i.velocity), index(drive_j.velocity)) +=
          drive_i.multiplier * drive_j.multiplier * change_at(at, side, i, own, nudge, by);
    });
  });
}

void add_loop_placements(const ModelData& model, const Kinematics& kin, int number,
                         const VecX& row_hat, double of_h, MatX& to) {
  const Tree& tree = model.tree;
  const Equality& e = equality_of(model, number);
  if (is_of_joints(e)) return;
  const Ends at = ends_of(model, kin, e, number);
  for_each_joint(tree, e, [&](int j) {
    const int parent = tree.parent[j];
    const Mat3 R = parent < 0 ? Mat3(Mat3::Identity()) : kin.joint[parent].R;
    for (int c = 0; c < 3; ++c) {
      const Nudge nudge{tree, kin, j, Vec3(R.col(c))};
      const EndsChange by = change_of(at, nudge);
      double sum = 0;
      for (const Side* side : {&at.a, &at.b}) {
        if (!at.is_turn && nudge.moves(*side->end)) sum += of_h * side->sign * at.d.dot(R.col(c));
      }
      if (row_hat.size() > 0) {
        for_each_arm(tree, kin, at, [&](const Side& side, int i, const Screw& own) {
          const Drive& drive = tree.drive[i];
          sum +=
              row_hat[drive.velocity] * drive.multiplier * change_at(at, side, i, own, nudge, by);
        });
      }
      to(j, c) += sum;
    }
  });
}

}  // namespace saltus
