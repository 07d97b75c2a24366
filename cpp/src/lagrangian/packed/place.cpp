// Down pass in lanes: poses, screws, twists.
//
//   R_i = R_parent X_R Rz(s)     step_i = R_parent X_p + slide s z_i     p_i = p_parent + step_i
//   S_i = [turn z; p x turn z + slide z]     V_i = V_parent + S_i s'      W_i = V_i x S_i
//
// Balls: ball.hpp.
//
// p is from the reference point O of the tree, as in kinematics.hpp.
#include "lagrangian/packed/ball.hpp"
#include "lagrangian/packed/lane.hpp"
#include "lagrangian/packed/potentials.hpp"
#include "lagrangian/packed/turn.hpp"
#include "saltus/lagrangian/packed.hpp"

namespace saltus {
namespace packed {
namespace {

/// R <- X_R Rz(s): the joint's frame in its parent's.
SALTUS_CLONES void turn_frames(const PackedTree& t, Packed& w) {
  for (int b = 0; b < t.slots / lanes; ++b) {
    const double *X = t.X[b].x[0], *turn = w.turn[b].x[0];
    double* R = w.R[b].x[0];
    SALTUS_LANES
    for (int l = 0; l < lanes; ++l) {
      const M3 A = load9(X + l, 0);
      const double c = turn[l], s = turn[lanes + l];
      store(R + l, 0, M3{c * A.x + s * A.y, c * A.y - s * A.x, A.z});
    }
  }
}

/// Frame of one joint in the world from its frame in its parent's.
SALTUS_INLINE M3 chain(const M3& parent, double slide, const double* X, double* R, double* p) {
  const M3 frame = parent * load9(R, 0);
  store(R, 0, frame);
  store(p, 3, parent * load3(X, 9) + slide * frame.z);
  return frame;
}

/// That of a joint that is placed in the world's axes: R is right already.
SALTUS_INLINE M3 start(const M3& parent, double slide, const double* X, const double* R,
                       double* p) {
  const M3 frame = load9(R, 0);
  store(p, 3, parent * load3(X, 9) + slide * frame.z);
  return frame;
}

SALTUS_INLINE void chain_one_tree(const PackedTree& t, const PackedGroup& g, Packed& w) {
  M3 frame = scalar_matrix(1);
  for (int k = 0; k < g.positions; ++k) {
    const int i = g.first + k;
    if (g.parent[k] != k - 1) frame = load9(at(w.R, g.first + g.parent[k]), 0);
    const double slide = at(t.kind, i)[lanes] * *at(w.s, i);
    const double* X = at(t.X, i);
    double *R = at(w.R, i), *p = at(w.p, i);
    frame = g.placed[k] ? start(frame, slide, X, R, p) : chain(frame, slide, X, R, p);
  }
}

SALTUS_INLINE void chain_equal_trees(const PackedTree& t, const PackedGroup& g, Packed& w) {
  for (int k = 0; k < g.positions; ++k) {
    for (int b = 0; b < g.width; b += lanes) {
      const int i = g.slot(k) + b, parent = g.slot(k > 0 ? g.parent[k] : 0) + b;
      const double *X = at(t.X, i), *kind = at(t.kind, i), *s = at(w.s, i), *Rp = at(w.R, parent);
      double *R = at(w.R, i), *p = at(w.p, i);
      if (k == 0) {
        SALTUS_LANES
        for (int l = 0; l < lanes; ++l) {
          store(p + l, 3, load3(X + l, 9) + kind[lanes + l] * s[l] * load9(R + l, 0).z);
        }
      } else if (g.placed[k]) {
        SALTUS_LANES
        for (int l = 0; l < lanes; ++l) {
          start(load9(Rp + l, 0), kind[lanes + l] * s[l], X + l, R + l, p + l);
        }
      } else {
        SALTUS_LANES
        for (int l = 0; l < lanes; ++l) {
          chain(load9(Rp + l, 0), kind[lanes + l] * s[l], X + l, R + l, p + l);
        }
      }
    }
  }
}

/// p from the steps. The joints above the reference joint are placed from it upwards, so that it
/// is at O exactly.
SALTUS_INLINE void sum_steps(const PackedGroup& g, Packed& w) {
  int below = -1;
  for (const int k : g.reference_path) {
    for (int l = 0; l < g.width; ++l) {
      double* p = at(w.p, g.slot(k) + l);
      const double* q = below < 0 ? nullptr : at(w.p, g.slot(below) + l);
      store(p, 0, q ? load3(q, 0) - load3(q, 3) : V3{0, 0, 0});
    }
    below = k;
  }
  auto next = g.reference_path.rbegin();  // the path is in order of position, the root at its end
  for (int k = 0; k < g.positions; ++k) {
    if (next != g.reference_path.rend() && *next == k) {
      ++next;
      continue;
    }
    if (g.width == 1) {
      double* p = at(w.p, g.slot(k));
      store(p, 0, load3(at(w.p, g.slot(g.parent[k])), 0) + load3(p, 3));
      continue;
    }
    for (int b = 0; b < g.width; b += lanes) {
      double* p = at(w.p, g.slot(k) + b);
      const double* parent = at(w.p, g.slot(g.parent[k]) + b);
      SALTUS_LANES
      for (int l = 0; l < lanes; ++l) store(p + l, 0, load3(parent + l, 0) + load3(p + l, 3));
    }
  }
}

SALTUS_CLONES void chain_frames(const PackedTree& t, Packed& w) {
  for (const PackedGroup& g : t.groups) {
    if (g.width == 1) {
      chain_one_tree(t, g, w);
    } else {
      chain_equal_trees(t, g, w);
    }
    sum_steps(g, w);
  }
}

SALTUS_CLONES void set_screws(const PackedTree& t, Packed& w) {
  for (int b = 0; b < t.slots / lanes; ++b) {
    const double *kind = t.kind[b].x[0], *R = w.R[b].x[0], *p = w.p[b].x[0];
    double* S = w.S_W[b].x[0];
    SALTUS_LANES
    for (int l = 0; l < lanes; ++l) {
      const V3 axis = load3(R + l, 6), turn = kind[l] * axis;
      store(S + l, 0, V6{turn, cross(load3(p + l, 0), turn) + kind[lanes + l] * axis});
    }
  }
}

/// V <- S s', then summed along the branches; W.
SALTUS_CLONES void set_twists(const PackedTree& t, Packed& w) {
  for (int b = 0; b < t.slots / lanes; ++b) {
    const double *S = w.S_W[b].x[0], *s_dot = w.s_dot[b].x[0];
    double* V = w.V[b].x[0];
    SALTUS_LANES
    for (int l = 0; l < lanes; ++l) store(V + l, 0, s_dot[l] * load6(S + l, 0));
  }
  for (const PackedGroup& g : t.groups) add_down<6>(g, w.V, 0);
  for (int b = 0; b < t.slots / lanes; ++b) {
    const double* V = w.V[b].x[0];
    double* S = w.S_W[b].x[0];
    SALTUS_LANES
    for (int l = 0; l < lanes; ++l) {
      store(S + l, 6, cross_motion(load6(V + l, 0), load6(S + l, 0)));
    }
  }
}

}  // namespace
}  // namespace packed

Packed::Packed(const PackedTree& tree) {
  const std::size_t n = static_cast<std::size_t>(tree.slots / lanes);
  s.resize(n);
  s_dot.resize(n);
  turn.resize(n);
  R.resize(n);
  p.resize(n);
  S_W.resize(n);
  V.resize(n);
  I_h.resize(n);
  H.resize(n);
  first.resize(n);
  scale.resize(n);
  terms.resize(n);
  arc.resize(n);
  U_F_G.resize(n);
  packed::prepare_potentials(tree, *this);
  if (tree.balls.empty()) return;
  ball.resize(n);
  ball_arc.resize(n);
}

void set_coordinates(const Tree& tree, const PackedTree& t, const VecRef& q, Packed& w) {
  for (const auto& each : t.displacements) *at(w.s, each.slot) = q[each.coordinate];
  for (int i = 0; i < tree.joints() && !t.one_to_one; ++i) {
    *at(w.s, t.slot[i]) = displacement(tree, i, q);
  }
  for (const PackedBall& ball : t.balls) {
    double* to = at(w.ball, ball.slot[2]);
    for (int c = 0; c < 4; ++c) to[c * lanes] = q[ball.coordinate + c];
  }
  if (w.q.size() > 0) w.q = q;
}

void set_rates(const Tree& tree, const PackedTree& t, const VecRef& v, Packed& w) {
  for (int i = 0; i < tree.joints() && t.one_to_one; ++i) *at(w.s_dot, t.slot[i]) = v[i];
  for (int i = 0; i < tree.joints() && !t.one_to_one; ++i) {
    const Drive& drive = tree.drive[i];
    *at(w.s_dot, t.slot[i]) = drive.multiplier * v[drive.velocity];
  }
}

void place(const PackedTree& t, Packed& w) {
  packed::set_turns(t, w);
  packed::turn_frames(t, w);
  packed::turn_balls(t, w);
  packed::chain_frames(t, w);
  packed::set_screws(t, w);
  packed::set_ball_screws(t, w);
  if (t.potentials != nullptr) packed::set_pull(t, w);
}

void move(const PackedTree& t, Packed& w) {
  packed::set_twists(t, w);
  packed::set_ball_twists(t, w);
}

void copy_pose(const Tree& tree, const PackedTree& t, const Packed& w, int joint, Kinematics& kin) {
  JointMotion& m = kin.joint[joint];
  const int slot = t.slot[joint], root = tree.root[joint];
  const double *R = at(w.R, slot), *p = at(w.p, slot), *S = at(w.S_W, slot);
  for (int c = 0; c < 9; ++c) m.R.data()[c] = R[c * lanes];  // both by columns
  for (int c = 0; c < 3; ++c) m.p[c] = p[c * lanes];
  for (int c = 0; c < 6; ++c) m.S[c] = S[c * lanes];
  m.s = *at(w.s, slot);
  const double* p_root = at(w.p, t.slot[root]);
  for (int c = 0; c < 3; ++c) kin.origin[root][c] = p_root[(3 + c) * lanes] - p_root[c * lanes];
}

void copy_poses(const Tree& tree, const PackedTree& t, const Packed& w, Kinematics& kin) {
  for (int i = 0; i < tree.joints(); ++i) copy_pose(tree, t, w, i, kin);
}

}  // namespace saltus
