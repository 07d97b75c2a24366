// Up passes in lanes: composite quantities of the subtrees and what they make (packed.hpp).
#include "lagrangian/packed/ball.hpp"
#include "lagrangian/packed/inertia.hpp"
#include "lagrangian/packed/lane.hpp"
#include "lagrangian/packed/own_terms.hpp"
#include "lagrangian/packed/potentials.hpp"
#include "saltus/lagrangian/packed.hpp"

namespace saltus {
namespace packed {
namespace {

/// I_h <- the bodies' own inertias about O.
SALTUS_INLINE void set_inertia(const double* body, const double* R, const double* p, double* I_h) {
  const BodyInWorld b = inertia_in_world(body, R, p);
  store(I_h, 0, b.I);
  store(I_h, 6, b.h);
}

SALTUS_CLONES void set_inertias(const PackedTree& t, Packed& w) {
  for (int b = 0; b < t.slots / lanes; ++b) {
    const double *body = t.body[b].x[0], *R = w.R[b].x[0], *p = w.p[b].x[0];
    double* I_h = w.I_h[b].x[0];
    SALTUS_LANES
    for (int l = 0; l < lanes; ++l) set_inertia(body + l, R + l, p + l, I_h + l);
  }
}

/// H and h of the subtrees.
SALTUS_CLONES void sum_momenta(const PackedTree& t, Packed& w) {
  for (int b = 0; b < t.slots / lanes; ++b) {
    const double *body = t.body[b].x[0], *I_h = w.I_h[b].x[0], *V = w.V[b].x[0];
    double* H = w.H[b].x[0];
    SALTUS_LANES
    for (int l = 0; l < lanes; ++l) {
      store(H + l, 0,
            momentum(body[l], load3(I_h + l, 6), load_symmetric(I_h + l, 0), load6(V + l, 0)));
    }
  }
  for (const PackedGroup& g : t.groups) {
    add_up<6>(g, w.H, 0);
    add_up<3>(g, w.I_h, 6);
  }
}

/// L_v = S.H, L_q = W.H + S.[h x g; m g].
SALTUS_CLONES void set_first(const PackedTree& t, Packed& w) {
  const V3 gravity{t.gravity.x(), t.gravity.y(), t.gravity.z()};
  for (int b = 0; b < t.slots / lanes; ++b) {
    const double *weight = t.weight[b].x[0], *I_h = w.I_h[b].x[0];
    const double *H = w.H[b].x[0], *S_W = w.S_W[b].x[0];
    double* first = w.first[b].x[0];
    SALTUS_LANES
    for (int l = 0; l < lanes; ++l) {
      const V6 S = load6(S_W + l, 0), W = load6(S_W + l, 6), h = load6(H + l, 0);
      const V6 pull{cross(load3(I_h + l, 6), gravity), weight[l] * gravity};
      first[l] = dot(S, h);
      first[lanes + l] = dot(W, h) + dot(S, pull);
    }
  }
}

// Products of sizes, so that what cancels inside a cross product counts too. `h` is the subtree's
// here: its size bounds that of the sum only from below, so the body's own mass and reach are used.
SALTUS_CLONES void set_terms(const PackedTree& t, Packed& w) {
  const double gravity = t.gravity.cwiseAbs().sum();
  for (int b = 0; b < t.slots / lanes; ++b) {
    const double *body = t.body[b].x[0], *I_h = w.I_h[b].x[0], *p = w.p[b].x[0];
    const double* V = w.V[b].x[0];
    double* terms = w.terms[b].x[0];
    SALTUS_LANES
    for (int l = 0; l < lanes; ++l) {
      const V6 twist = load6(V + l, 0);
      const double m = body[l], turning = size(twist.w), moving = size(twist.v);
      const double h = m * (size(load3(p + l, 0)) + size(load3(body + l, 1)));
      const double trace = I_h[l] + I_h[3 * lanes + l] + I_h[5 * lanes + l];
      terms[l] = trace * turning + h * moving;
      terms[lanes + l] = m * moving + h * turning;
      terms[2 * lanes + l] = h * gravity;
      terms[3 * lanes + l] = m * gravity;
    }
  }
  for (const PackedGroup& g : t.groups) add_up<4>(g, w.terms, 0);
}

SALTUS_CLONES void set_scale(const PackedTree& t, double tau, Packed& w) {
  for (int b = 0; b < t.slots / lanes; ++b) {
    const double *terms = w.terms[b].x[0], *S_W = w.S_W[b].x[0];
    double* scale = w.scale[b].x[0];
    SALTUS_LANES
    for (int l = 0; l < lanes; ++l) {
      const V6 S = load6(S_W + l, 0), W = load6(S_W + l, 6);
      const double H_w = terms[l], H_v = terms[lanes + l];
      const double g_w = terms[2 * lanes + l], g_v = terms[3 * lanes + l];
      scale[l] = size(S.w) * H_w + size(S.v) * H_v +
                 tau / 2 * (size(W.w) * H_w + size(W.v) * H_v + size(S.w) * g_w + size(S.v) * g_v);
    }
  }
}

/// I of the subtrees; U, F, G.
SALTUS_CLONES void set_generators(const PackedTree& t, Packed& w) {
  const V3 gravity{t.gravity.x(), t.gravity.y(), t.gravity.z()};
  for (const PackedGroup& g : t.groups) add_up<6>(g, w.I_h, 0);
  for (int b = 0; b < t.slots / lanes; ++b) {
    const double *weight = t.weight[b].x[0], *I_h = w.I_h[b].x[0];
    const double *H = w.H[b].x[0], *S_W = w.S_W[b].x[0];
    double* out = w.U_F_G[b].x[0];
    SALTUS_LANES
    for (int l = 0; l < lanes; ++l) {
      const V6 S = load6(S_W + l, 0), W = load6(S_W + l, 6);
      const S3 I = load_symmetric(I_h + l, 0);
      const V3 h = load3(I_h + l, 6);
      const V6 U = momentum(weight[l], h, I, S);
      store(out + l, 0, U);
      store(out + l, 6, momentum(weight[l], h, I, W) + cross_force(S, load6(H + l, 0)));
      store(out + l, 12, cross(U.v, gravity));
    }
  }
}

SALTUS_CLONES void set_mass_generators(const PackedTree& t, Packed& w) {
  for (const PackedGroup& g : t.groups) add_up<9>(g, w.I_h, 0);
  for (int b = 0; b < t.slots / lanes; ++b) {
    const double *weight = t.weight[b].x[0], *I_h = w.I_h[b].x[0], *S = w.S_W[b].x[0];
    double* out = w.U_F_G[b].x[0];
    SALTUS_LANES
    for (int l = 0; l < lanes; ++l) {
      store(out + l, 0,
            momentum(weight[l], load3(I_h + l, 6), load_symmetric(I_h + l, 0), load6(S + l, 0)));
    }
  }
}

}  // namespace
}  // namespace packed

void first_pass(const PackedTree& t, Packed& w) {
  packed::set_inertias(t, w);
  packed::sum_momenta(t, w);
  packed::set_first(t, w);
  packed::add_own_partials(t, w);
  if (t.potentials != nullptr) packed::add_potential_partials(t, w);
}

void arc_pass(const PackedTree& t, double tau, Packed& w) {
  w.arc = w.first;
  packed::correct_momenta(t, tau, w);
  if (t.potentials != nullptr) packed::add_potential_arcs(t, tau, w);
}

void scale_pass(const PackedTree& t, double tau, Packed& w) {
  packed::set_terms(t, w);
  packed::set_scale(t, tau, w);
  packed::add_own_scale(t, tau, w);
  if (t.potentials != nullptr) packed::add_potential_scale(t, tau, w);
}

void second_pass(const PackedTree& t, Packed& w) {
  packed::set_generators(t, w);
  if (t.potentials != nullptr) packed::add_potential_generators(t, w);
}

void mass_pass(const PackedTree& t, Packed& w) {
  packed::set_inertias(t, w);
  packed::set_mass_generators(t, w);
}

double potential_energy(const PackedTree& t, const Packed& w) {
  double V = packed::own_energy(t, w);
  if (t.potentials != nullptr) V += packed::potential_energy_of(t, w);
  for (const PackedGroup& g : t.groups) {
    for (int lane = 0; lane < g.trees; ++lane) {
      const double *I_h = at(w.I_h, g.first + lane), *p = at(w.p, g.first + lane);
      const double mass = *at(t.weight, g.first + lane);
      // p_WO = step of the root - p of the root
      for (int c = 0; c < 3; ++c) {
        const double origin = p[(3 + c) * lanes] - p[c * lanes];
        V -= t.gravity[c] * (I_h[(6 + c) * lanes] + mass * origin);
      }
    }
  }
  return V;
}

}  // namespace saltus
