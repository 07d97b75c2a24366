// What potentials add to kappa and its gradient (shadow.hpp), by Q' and Q'' along its curve
// q(e) = q + e v - e^2 a, at e = 0:
//
//   kappa: -v.Q'      kappa_q: -Q''      kappa_v: -2 Q'            (2 a.Q is in 2 a.L_q already)
//
// Of a force f at a point P of a body that moves with Omega = V, Omega' (shadow.cpp):
//
//   J' = lin W + ang W x P + ang S x P'       P'  = lin V + ang V x P
//   J'' = lin S'' + ang S'' x P + 2 ang W x P' + ang S x P''
//   P'' = lin Omega' + ang Omega' x P + ang V x P'
//   Q' = J'.f + J.f'                          Q'' = J''.f + 2 J'.f' + J.f''
#include <cmath>

#include "lagrangian/packed/potentials.hpp"

namespace saltus::packed {
namespace {

/// A vector with its derivatives along the curve.
struct Moving {
  Vec3 x = Vec3::Zero(), first = Vec3::Zero(), second = Vec3::Zero();
};

Moving point_along(const Packed& w, const ShadowTerm& out, const PackedPoint& point) {
  Moving P{position_from_O(w, point)};
  if (point.slot < 0) return P;
  const double *V = at(w.V, point.slot), *Omega1 = at(out.motion, point.slot);
  P.first = three(V + 3 * lanes) + three(V).cross(P.x);
  P.second = three(Omega1 + 3 * lanes) + three(Omega1).cross(P.x) + three(V).cross(P.first);
  return P;
}

/// Adds one joint's Q' and Q''; by joint, which drives what it may.
void add_one(double Q1, double Q2, double rate, double* to) {
  to[0] -= rate * Q1;
  to[lanes] -= Q2;
  to[2 * lanes] -= 2 * Q1;
}

void add_force(const Packed& w, const PackedPoint& point, const Moving& P, const Moving& f,
               ShadowTerm& out) {
  for (const PointMover& m : point.movers) {
    const double* numbers = at(w.S_W, m.slot);
    const Vec6 S = six(numbers), W = six(numbers + 6 * lanes), V = six(at(w.V, m.slot));
    const Vec6 Omega1 = six(at(out.motion, m.slot));
    const Vec6 S2 = cross_motion(Omega1, S) + cross_motion(V, W);
    const Vec3 J = linear(S) + angular(S).cross(P.x);
    const Vec3 J1 = linear(W) + angular(W).cross(P.x) + angular(S).cross(P.first);
    const Vec3 J2 = linear(S2) + angular(S2).cross(P.x) + 2 * angular(W).cross(P.first) +
                    angular(S).cross(P.second);
    add_one(J1.dot(f.x) + J.dot(f.first), J2.dot(f.x) + 2 * J1.dot(f.first) + J.dot(f.second),
            *at(w.s_dot, m.slot), at(out.by_joint, m.slot));
  }
}

/// f = -phi r of a spring, phi = k (1 - l/d).
Moving pull_along(const PackedSpring& s, const Moving& r) {
  const double d = r.x.norm(), k = s.stiffness;
  double phi = k, phi1 = 0, phi2 = 0;
  if (!s.is_smooth()) {
    const double d1 = r.x.dot(r.first) / d;
    const double d2 = (r.first.squaredNorm() + r.x.dot(r.second) - d1 * d1) / d;
    phi = k * (1 - s.length / d);
    phi1 = k * s.length * d1 / (d * d);
    phi2 = k * s.length * (d2 / (d * d) - 2 * d1 * d1 / (d * d * d));
  }
  return {-phi * r.x, -phi1 * r.x - phi * r.first,
          -phi2 * r.x - 2 * phi1 * r.first - phi * r.second};
}

}  // namespace

void add_potential_shadow(const PackedTree& t, const Packed& w, ShadowTerm& out) {
  const PackedPotentials& all = *t.potentials;
  for (std::size_t k = 0; k < all.springs.size(); ++k) {
    const PackedSpring& s = all.springs[k];
    const Moving a = point_along(w, out, s.a), b = point_along(w, out, s.b);
    const Moving r{w.springs[k].r, a.first - b.first, a.second - b.second};
    const Moving f = pull_along(s, r);
    add_force(w, s.a, a, f, out);
    add_force(w, s.b, b, {-f.x, -f.first, -f.second}, out);
  }
  for (const PackedForce& f : all.forces) {
    add_force(w, f.at, point_along(w, out, f.at), {f.force}, out);
  }
  for (const CurveSpring& c : all.curves) {
    const int slot = t.slot_of_velocity[c.velocity];
    const double m = c.multiplier, v = *at(w.s_dot, slot), a = *at(out.s_ddot, slot);
    const CurveValue f = value_of(c, t, w);
    add_one(-m * m * f.slope * v, -m * m * (m * f.second * v * v - 2 * f.slope * a), v,
            at(out.by_joint, slot));
  }
}

}  // namespace saltus::packed
