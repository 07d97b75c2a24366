#include "saltus/constraint/equality.hpp"

#include <cmath>
#include <set>

#include "saltus/tree/coordinates.hpp"

namespace saltus {
namespace {

/// What one row is made of: adds what moves with the joints above an end to its gradient.
struct RowWriter {
  const Tree& tree;
  const Kinematics& kin;
  Eigen::Ref<VecX> row;  ///< (n_v)

  /// sign d.(velocity of the point P_W of the body).
  void add_point(int joint, const Vec3& P_W, const Vec3& d, double sign) {
    for (int i = joint; i >= 0; i = tree.parent[i]) {
      const Vec6& S = kin.joint[i].S;
      const Vec3 P = P_W - kin.origin[tree.root[i]];
      add(i, sign * d.dot(angular(S).cross(P) + linear(S)));
    }
  }
  /// sign d.(angular velocity of the body).
  void add_turn(int joint, const Vec3& d, double sign) {
    for (int i = joint; i >= 0; i = tree.parent[i]) add(i, sign * d.dot(angular(kin.joint[i].S)));
  }
  void add(int joint, double by_displacement) {
    const Drive& drive = tree.drive[joint];
    row[drive.velocity] += drive.multiplier * by_displacement;
  }
};

/// Sum of |gradient| |q|: how far the rounding of coordinates moves h. Angles of many turns count.
double size_by_coordinates(const Tree& tree, const Eigen::Ref<const VecX>& row, const VecRef& q) {
  double sum = 0;
  for (int c = 0; c < tree.n_v; ++c) {
    const int at = tree.coordinate[c];
    if (at >= 0 && row[c] != 0) sum += std::abs(row[c] * q[at]);
  }
  return sum;
}

double power(double x, std::size_t k) {
  double out = 1;
  for (std::size_t i = 0; i < k; ++i) out *= x;
  return out;
}

void set_coupling(const Tree& tree, const Equality& e, const VecRef& q, RowWriter writer, double& h,
                  double& size) {
  const double x_a = displacement(tree, e.a.joint, q), x_b = displacement(tree, e.b.joint, q);
  double value = 0, slope = 0;
  size = std::abs(x_a);
  for (std::size_t k = 0; k < e.polynomial.size(); ++k) {
    const double term = e.polynomial[k] * power(x_b, k);
    value += term;
    size += std::abs(term);
    if (k > 0) slope += static_cast<double>(k) * e.polynomial[k] * power(x_b, k - 1);
  }
  h = x_a - value;
  writer.add(e.a.joint, 1);
  writer.add(e.b.joint, -slope);
}

/// Rows 3 to 5 of a weld. From Q = (v, w), dv = (w omega + omega x v) / 2 with omega of a against b
/// in b's axes.
void set_turn(const Tree& tree, const Kinematics& kin, const Equality& e, const Pose& X_WA,
              const Pose& X_WB, EqualityValues& out) {
  Quaternion Q(X_WB.R.transpose() * X_WA.R);
  if (Q.w() < 0) Q.coeffs() = -Q.coeffs();
  for (int k = 0; k < 3; ++k) {
    const int row = e.first + 3 + k;
    out.h[row] = 2 * Q.vec()[k];
    out.size[row] += 1;
    const Vec3 d_B = Q.w() * Vec3::Unit(k) + Q.vec().cross(Vec3::Unit(k));
    RowWriter writer{tree, kin, out.A.col(row)};
    writer.add_turn(e.a.joint, X_WB.R * d_B, +1);
    writer.add_turn(e.b.joint, X_WB.R * d_B, -1);
  }
}

/// A row d.(P_a - P_b) - distance; the two are points of their bodies, or one point of both.
void set_chord(const Tree& tree, const Kinematics& kin, const Equality& e, int row, const Vec3& d,
               const Vec3& P_a, const Vec3& P_b, const Vec3& P_of_b, EqualityValues& out) {
  out.h[row] = d.dot(P_a - P_b) - e.distance;
  out.size[row] += P_a.cwiseAbs().sum() + P_b.cwiseAbs().sum() + e.distance;
  RowWriter writer{tree, kin, out.A.col(row)};
  writer.add_point(e.a.joint, P_a, d, +1);
  writer.add_point(e.b.joint, P_of_b, d, -1);
}

void set_ends(const Tree& tree, const Kinematics& kin, const Equality& e, EqualityValues& out) {
  const Pose X_WA = kin.X_WJ(tree, e.a.joint) * e.a.X_JE;
  const Pose X_WB = kin.X_WJ(tree, e.b.joint) * e.b.X_JE;
  const auto chord = [&](int row, const Vec3& d, const Vec3& P_of_b) {
    set_chord(tree, kin, e, row, d, X_WA.p, X_WB.p, P_of_b, out);
  };
  if (e.type == LoopType::distance) {
    return chord(e.first, (X_WA.p - X_WB.p).stableNormalized(), X_WB.p);
  }
  if (e.type == LoopType::on_plane) return chord(e.first, X_WB.R.col(2), X_WA.p);
  for (int k = 0; k < 3; ++k) chord(e.first + k, Vec3::Unit(k), X_WB.p);
  if (e.type == LoopType::weld) set_turn(tree, kin, e, X_WA, X_WB, out);
}

}  // namespace

std::string loop_type_name(LoopType type) {
  switch (type) {
    case LoopType::point:
      return "point";
    case LoopType::weld:
      return "weld";
    case LoopType::distance:
      return "distance";
    case LoopType::on_plane:
      return "on_plane";
    case LoopType::coupling:
      return "coupling";
    case LoopType::prescribed:
      return "prescribed";
  }
  return "";
}

int rows_of(LoopType type) {
  if (type == LoopType::point) return 3;
  return type == LoopType::weld ? 6 : 1;
}

EqualityValues::EqualityValues(int n_v, int rows) {
  h.setZero(rows);
  size.setZero(rows);
  drive.setZero(rows);
  A.setZero(n_v, rows);
}

VecX locks_of(const Tree& tree, const EqualityModel& model) {
  VecX out;
  for (const Equality& e : model.all) {
    if (e.type != LoopType::prescribed) continue;
    if (out.size() == 0) out.setZero(tree.n_v);
    const Drive& drive = tree.drive[e.a.joint];
    out[drive.velocity] += drive.multiplier * drive.multiplier * e.lock;
  }
  return out;
}

std::vector<int> joints_read(const Tree& tree, const EqualityModel& model) {
  std::set<int> found;
  for (const Equality& e : model.all) {
    for (const int end : {e.a.joint, e.b.joint}) {
      for (int i = end; i >= 0; i = tree.parent[i]) found.insert(i);
    }
  }
  return {found.begin(), found.end()};
}

void set_equalities(const Tree& tree, const EqualityModel& model, const Kinematics& kin,
                    const VecRef& q, double t, EqualityValues& out) {
  out.A.setZero();
  out.size.setZero();
  for (const Equality& e : model.all) {
    RowWriter writer{tree, kin, out.A.col(e.first)};
    if (e.type == LoopType::coupling) {
      set_coupling(tree, e, q, writer, out.h[e.first], out.size[e.first]);
    } else if (e.type == LoopType::prescribed) {
      const PrescribedMotion told = e.motion(t);
      const double x = displacement(tree, e.a.joint, q);
      out.h[e.first] = x - told.x;
      out.size[e.first] = std::abs(x) + std::abs(told.x) + 1;  // a metre or radian is no rounding
      out.drive[e.first] = told.rate;
      writer.add(e.a.joint, 1);
    } else {
      set_ends(tree, kin, e, out);
    }
  }
  for (int k = 0; k < model.rows; ++k) {
    out.size[k] += size_by_coordinates(tree, out.A.col(k), q);
  }
}

}  // namespace saltus
