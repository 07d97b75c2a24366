#include "derivatives/arc_curvature.hpp"

#include "derivatives/dense_arc.hpp"
#include "derivatives/placed_numbers.hpp"
#include "lagrangian/packed/potentials.hpp"

namespace saltus {
namespace {

using Change = CurvatureSweep::Change;
using Generators = HessianProduct::Generators;

/// How the inertia of one body changes where it moves by `turn` about O.
Inertia inertia_change(const BodyInertia& body, const Packed& w, int slot, const Vec6& turn,
                       Inertia& own) {
  const Mat3 R = rotation_of(w, slot);
  own = inertia_about(body.mass, position_of(w, slot) + R * body.c_J, R * body.I_J * R.transpose());
  const Vec3 phi = angular(turn), u = linear(turn);
  const Mat3 cross = cross_matrix(phi), h_u = own.h * u.transpose();
  return {
      0, own.mass * u + phi.cross(own.h),
      cross * own.I - own.I * cross + 2 * own.h.dot(u) * Mat3::Identity() - h_u - h_u.transpose()};
}

/// Screws, twists and momenta of the bodies, from the root on.
void set_changes(const ModelData& model, const ArcDerivative& arc, const VecX& dm, const VecX& dv,
                 const VecX& x, const VecX& y, std::vector<Change>& all) {
  const Packed& w = arc.s.w;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Generators& own = arc.product.own[i];
    Change& to = all[i];
    const Change* parent = own.parent < 0 ? nullptr : &all[static_cast<std::size_t>(own.parent)];
    const int slot = model.packed.slot[i], v = own.velocity;
    const double k = own.multiplier;
    const Vec6 V = six(at(w.V, slot)), none = Vec6::Zero();
    to.turn = (parent ? parent->turn : none) + k * dm[v] * own.S;
    to.S = cross_motion(to.turn, own.S);
    to.V = (parent ? parent->V : none) + k * (arc.v[v] * to.S + dv[v] * own.S);
    to.W = cross_motion(to.V, own.S) + cross_motion(V, to.S);
    Inertia body;
    to.I = inertia_change(model.mass.body[i], w, slot, to.turn, body);
    to.H = to.I * V + body * to.V;
    to.x = (parent ? parent->x : none) + k * x[v] * own.S;
    to.dx = (parent ? parent->dx : none) + k * x[v] * to.S;
    to.s = to.ds = none;
    if (parent == nullptr) continue;
    const Generators& above = arc.product.own[static_cast<std::size_t>(own.parent)];
    const double x_p = above.multiplier * x[above.velocity];
    const double y_p = above.multiplier * y[above.velocity];
    to.s = parent->s + y_p * above.S + x_p * above.W;
    to.ds = parent->ds + y_p * parent->S + x_p * parent->W;
  }
}

Inertia of_subtree(const ModelData& model, const Packed& w, int slot) {
  const double* I_h = at(w.I_h, slot);
  const auto I = [&](int c) { return I_h[c * lanes]; };
  Inertia out;
  out.mass = *at(model.packed.weight, slot);
  out.h = three(I_h + 6 * lanes);
  out.I << I(0), I(1), I(2), I(1), I(3), I(4), I(2), I(4), I(5);
  return out;
}

/// Sums over subtrees, and what they make of U, F and G but for forces.
void set_generator_changes(const ModelData& model, const ArcDerivative& arc,
                           std::vector<Change>& all) {
  for (std::size_t i = all.size(); i-- > 0;) {
    const Generators& own = arc.product.own[i];
    Change& to = all[i];
    const int slot = model.packed.slot[i];
    const Inertia I = of_subtree(model, arc.s.w, slot);
    to.U = to.I * own.S + I * to.S;
    to.F = to.I * own.W + I * to.W + cross_force(to.S, six(at(arc.s.w.H, slot))) +
           cross_force(own.S, to.H);
    to.G = linear(to.U).cross(model.mass.gravity);
    if (own.parent < 0) continue;
    Change& parent = all[static_cast<std::size_t>(own.parent)];
    parent.I += to.I;
    parent.H += to.H;
  }
}

/// Where a point of a body is, and what the direction and x move it by.
struct MovedPoint {
  const PackedPoint& point;
  Vec3 P, dP, x, dx;
};

MovedPoint moved(const ModelData& model, const PackedPoint& point, const Vec3& P,
                 const std::vector<Change>& all) {
  const Vec3 none = Vec3::Zero();
  MovedPoint out{point, P, none, none, none};
  if (point.slot < 0) return out;
  const Change& at = all[static_cast<std::size_t>(model.packed.joint[point.slot])];
  out.dP = velocity_at(at.turn, P);
  out.x = velocity_at(at.x, P);
  out.dx = velocity_at(at.dx, P) + angular(at.x).cross(out.dP);
  return out;
}

/// f at a point: G += J x f, and where x moves it t pushes back, by_q += J^T t.
void add_point(const ModelData& model, const ArcDerivative& arc, const MovedPoint& at,
               const Vec3& f, const Vec3& df, const Vec3& t, const Vec3& dt, CurvatureSweep& out) {
  for (const PointMover& m : at.point.movers) {
    const auto i = static_cast<std::size_t>(model.packed.joint[static_cast<std::size_t>(m.slot)]);
    const Vec6& S = arc.product.own[i].S;
    Change& to = out.joint[i];
    const Vec3 J = velocity_at(S, at.P);
    const Vec3 dJ = velocity_at(to.S, at.P) + angular(S).cross(at.dP);
    to.G += dJ.cross(f) + J.cross(df);
    out.by_q[m.velocity] += m.multiplier * (dJ.dot(t) + J.dot(dt));
  }
}

void add_potentials(const ModelData& model, const ArcDerivative& arc, const VecX& dm, const VecX& x,
                    CurvatureSweep& out) {
  const PackedPotentials& all = *model.packed.potentials;
  const Packed& w = arc.s.w;
  const Vec3 none = Vec3::Zero();
  for (const PackedForce& f : all.forces) {
    const MovedPoint at = moved(model, f.at, position_from_O(w, f.at), out.joint);
    add_point(model, arc, at, f.force, none, none, none, out);
  }
  for (std::size_t k = 0; k < all.springs.size(); ++k) {
    const PackedSpring& s = all.springs[k];
    const Packed::PlacedSpring& at = w.springs[k];
    const MovedPoint a = moved(model, s.a, at.P_a, out.joint);
    const MovedPoint b = moved(model, s.b, at.P_b, out.joint);
    const Vec3 r = at.r, dr = a.dP - b.dP, x_r = a.x - b.x, dx_r = a.dx - b.dx;
    Mat3 K = s.stiffness * Mat3::Identity(), dK = Mat3::Zero();
    if (!s.is_smooth()) {
      const double d2 = at.d * at.d, bend = s.stiffness * s.length / (d2 * at.d), rate = r.dot(dr);
      K += bend * (r * r.transpose() - d2 * Mat3::Identity());
      dK = bend * (rate * Mat3::Identity() + dr * r.transpose() + r * dr.transpose() -
                   3 * rate / d2 * r * r.transpose());
    }
    const Vec3 df = -K * dr, t = -K * x_r, dt = -(dK * x_r + K * dx_r);
    add_point(model, arc, a, at.force, df, t, dt, out);
    add_point(model, arc, b, -at.force, -df, -t, -dt, out);
  }
  for (const CurveSpring& c : all.curves) {
    const double m = c.multiplier, bend = m * m * m * packed::value_of(c, model.packed, w).second;
    out.by_q[c.velocity] -= bend * dm[c.velocity] * x[c.velocity];
  }
}

/// The Hessian product, each factor by the product rule.
void multiply(const ArcDerivative& arc, const VecX& x, const VecX& y, CurvatureSweep& out) {
  for (Change& each : out.joint) {
    each.a = each.da = Vec6::Zero();
    each.g = each.dg = Vec3::Zero();
  }
  for (std::size_t i = out.joint.size(); i-- > 0;) {
    const Generators& own = arc.product.own[i];
    Change& to = out.joint[i];
    const double k = own.multiplier, x_i = k * x[own.velocity], y_i = k * y[own.velocity];
    to.a += y_i * own.U + x_i * own.F;
    to.da += y_i * to.U + x_i * to.F;
    to.g += x_i * own.G;
    to.dg += x_i * to.G;
    out.by_v[own.velocity] +=
        k * (to.S.dot(to.a) + own.S.dot(to.da) + to.U.dot(to.s) + own.U.dot(to.ds));
    double by_q = to.W.dot(to.a) + own.W.dot(to.da) + to.F.dot(to.s) + own.F.dot(to.ds);
    by_q += angular(to.S).dot(to.g) + angular(own.S).dot(to.dg);
    if (own.parent >= 0) {
      Change& parent = out.joint[static_cast<std::size_t>(own.parent)];
      by_q += to.G.dot(angular(parent.x)) + own.G.dot(angular(parent.dx));
      parent.a += to.a;
      parent.da += to.da;
      parent.g += to.g;
      parent.dg += to.dg;
    }
    out.by_q[own.velocity] += k * by_q;
  }
}

[[noreturn]] void refuse(const std::string& what) {
  throw ModelError("the step has no second derivative yet: it has " + what);
}

}  // namespace

