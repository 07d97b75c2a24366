// Everything that an arc is made of, in lanes, for tests.
#pragma once

#include "kit/random_trees.hpp"
#include "saltus/lagrangian/packed_matrix.hpp"

namespace saltus::test {

/// Momenta at the ends of an arc.
struct ArcMomenta {
  VecX start, end;
};

/// Everything that an arc is made of, in lanes.
struct BallArc {
  BallArc(const RandomTree& tree, TreeSolver solver)
      : t(tree),
        packed(pack(t.tree, t.mass, solver)),
        w(packed),
        J(t.tree, packed),
        products(packed) {}

  ArcMomenta momenta(const VecX& v, double tau) {
    VecX mid(t.tree.n_q), L_v(t.tree.n_v), L_q(t.tree.n_v);
    integrate(t.tree, t.q, tau / 2, v, mid);
    set_coordinates(t.tree, packed, mid, w);
    set_rates(t.tree, packed, v, w);
    place(packed, w);
    move(packed, w);
    first_pass(packed, w);
    arc_pass(packed, tau, w);
    gather(t.tree, packed, w.arc, 0, L_v);
    gather(t.tree, packed, w.arc, 1, L_q);
    return {L_v - tau / 2 * L_q, L_v + tau / 2 * L_q};
  }
  bool factorize(const VecX& v, double tau) {
    momenta(v, tau);
    second_pass(packed, w);
    return saltus::factorize(t.tree, packed, w, tau, J);
  }

  RandomTree t;
  PackedTree packed;
  Packed w;
  PackedMatrix J;
  PackedProducts products;
};

}  // namespace saltus::test
