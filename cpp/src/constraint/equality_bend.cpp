// Second derivatives of h along a motion: what loops ask of accelerations (theory, F6).
//
// With a = 0 the numbers v are constant, and a body's frame has the acceleration that its joints'
// screws make by turning, A_i = A_parent + W_i v_i (newton_euler.hpp). Then h'' = A'^T v, and h
// stays 0 where A^T a = drive' - h''.
#include "saltus/constraint/equality.hpp"
#include "saltus/tree/coordinates.hpp"

namespace saltus {
namespace {

/// Of a frame on a body, in world axes, of motion at constant v.
struct EndMotion {
  Pose X_WE;
  Vec3 w = Vec3::Zero(), w_dot = Vec3::Zero();        ///< [rad/s], [rad/s^2]
  Vec3 rate = Vec3::Zero(), rate_dot = Vec3::Zero();  ///< [m/s], [m/s^2] of its origin
};

EndMotion motion_of(const Tree& tree, const Kinematics& kin, const Equality::End& end,
                    const VecRef& v) {
  EndMotion out;
  out.X_WE = kin.X_WJ(tree, end.joint) * end.X_JE;
  if (end.joint < 0) return out;
  Vec6 A = Vec6::Zero();
  for (int i = end.joint; i >= 0; i = tree.parent[i]) {
    const Drive& drive = tree.drive[i];
    A += kin.joint[i].W * (drive.multiplier * v[drive.velocity]);
  }
  const Vec6& V = kin.joint[end.joint].V;
  const Vec3 P = out.X_WE.p - kin.origin[tree.root[end.joint]];
  out.w = angular(V);
  out.w_dot = angular(A);
  out.rate = linear(V) + out.w.cross(P);
  out.rate_dot = linear(A) + out.w_dot.cross(P) + out.w.cross(out.rate);
  return out;
}

/// (d / dt)^2 of 2 vec(Q), from Q' = (w; 0) Q / 2 with w of a against b in b's axes.
Vec3 bend_of_turn(const EndMotion& a, const EndMotion& b) {
  Quaternion Q(b.X_WE.R.transpose() * a.X_WE.R);
  if (Q.w() < 0) Q.coeffs() = -Q.coeffs();
  const Vec3 relative = a.w - b.w;
  const Vec3 w = b.X_WE.R.transpose() * relative;
  const Vec3 w_dot = b.X_WE.R.transpose() * (a.w_dot - b.w_dot - b.w.cross(relative));
  const double scalar_rate = -w.dot(Q.vec()) / 2;
  const Vec3 rate = (Q.w() * w + w.cross(Q.vec())) / 2;
  return scalar_rate * w + Q.w() * w_dot + w_dot.cross(Q.vec()) + w.cross(rate);
}

double bend_of_distance(const EndMotion& a, const EndMotion& b) {
  const Vec3 r = a.X_WE.p - b.X_WE.p, rate = a.rate - b.rate;
  const Vec3 n = r.stableNormalized();
  const double along = n.dot(rate);
  return n.dot(a.rate_dot - b.rate_dot) + (rate.squaredNorm() - along * along) / r.stableNorm();
}

double bend_of_plane(const EndMotion& a, const EndMotion& b) {
  const Vec3 r = a.X_WE.p - b.X_WE.p, n = b.X_WE.R.col(2), n_rate = b.w.cross(n);
  const Vec3 n_bend = b.w_dot.cross(n) + b.w.cross(n_rate);
  return n_bend.dot(r) + 2 * n_rate.dot(a.rate - b.rate) + n.dot(a.rate_dot - b.rate_dot);
}

double bend_of_coupling(const Tree& tree, const Kinematics& kin, const Equality& e,
                        const VecRef& v) {
  const Drive& drive = tree.drive[e.b.joint];
  const double x = kin.joint[e.b.joint].s, rate = drive.multiplier * v[drive.velocity];
  double second = 0;  // of the polynomial, by Horner's rule
  for (std::size_t k = e.polynomial.size(); k-- > 2;) {
    second = second * x + static_cast<double>(k * (k - 1)) * e.polynomial[k];
  }
  return -second * rate * rate;
}

void set_ends(const Tree& tree, const Kinematics& kin, const Equality& e, const VecRef& v,
              VecX& out) {
  const EndMotion a = motion_of(tree, kin, e.a, v), b = motion_of(tree, kin, e.b, v);
  if (e.type == LoopType::distance) {
    out[e.first] = -bend_of_distance(a, b);
  } else if (e.type == LoopType::on_plane) {
    out[e.first] = -bend_of_plane(a, b);
  } else {
    out.segment<3>(e.first) = b.rate_dot - a.rate_dot;
    if (e.type == LoopType::weld) out.segment<3>(e.first + 3) = -bend_of_turn(a, b);
  }
}

}  // namespace

void set_needed_accelerations(const Tree& tree, const EqualityModel& model, const Kinematics& kin,
                              const VecRef& v, double t, VecX& out) {
  for (const Equality& e : model.all) {
    if (e.type == LoopType::coupling) {
      out[e.first] = -bend_of_coupling(tree, kin, e, v);
    } else if (e.type == LoopType::prescribed) {
      out[e.first] = e.motion(t).acceleration;
    } else {
      set_ends(tree, kin, e, v, out);
    }
  }
}

}  // namespace saltus
