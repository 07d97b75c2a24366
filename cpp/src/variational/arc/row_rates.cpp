#include "variational/arc/row_rates.hpp"

#include "saltus/collision/slip.hpp"
#include "variational/arc/freeze.hpp"

namespace saltus {
namespace {

/// Takes the gradient of rate k out of `dense`. @return what it says of v
double take_rate(const Scene& scene, const Contact& c, int k, const VecX& v, VecX& dense,
                 Row& row) {
  row.rate[k].part = c.n.part;
  row.rate[k].value.resize(c.n.value.size());
  take_from(scene.trees, dense, row.rate[k]);
  return dot(scene.trees, row.rate[k], v);
}

/// Where friction acts in the middle of the arc.
struct Sliding {
  Gap gap;
  int axis;
  Vec3 P;
  std::array<Vec3, 2> t;
};

Sliding sliding_of(const Tree& tree, const Contact& c, const Row& row, const Kinematics& kin) {
  const Gap g = pair_gap(tree, kin, row.watched());
  const int axis = tangent_axis(c.n_W);
  const Tangents t = tangents(g.n_W, axis);
  return {g, axis, contact_point(g), {t.t0, t.t1}};
}

/// Tangential rates there, where rolling has its slip: T v.
void set_sliding_rates(const Tree& tree, const Sliding& at, const Row& row, const Kinematics& kin,
                       const VecX& v, Vec3& u) {
  const Vec3 xi = relative_motion(tree, kin, row.watched(), at.P, v).xi;
  for (int k = 1; k < 3; ++k) u[k] = at.t[k - 1].dot(xi);
}

/// With their gradients. The middle of the arc moves with v, too: to T comes what it makes of T v.
void set_sliding(const Scene& scene, const Contact& c, bool still, Row& row, Vec3& u,
                 ArcWork& work) {
  const Tree& tree = scene.model.tree;
  const Kinematics& kin = work.scratch.kin_mid;
  const VecX& v = work.arc.v;
  std::array<VecX, 2>& T = work.rows.change;
  const Sliding at = sliding_of(tree, c, row, kin);
  for (int k = 0; k < 2; ++k) add_motion_gradient(tree, kin, row.watched(), at.P, at.t[k], T[k]);
  if (!still) {
    add_slip_change(tree, kin, row.watched(), at.gap, at.axis, v, work.arc.tau / 2, T[0], T[1]);
  }
  for (int k = 1; k < 3; ++k) u[k] = take_rate(scene, c, k, v, T[k - 1], row);
  if (!still) set_sliding_rates(tree, at, row, kin, v, u);
}

/// How far a point has moved on the plane that it is held in, as b's body sees it.
struct Chord {
  std::array<Vec3, 2> t;
  Vec3 moved;
};

Chord chord_of(const Tree& tree, const Row& row, const Vec3& p_WA, const Kinematics& kin) {
  const Pose X_WJ = kin.X_WJ(tree, row.frozen.on_b.joint);
  return {{X_WJ.R * row.t_B[0], X_WJ.R * row.t_B[1]}, p_WA - (X_WJ.p + X_WJ.R * row.point_B)};
}

/// Tangential rates of a point: of its chord.
void set_chord(const Scene& scene, const Contact& c, const Vec3& p_WA, bool still, Row& row,
               Vec3& u, ArcWork& work) {
  const Tree& tree = scene.model.tree;
  const Kinematics& kin = work.scratch.kin_end;
  const Chord chord = chord_of(tree, row, p_WA, kin);
  for (int k = 1; k < 3; ++k) {
    const Vec3& t = chord.t[k - 1];
    add_motion_gradient(tree, kin, row.frozen, p_WA, t, work.rows.dense);
    const double linear = take_rate(scene, c, k, work.arc.v, work.rows.dense, row);
    u[k] = still ? linear : t.dot(chord.moved) / work.arc.tau;
  }
}

/// A row that is about to be measured: at the end of the arc, and in its middle.
struct Measured {
  const Contact& c;
  bool slides;
  bool crosses;
  bool is_still;  ///< then rates over the arc would be rounding of positions, which what rests must
                  ///< not follow
  Gap end;
};

Measured measure(const Scene& scene, const Node& node, const Row& row, const ArcWork& work) {
  const Contact& c = contact_of(node, row);
  const bool still = !row.pair->is_stop() && is_still(scene, c, row, work.arc);
  const bool crosses = is_held_crossing(scene.model, row, node);
  const Pair& closed = crosses ? *row.pair : row.watched();
  return {c, c.friction > 0, crosses, still,
          pair_gap(scene.model.tree, work.scratch.kin_end, closed)};
}

/// The rate of a joint: its velocity.
void set_joint_rate(const Scene& scene, const Contact& c, const Arc& arc, Row& row, Vec3& u) {
  row.rate[0] = c.n;
  u = Vec3(dot(scene.trees, c.n, arc.v), 0, 0);
}

/// The point of a that a point row holds.
Vec3 held_point(const Tree& tree, const Measured& m, const Row& row, const Kinematics& kin) {
  return m.crosses ? pair_gap(tree, kin, row.frozen).p_WA : m.end.p_WA;
}

/// Rates and their gradients.
void set_row(const Scene& scene, const Measured& m, Row& row, Vec3& u, ArcWork& work) {
  const Tree& tree = scene.model.tree;
  const Kinematics& kin = work.scratch.kin_end;
  const double tau = work.arc.tau;
  u.setZero();
  if (m.slides && !row.is_point) set_sliding(scene, m.c, m.is_still, row, u, work);
  add_gap_gradient(tree, kin, m.crosses ? *row.pair : row.watched(), m.end, work.rows.dense);
  const double linear = take_rate(scene, m.c, 0, work.arc.v, work.rows.dense, row);
  u[0] = m.is_still ? linear + (m.c.phi - row.target) / tau : (m.end.phi - row.target) / tau;
  if (!m.slides || !row.is_point) return;
  set_chord(scene, m.c, held_point(tree, m, row, kin), m.is_still, row, u, work);
}

/// Rates alone, of a row that is not still.
void set_rates(const Scene& scene, const Measured& m, const Row& row, Vec3& u,
               const ArcWork& work) {
  const Tree& tree = scene.model.tree;
  const ArcScratch& s = work.scratch;
  u = Vec3((m.end.phi - row.target) / work.arc.tau, 0, 0);
  if (!m.slides) return;
  if (row.is_point) {
    const Chord chord = chord_of(tree, row, held_point(tree, m, row, s.kin_end), s.kin_end);
    for (int k = 1; k < 3; ++k) u[k] = chord.t[k - 1].dot(chord.moved) / work.arc.tau;
    return;
  }
  set_sliding_rates(tree, sliding_of(tree, m.c, row, s.kin_mid), row, s.kin_mid, work.arc.v, u);
}

void place_middle_and_end(const Scene& scene, const Node& node, ArcWork& work) {
  const ModelData& model = scene.model;
  ArcScratch& s = work.scratch;
  integrate(model.tree, node.q, work.arc.tau, work.arc.v, s.q);
  place_end(model, s.q, s);
  copy_poses(model.tree, model.packed, s.w_end, s.kin_end);
  if (scene.has_friction) copy_poses(model.tree, model.packed, s.w, s.kin_mid);
}

enum class Terms { rates, rates_and_gradients };

void measure_rows(const Scene& scene, const Node& node, Terms terms, ArcWork& work) {
  place_middle_and_end(scene, node, work);
  Rows& rows = work.rows;
  rows.u.resize(rows.active.size());
  for (std::size_t i = 0; i < rows.active.size(); ++i) {
    Row& row = active_row(rows, i);
    if (row.is_joint()) {
      set_joint_rate(scene, contact_of(node, row), work.arc, row, rows.u[i]);
      continue;
    }
    const Measured m = measure(scene, node, row, work);
    const bool is_enough = terms == Terms::rates && !m.is_still;
    is_enough ? set_rates(scene, m, row, rows.u[i], work) : set_row(scene, m, row, rows.u[i], work);
  }
}

}  // namespace

void look_at_rates(const Scene& scene, const Node& node, ArcWork& work) {
  measure_rows(scene, node, Terms::rates, work);
}

void set_row_rates(const Scene& scene, const Node& node, ArcWork& work) {
  measure_rows(scene, node, Terms::rates_and_gradients, work);
}

}  // namespace saltus
