#include "saltus/lagrangian/newton_euler.hpp"

#include "lagrangian/packed/inertia.hpp"
#include "lagrangian/packed/lane.hpp"
#include "lagrangian/packed/own_terms.hpp"
#include "lagrangian/packed/potentials.hpp"

namespace saltus {
namespace packed {
namespace {

SALTUS_CLONES void set_frames_accelerations(const PackedTree& t, const Packed& w,
                                            PackedForces& out) {
  for (int b = 0; b < t.slots / lanes; ++b) {
    const double *S_W = w.S_W[b].x[0], *rate = w.s_dot[b].x[0], *rate2 = out.s_ddot[b].x[0];
    double* A = out.A[b].x[0];
    SALTUS_LANES
    for (int l = 0; l < lanes; ++l) {
      store(A + l, 0, rate2[l] * load6(S_W + l, 0) + rate[l] * load6(S_W + l, 6));
    }
  }
  for (const PackedGroup& g : t.groups) add_down<6>(g, out.A, 0);
}

SALTUS_CLONES void sum_wrenches(const PackedTree& t, const Packed& w, PackedForces& out) {
  const V3 gravity{t.gravity.x(), t.gravity.y(), t.gravity.z()};
  for (int b = 0; b < t.slots / lanes; ++b) {
    const double *body = t.body[b].x[0], *R = w.R[b].x[0], *p = w.p[b].x[0];
    const double *twist = w.V[b].x[0], *acceleration = out.A[b].x[0];
    double* X = out.X[b].x[0];
    SALTUS_LANES
    for (int l = 0; l < lanes; ++l) {
      const BodyInWorld I = inertia_in_world(body + l, R + l, p + l);
      const V6 V = load6(twist + l, 0);
      V6 A = load6(acceleration + l, 0);
      A.v = A.v - gravity;
      store(X + l, 0, I * A + cross_force(V, I * V));
    }
  }
  for (const PackedGroup& g : t.groups) add_up<6>(g, out.X, 0);
}

SALTUS_CLONES void set_torques(const PackedTree& t, const Packed& w, PackedForces& out) {
  for (int b = 0; b < t.slots / lanes; ++b) {
    const double *S = w.S_W[b].x[0], *X = out.X[b].x[0];
    double* tau = out.tau[b].x[0];
    SALTUS_LANES
    for (int l = 0; l < lanes; ++l) tau[l] = dot(load6(S + l, 0), load6(X + l, 0));
  }
}

SALTUS_CLONES void set_pulls(const PackedTree& t, const Packed& w, PackedForces& out) {
  const V3 gravity{t.gravity.x(), t.gravity.y(), t.gravity.z()};
  for (int b = 0; b < t.slots / lanes; ++b) {
    const double *weight = t.weight[b].x[0], *I_h = w.I_h[b].x[0], *S = w.S_W[b].x[0];
    double* tau = out.tau[b].x[0];
    SALTUS_LANES
    for (int l = 0; l < lanes; ++l) {
      const V6 pull{cross(load3(I_h + l, 6), gravity), weight[l] * gravity};
      tau[l] = dot(load6(S + l, 0), pull);
    }
  }
}

}  // namespace
}  // namespace packed

PackedForces::PackedForces(const PackedTree& tree) {
  const std::size_t n = static_cast<std::size_t>(tree.slots / lanes);
  s_ddot.resize(n);
  A.resize(n);
  X.resize(n);
  tau.resize(n);
}

void set_accelerations(const Tree& tree, const PackedTree& t, const VecRef& a, PackedForces& out) {
  for (int i = 0; i < tree.joints(); ++i) {
    const Drive& drive = tree.drive[i];
    *at(out.s_ddot, t.slot[i]) = drive.multiplier * a[drive.velocity];
  }
}

void newton_euler(const PackedTree& t, const Packed& w, PackedForces& out) {
  packed::set_frames_accelerations(t, w, out);
  packed::sum_wrenches(t, w, out);
  packed::set_torques(t, w, out);
  packed::add_own_torques(t, w, out);
  if (t.potentials != nullptr) packed::add_potential_torques(t, w, out);
}

void gravity_pass(const PackedTree& t, const Packed& w, PackedForces& out) {
  packed::set_pulls(t, w, out);
  if (t.potentials != nullptr) packed::add_compensation(t, w, out);
}

}  // namespace saltus
