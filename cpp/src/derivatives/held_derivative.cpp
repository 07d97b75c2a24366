#include "derivatives/held_derivative.hpp"

#include <Eigen/QR>

#include "derivatives/held_rows.hpp"
#include "derivatives/loop_rows.hpp"

namespace saltus {
namespace {

using Mode = KickContact::Mode;
using Vec2 = Eigen::Vector2d;

/// Rates of one contact that an arc holds.
struct Slip {
  std::array<VecX, 2> by_v, by_m, by_end, by_start;
  Vec2 value = Vec2::Zero();
};

/// Of a corner: its chord, on a plane and along axes that are fixed in b.
Slip slip_of_point(const ModelData& model, const Places& at, const TapeRow& row) {
  Slip out;
  FrameDerivative start, end;
  const FrameChoice choice = choice_of(row, true);
  set_frame(model, at.start, row.frozen, choice, start);
  set_frame(model, at.end, row.frozen, choice, end);
  const Pose X_WJ = at.end.X_WJ(model.tree, row.frozen.on_b.joint);
  const Vec3 chord =
      pair_gap(model.tree, at.end, row.frozen).p_WA - (X_WJ.p + X_WJ.R * row.point_B);
  for (int k = 0; k < 2; ++k) {
    out.by_end[k] = end.row[k + 1];
    out.by_start[k] = -start.row[k + 1];
    out.value[k] = (X_WJ.R * row.t_B[k]).dot(chord);
  }
  return out;
}

/// T(q_m) v.
Slip slip_in_middle(const ModelData& model, const Places& at, const Pair& pair, const TapeRow& row,
                    const VecX& v) {
  Slip out;
  FrameDerivative middle;
  set_frame(model, at.middle, pair, choice_of(row, false), middle);
  for (int k = 0; k < 2; ++k) {
    out.by_v[k] = middle.row[k + 1];
    out.by_m[k].setZero(v.size());
    add_row_covector(middle, k + 1, v, 1, out.by_m[k]);
    out.value[k] = middle.row[k + 1].dot(v);
  }
  return out;
}

void put(const VecX& from, Eigen::Index column, MatX& to) {
  if (from.size() > 0) to.col(column) = from;
}

/// Rates of one contact, whose first row is `at`. @return its slip
Vec2 add_rates(const ModelData& model, const Places& places, const TapeRow& row,
               const ArcDerivative& arc, Eigen::Index at, HeldArc& held) {
  if (row.joint >= 0) {
    held.G_v(row.joint, at) = 1;
    if (row.slides) held.rubs[row.joint] += row.P[0] / arc.tau;
    return Vec2::Zero();
  }
  if (row.loop >= 0) {
    FrameDerivative end;
    set_loop_row(model, places.end, row.loop, end);
    held.G_q.col(at) = end.row[0];
    return Vec2::Zero();
  }
  const Pair pair = pair_of(model, row.pair);
  GapDerivative end;
  set_gap_derivative(model, places.end, watched(row, pair), end);
  held.G_q.col(at) = end.n;
  if (rates_of(row) == 1) return Vec2::Zero();
  const Slip slip = row.is_point ? slip_of_point(model, places, row)
                                 : slip_in_middle(model, places, watched(row, pair), row, arc.v);
  for (int k = 0; k < 2; ++k) {
    put(slip.by_end[k], at + 1 + k, held.G_q);
    put(slip.by_v[k], at + 1 + k, held.G_v);
    put(slip.by_m[k], at + 1 + k, held.G_m);
    put(slip.by_start[k], at + 1 + k, held.G_0);
  }
  return slip.value;
}

/// N dg + N W dP + K dP = F dmu.
struct System {
  MatX W, N, K, F;
};

/// Equations of one contact, whose first row is `at`.
void add_equations(const TapeRow& row, const Vec2& slip, Eigen::Index at, HeldArc& held,
                   System& to) {
  if (row.joint >= 0 && row.slides) {
    to.K(at, at) = 1;
    return;
  }
  to.N(at, at) = 1;
  if (row.joint >= 0 || rates_of(row) == 1) return;
  const Eigen::Matrix2d W = to.W.block<2, 2>(at + 1, at + 1);
  const bool is_edge = is_at_edge(row.friction, row.P, row.slides, slip, W);
  held.is_at_edge = held.is_at_edge || is_edge;
  if (is_edge || !row.slides) {
    to.N(at + 1, at + 1) = to.N(at + 2, at + 2) = 1;
    return;
  }
  VecX F;
  add_sliding(row.friction, row.P[0], slip, at, to.N, to.K, F);
  to.F.col(static_cast<Eigen::Index>(held.slides.size())) = F;
  held.slides.push_back(row.pair);
}

void list_rows(const TapeArc& told, HeldArc& held) {
  held.contact_of.clear();
  held.row_of.clear();
  std::vector<double> P;
  for (int k = 0; k < told.n_held; ++k) {
    const TapeRow& row = told.held[static_cast<std::size_t>(k)];
    for (int i = 0; i < rates_of(row); ++i) {
      held.contact_of.push_back(k);
      held.row_of.push_back(i);
      P.push_back(row.P[i]);
    }
  }
  held.P = Eigen::Map<const VecX>(P.data(), static_cast<Eigen::Index>(P.size()));
}

/// R, and W.
MatX set_answers(const ModelData& model, ArcDerivative& arc, HeldArc& held) {
  const Eigen::Index N = held.size();
  const VecX none = VecX::Zero(model.tree.n_v);
  MatX W(N, N);
  for (Eigen::Index c = 0; c < N; ++c) {
    const auto k = static_cast<std::size_t>(held.contact_of[static_cast<std::size_t>(c)]);
    Tangent z{none, held.frames[k].row[held.row_of[static_cast<std::size_t>(c)]], 0, 0};
    push_forward(model, arc, none, 0, z);
    held.R_q.col(c) = z.q;
    held.R_p.col(c) = z.p;
    W.col(c) =
        held.G_q.transpose() * z.q + held.G_v.transpose() * arc.dv + held.G_m.transpose() * arc.x_m;
  }
  return W;
}

/// What the impulses change by. @param slips (n_held)
void set_shares(const TapeArc& told, const std::vector<Vec2>& slips, ArcDerivative& arc,
                const ModelData& model, HeldArc& held) {
  const Eigen::Index N = held.size();
  System system{set_answers(model, arc, held), MatX::Zero(N, N), MatX::Zero(N, N),
                MatX::Zero(N, told.n_held)};
  held.slides.clear();
  held.is_at_edge = false;
  Eigen::Index at = 0;
  for (std::size_t k = 0; k < slips.size(); ++k) {
    add_equations(told.held[k], slips[k], at, held, system);
    at += rates_of(told.held[k]);
  }
  Eigen::CompleteOrthogonalDecomposition<MatX> factors;
  factors.setThreshold(1e-11);  // redundant contacts share what they do: the least there is
  factors.compute(system.N * system.W + system.K);
  const MatX S = factors.pseudoInverse();
  held.S_N = S * system.N;
  held.S_F = S * system.F.leftCols(static_cast<Eigen::Index>(held.slides.size()));
}

void set_held_arc(const ModelData& model, const TapeArc& told, FlownArc& out) {
  HeldArc& held = out.held;
  list_rows(told, held);
  const Eigen::Index N = held.size();
  held.rubs.resize(0);
  if (N == 0) return;
  held.rubs.setZero(model.tree.n_v);
  for (MatX* each : {&held.R_q, &held.R_p, &held.G_q, &held.G_v, &held.G_m, &held.G_0}) {
    each->setZero(model.tree.n_v, N);
  }
  const Places places = places_of(model, told, out.arc);
  held.frames.resize(static_cast<std::size_t>(told.n_held));
  std::vector<Vec2> slips;
  Eigen::Index at = 0;
  for (int k = 0; k < told.n_held; ++k) {
    const TapeRow& row = told.held[static_cast<std::size_t>(k)];
    FrameDerivative& frame = held.frames[static_cast<std::size_t>(k)];
    if (row.joint >= 0) {
      set_joint_frame(model, row.joint, frame);
    } else if (row.loop >= 0) {
      set_loop_row(model, places.start, row.loop, frame);
    } else {
      const Pair pair = pair_of(model, row.pair);
      const bool at_a = pair.on_b.joint < 0;  // friction_point
      set_frame(model, places.start, pair, choice_of(row, at_a), frame);
    }
    slips.push_back(add_rates(model, places, row, out.arc, at, held));
    at += rates_of(row);
  }
  set_shares(told, slips, out.arc, model, held);
}

/// The kick, and where in the arc the directions of its friction come from.
void set_closing_kick(const ModelData& model, const Tape& tape, const TapeArc& told,
                      FlownArc& out) {
  out.kick.contacts.clear();
  out.source.clear();
  out.kick.P.resize(0);
  if (told.n_kick == 0) return;
  for (int k = 0; k < told.n_kick; ++k) {
    const TapeRow& row = told.kick[static_cast<std::size_t>(k)];
    KickContact contact = contact_of(model, row);
    if (row.is_along) {
      contact.mode = Mode::along;
      int first = 0;
      for (int i = 0; i < row.held; ++i) first += rates_of(told.held[static_cast<std::size_t>(i)]);
      out.source.push_back({first + 1, 0});
    } else if (row.joint >= 0) {
      contact.is_given = row.slides;
      if (row.slides) out.source.push_back({-1, row.P[0] / told.tau});
    }
    out.kick.contacts.push_back(contact);
  }
  if (!out.node) out.node = std::make_unique<NodeDerivative>(model);
  NodeDerivative& node = *out.node;
  node.t = told.t + told.tau;
  node.q = told.q_end;
  set_node_derivative(model, tape, node.t, told.q_end, told.v, node.motion);
  Tangent flow;
  set_flow(model, tape, told.p_end, node, flow);
  set_kick(model, node.q, node.motion, out.kick);
}

}  // namespace

KickContact contact_of(const ModelData& model, const TapeRow& row) {
  KickContact out;
  out.joint = row.joint;
  out.loop = row.loop;
  out.P = row.P;
  if (row.joint >= 0 || row.loop >= 0) return out;
  out.number = row.pair;
  out.pair = row.is_frozen ? row.frozen : pair_of(model, row.pair);
  out.frame = choice_of(row, false);
  out.friction = row.friction;
  out.mode = mode_of(row.P, row.friction);
  return out;
}

void set_flown_arc(const ModelData& model, const Tape& tape, const TapeArc& told, FlownArc& out) {
  out.told = &told;
  out.has_dense = false;
  set_arc_derivative(model, tape, told, out.arc);
  set_match(model, tape, told, out.arc, out.match);
  set_held_arc(model, told, out);
  set_closing_kick(model, tape, told, out);
}

}  // namespace saltus