void check_curvature(const ModelData& model, const FlownArc& flown) {
  const ArcDerivative& arc = flown.arc;
  if (!model.tree.balls.empty()) refuse("a ball or free joint");
  if (!is_plain(flown)) refuse("contacts, loops or dry friction that hold or push");
  if (!model.forces.functions.empty()) refuse("forces that are functions");
  if (!model.mass.potentials.functions.empty()) refuse("potentials that are functions");
  if (!model.forces.dampers.empty()) refuse("dampers between points");
  if (!arc.s.input->wrenches.empty()) refuse("forces on links");
  if (arc.s.shift.size() > 0 && !arc.s.shift.isZero(0)) refuse("stiff damping");
}

void multiply_by_curvature(const ModelData& model, const ArcDerivative& arc, const VecX& dm,
                           const VecX& dv, const VecX& x, const VecX& y, CurvatureSweep& out) {
  out.joint.resize(arc.product.own.size());
  out.by_v.setZero(model.tree.n_v);
  out.by_q.setZero(model.tree.n_v);
  set_changes(model, arc, dm, dv, x, y, out.joint);
  set_generator_changes(model, arc, out.joint);
  if (model.packed.potentials) add_potentials(model, arc, dm, x, out);
  multiply(arc, x, y, out);
}

void set_arc_covector(const ModelData& model, ArcDerivative& arc, const Tangent& end,
                      ArcCovector& out) {
  out.end = end;
  Tangent z = end;
  out.Q.setZero(model.tree.n_v);
  arc.hat_v.setZero();
  arc.hat_m.setZero();
  pull_back(model, arc, out.Q, z);
  out.w = z.p - end.p;
  out.by_q = z.q - end.q;
}

