// One contact with Coulomb friction: its impulse (lambda, beta), by maximal dissipation.
//
// Rates u = (u_n, u_t) of the contact, normal and in two tangents; an impulse p = (lambda, beta)
// changes them by W p, W = [n; T] M^-1 [n; T]^T (3, 3). Moreau (1988), Glocker & Pfeiffer (1995):
//
//   compression  u_n+ = 0,  beta = the b in the disc |b| <= mu lambda of least kinetic energy
//   expansion    e lambda more,  beta = likewise in the disc of radius mu e lambda
//
// The least kinetic energy (of the tangential motion, lambda given) is Coulomb's law at the end of
// each phase: u_t+ = 0 inside of the disc (it sticks), or beta = -mu lambda u_t+ / |u_t+| on its
// rim (it slides). Inside of the disc, and where T M^-1 n^T = 0, this is u_n+ = -e u_n-.
//
// No energy is ever gained, for any W and mu and e <= 1. Let p_c, p_e be the impulses of the two
// phases, u_c the rates between. Then dT = u_c.p_c - p_c.W p_c / 2 + u_c.p_e + p_e.W p_e / 2, and
// p_e = e p_c is among what the second phase chooses from: with it (u_c.p_c <= 0 by Coulomb's law)
// dT = (1 + e) u_c.p_c - (1 - e^2) p_c.W p_c / 2 <= 0, and what is chosen is no worse. Newton's law
// u_n+ = -e u_n-, taken literally where T M^-1 n^T is not 0, does gain energy (Kane's paradox).
//
// lambda of the first phase is a root of u_n+(lambda), which is continuous, is u_n- < 0 at 0, and
// grows as p.W p / lambda at least: it can be bracketed, whatever mu is (Painleve's too).
#pragma once

#include "saltus/spatial/spatial.hpp"

namespace saltus {

using Vec2 = Eigen::Matrix<double, 2, 1>;
using Mat2 = Eigen::Matrix<double, 2, 2>;

/// Least b.A b / 2 + c.b over |b| <= radius, by the secular equation.
/// @param A symmetric, positive semidefinite; @param c in its range. Of many b the shortest.
Vec2 least_in_disc(const Mat2& A, const Vec2& c, double radius);

/// The compression alone: u_n+ = 0. No impulse where u_n >= 0 already.
/// @param W symmetric, W(0, 0) > 0
Vec3 stop_contact(const Mat3& W, const Vec3& u, double friction);

/// Both phases. (1 + e) times the normal impulse of the first.
Vec3 collide_contact(const Mat3& W, const Vec3& u, double friction, double restitution);

}  // namespace saltus
