// What a coordinate has of its own (own_terms.cpp), for the passes.
#pragma once

#include "saltus/lagrangian/newton_euler.hpp"
#include "saltus/lagrangian/packed_matrix.hpp"
#include "saltus/lagrangian/shadow.hpp"

namespace saltus::packed {

/// To L_v and L_q.
void add_own_partials(const PackedTree& t, Packed& w);
/// To the scale of an arc's residual.
void add_own_scale(const PackedTree& t, double tau, Packed& w);
/// V of the springs [J].
double own_energy(const PackedTree& t, const Packed& w);
/// To L_qq v.
void add_own_products(const PackedTree& t, const Packed& w, PackedProducts& out);
/// To the torques of newton_euler.
void add_own_torques(const PackedTree& t, const Packed& w, PackedForces& out);
/// To kappa and its gradient.
void add_own_shadow(const PackedTree& t, const Packed& w, ShadowTerm& out);

/// Writes J.added, and adds to a ball's Delta. Needs K and C of balls.
void set_own_pivots(const PackedTree& t, const Packed& w, double tau, PackedMatrix& J);
/// To the rows of a group that lu solves.
void add_to_diagonal(const PackedGroup& g, PackedMatrix& J);

/// Writes J.G and J.H. Needs K and C of balls. @return false where they are 0
bool set_coupled(const PackedTree& t, const Packed& w, double tau, PackedMatrix& J);
/// J.dense += G H^T.
void add_coupled(PackedMatrix& J);
/// Factors of what forces on several coordinates add to J, whose other factors are there.
/// @return false where they make it singular
bool factorize_coupled(const Tree& tree, const PackedTree& t, const Packed& w, double tau,
                       PackedMatrix& J);
/// x <- what they make of x, that J^-1 without them has been applied to.
void solve_coupled(PackedMatrix& J, VecX& x);
/// The transposed one: what comes before the other factors' J^-T.
void solve_coupled_transposed(PackedMatrix& J, VecX& x);

}  // namespace saltus::packed