double push_curvature(const ModelData& model, ArcDerivative& arc, double dtau, ArcCovector& along,
                      VecX& dQ, Tangent& z) {
  const double half = arc.tau / 2;
  const Packed& w = arc.s.w;
  push_forward(model, arc, dQ, dtau, z);
  const VecX dv = arc.dv;
  // p_end = p + tau f
  const VecX df = arc.product.by_q + dQ;
  multiply_by_curvature(model, arc, arc.x_m, dv, along.Q, -along.w, along.sweep);
  const VecX none = VecX::Zero(dv.size());
  const VecX more = dtau * (along.end.p + along.w / 2);  // of Q, w held
  multiply_by_transposed(model.tree, model.packed, w, more, none, arc.product);
  VecX dw = along.sweep.by_v + half * along.sweep.by_q + arc.product.by_v +
            half * arc.product.by_q + dtau * (along.end.q + along.by_q / 2);
  solve_transposed(model.tree, model.packed, arc.s.J, dw);
  dQ = more + half * dw;
  multiply_by_transposed(model.tree, model.packed, w, dQ, -dw, arc.product);
  z.q = along.sweep.by_q + arc.product.by_q;
  z.p = dw;
  return dv.dot(along.end.q + along.by_q / 2) + arc.v.dot(z.q) / 2 +
         df.dot(along.end.p + along.w / 2) + arc.force.dot(dw) / 2;
}

}  // namespace saltus
