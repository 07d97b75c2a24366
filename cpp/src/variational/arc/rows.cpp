#include "variational/arc/rows.hpp"

#include <algorithm>
#include <cmath>

#include "saltus/collision/slip.hpp"
#include "variational/arc/memory.hpp"

namespace saltus {
namespace {

bool is_sharp(const Pair& pair) {
  return !pair.inward.empty() && !std::holds_alternative<HalfSpace>(pair.on_b.shape);
}

/// An end of a rod on a solid with faces.
bool is_rod_end(const ModelData& model, const Pair& pair) {
  return pair.kind == PairKind::corner &&
         std::holds_alternative<Capsule>(model.shapes[pair.a].shape) &&
         (std::holds_alternative<Box>(pair.on_b.shape) ||
          std::holds_alternative<Convex>(pair.on_b.shape));
}

/// True where the rod of an end rests on an edge of the same solid already.
bool rests_on_edge(int end, const Node& node) {
  for (int i = 0; i < node.touching; ++i) {
    const Contact& c = node.contacts[i];
    if (c.motion == Contact::Motion::rests && node.pool[c.slot].kind == PairKind::crossing &&
        node.pool.solid(c.slot) == node.pool.solid(end)) {
      return true;
    }
  }
  return false;
}

/// Holds the row in the plane of b that touches at the node.
void freeze(const ModelData& model, const Node& node, Row& row) {
  const Contact& contact = node.contacts[row.contact];
  const Pair& pair = *row.pair;
  row.is_frozen = true;
  row.is_point = !pair.inward.empty() && std::holds_alternative<Sphere>(pair.on_a.shape);
  row.frozen.kind = Whole{};
  row.frozen.on_a = pair.on_a;
  row.frozen.on_b.joint = pair.on_b.joint;
  row.frozen.chain = pair.chain;  // no allocation: room for the deepest is reserved
  row.frozen.touch = pair.touch;
  put_plane_on_b(model.tree, node.kin, contact.p_WB, contact.n_W, row.frozen);
  const Pose X_WJ = node.kin.X_WJ(model.tree, pair.on_b.joint);
  row.point_B = X_WJ.R.transpose() * (contact.p_WB - X_WJ.p);
  for (int k = 0; k < 2 && contact.friction > 0; ++k) {
    row.t_B[k] = X_WJ.R.transpose() * contact.t_W[k];
  }
}

bool is_rolling_rim(const Row& row) {
  return std::holds_alternative<Rim>(row.pair->kind) && !row.is_point;
}

Vec3 in_frame(const Pose& X_WJ, const Vec3& p_W) { return X_WJ.R.transpose() * (p_W - X_WJ.p); }

/// Where it touches at the node, in the frame of a's joint.
Vec3 start_on_a(const ModelData& model, const Node& node, const Row& row) {
  const Contact& c = node.contacts[row.contact];
  return in_frame(node.kin.X_WJ(model.tree, row.pair->on_a.joint), c.p_WB + c.phi * c.n_W);
}

/// Holds a rim at the point that touches at the node.
void freeze_point(const ModelData& model, const Node& node, Row& row) {
  freeze(model, node, row);
  row.is_point = true;
  row.frozen.on_a.shape = Sphere{0};
  row.frozen.on_a.X_JG = Pose{Mat3::Identity(), start_on_a(model, node, row)};
}

void fit(const ModelData& model, bool with_friction, Row& row) {
  for (int k = 0; k < (with_friction ? 3 : 1); ++k) {
    row.rate[k].setZero(model.tree.n_v);
    row.column[k].setZero(model.tree.n_v);
    row.by_loops[k].setZero(model.equalities.rows);
  }
}

void activate(const Scene& scene, int i, const Node& node, Rows& rows) {
  Row& row = rows.row[i];
  const int rates = contact_of(node, row).rates();
  if (row.rate[rates - 1].size() == 0) fit(scene.model, rates == 3, row);
  row.is_active = true;
  rows.active.push_back(i);
  rows.pile.reserve(rows.active.size());
}

Row& next_row(Rows& rows) {
  if (rows.count == static_cast<int>(rows.row.size())) rows.row.emplace_back();
  return rows.row[rows.count++];
}

void add_row(const Scene& scene, int contact, const Node& node, Rows& rows) {
  const Contact& c = node.contacts[contact];
  rows.of_contact[contact] = rows.count;
  Row& row = next_row(rows);
  row.contact = contact;
  row.slot = c.slot;
  row.pair = &node.pool[c.slot];
  row.is_active = row.is_frozen = row.is_point = row.slides = false;
  row.axis = tangent_axis(c.n_W);
  // many that touch cannot all be brought to 0: they stay where rounding left them
  row.target = std::min(c.phi, 0.0);
  row.p.setZero();
  if (is_sharp(*row.pair) || (is_rod_end(scene.model, *row.pair) && rests_on_edge(c.slot, node))) {
    freeze(scene.model, node, row);
  }
}

void add_joint_row(int dry, double tau, const Memory& memory, Rows& rows) {
  Row& row = next_row(rows);
  row.contact = -1 - dry;
  row.slot = -2 - dry;
  row.pair = nullptr;
  row.is_active = row.is_frozen = row.is_point = row.slides = false;
  row.target = 0;
  row.p.setZero();
  const auto k = static_cast<std::size_t>(dry);
  const bool is_known = k < memory.dry.size() && memory.dry[k].arc == memory.arcs;
  if (is_known) row.p = tau / memory.dry[k].tau * memory.dry[k].p;
}

/// Joints between two bodies, at most.
int deepest_chain(const Tree& tree) {
  std::vector<int> depth(static_cast<std::size_t>(tree.joints()), 1);
  int most = 0;
  for (int i = 0; i < tree.joints(); ++i) {
    if (tree.parent[i] >= 0) depth[i] = depth[tree.parent[i]] + 1;
    most = std::max(most, 2 * depth[i]);
  }
  return most;
}

/// The round end of a rod goes round the border of a face, if the rod lies along the border. One
/// that lies across it is borne by the border behind its end, which stays level: where the rod as a
/// whole sinks, though its ends do not, they are held in the plane of the face from now on.
/// @return true where one is that was not
bool level_rods(const Scene& scene, const VecX& q_end, const Node& node, Rows& rows,
                ArcScratch& s) {
  bool changed = false;
  for (int i = 0; i < rows.count; ++i) {
    Row& row = rows.row[i];
    if (row.is_joint() || row.is_frozen || !is_rod_end(scene.model, *row.pair)) continue;
    place_end(scene.model, q_end, s);
    const Gap whole = pair_gap_at_end(scene.model, *node.pool.solid(row.slot), s);
    if (whole.phi >= floor_of(node, row.slot)) continue;
    freeze(scene.model, node, row);
    changed = true;
  }
  return changed;
}

}  // namespace

Rows::Rows(const Scene& scene) {
  constexpr std::size_t few = 64;  // what is more grows once
  const auto pairs = static_cast<std::size_t>(scene.model.pairs.size()) + scene.model.limits.size();
  const auto dry = static_cast<std::size_t>(scene.model.forces.friction.size());
  const std::size_t reserved = std::min(pairs, few) + dry;
  const std::size_t boxes = std::min<std::size_t>(pairs, 16) + dry;
  sticking.resize(scene.trees.of.size());
  const auto chain = static_cast<std::size_t>(deepest_chain(scene.model.tree));
  row.resize(reserved);
  for (Row& each : row) {
    fit(scene.model, scene.has_friction, each);
    each.frozen.chain.reserve(chain);
  }
  for (auto* each : {&active, &of_contact}) each->reserve(reserved);
  for (auto* each : {&u, &p, &before}) each->reserve(reserved);
  pile.reserve(boxes);
  reserve(W, boxes);
  for (VecX* x : {&momentum, &size}) x->setZero(scene.model.tree.n_v);
}

int count_pressed(const Rows& rows) {
  return static_cast<int>(std::count_if(rows.active.begin(), rows.active.end(),
                                        [&](int i) { return rows.row[i].is_pressed(); }));
}

void make_rows(const Scene& scene, double tau, const Node& node, const Memory& memory, Rows& rows) {
  rows.count = 0;
  rows.active.clear();
  rows.tau = tau;
  rows.residual = 0;
  rows.of_contact.assign(static_cast<std::size_t>(node.touching), -1);
  if (tau <= 0) return;
  for (int i = 0; i < node.touching; ++i) {
    const Contact& c = node.contacts[i];
    if (c.motion != Contact::Motion::rests) continue;
    add_row(scene, i, node, rows);
    Row& row = rows.row[rows.count - 1];
    const bool is_known = c.slot < static_cast<int>(memory.impulses.size()) &&
                          memory.impulses[c.slot].arc == memory.arcs;
    if (is_known) row.p = tau / memory.impulses[c.slot].tau * memory.impulses[c.slot].p;
    if (is_known || c.friction > 0) activate(scene, rows.count - 1, node, rows);
  }
  for (std::size_t k = 0; k < node.dry.size(); ++k) {
    if (node.is_still(k)) continue;
    add_joint_row(static_cast<int>(k), tau, memory, rows);
    activate(scene, rows.count - 1, node, rows);
  }
}

void rest_from_now(const Scene& scene, int contact, const Node& node, Rows& rows) {
  add_row(scene, contact, node, rows);
  activate(scene, rows.count - 1, node, rows);
}

bool press_rows(const Scene& scene, const VecX& q_end, const Node& node, Rows& rows,
                ArcScratch& s) {
  bool changed = false, placed = false;
  for (int i = 0; i < rows.count; ++i) {
    const Row& row = rows.row[i];
    if (row.is_active) continue;
    if (!placed) place_end(scene.model, q_end, s);
    placed = true;
    if (pair_gap_at_end(scene.model, row.watched(), s).phi >= press_below(node, row.slot)) continue;
    activate(scene, i, node, rows);
    changed = true;
  }
  return changed || level_rods(scene, q_end, node, rows, s);
}

bool level_held_ends(const Scene& scene, const Node& node, Rows& rows) {
  bool changed = false;
  for (int i = 0; i < rows.count; ++i) {
    Row& row = rows.row[i];
    if (row.is_joint() || !row.is_active) continue;
    if (is_rolling_rim(row)) {
      freeze_point(scene.model, node, row);
    } else if (!row.is_frozen && is_rod_end(scene.model, *row.pair)) {
      freeze(scene.model, node, row);
    } else {
      continue;
    }
    changed = true;
  }
  return changed;
}

bool hold_rims_at_points(const Scene& scene, const VecX& q_end, const Node& node, Rows& rows,
                         ArcScratch& s) {
  const Tree& tree = scene.model.tree;
  bool changed = false, placed = false;
  for (const int i : rows.active) {
    Row& row = rows.row[i];
    if (row.is_joint() || !is_rolling_rim(row)) continue;
    if (!placed) place_end(scene.model, q_end, s);
    placed = true;
    const Gap g = pair_gap_at_end(scene.model, row.watched(), s);
    const Vec3 middle = row.pair->on_a.X_JG.p;
    const Vec3 end = in_frame(s.kin_end.X_WJ(tree, row.pair->on_a.joint), g.p_WA);
    if ((end - middle).dot(start_on_a(scene.model, node, row) - middle) > 0) continue;
    freeze_point(scene.model, node, row);
    changed = true;
  }
  return changed;
}

void note_sticking(const Contact& joint, double p, double bound, double u, double W,
                   std::vector<int>& sticking) {
  constexpr double near_bound = 1 - 1e-9, rounding = 1e-6;
  if (!(std::abs(p) < near_bound * bound) || !(std::abs(u) <= rounding * W * bound)) return;
  ++sticking[static_cast<std::size_t>(joint.n.part[0].tree)];
}

void still_trees(const Scene& scene, const std::vector<int>& sticking, VecX& x) {
  for (std::size_t tree = 0; tree < sticking.size(); ++tree) {
    const std::vector<int>& coordinates = scene.trees.of[tree];
    if (sticking[tree] == 0 || sticking[tree] != static_cast<int>(coordinates.size())) continue;
    for (const int c : coordinates) x[c] = 0;
  }
}

void scale_impulses(double tau, Rows& rows) {
  const double part = rows.tau > 0 ? tau / rows.tau : 1;
  rows.tau = tau;
  for (std::size_t k = 0; k < rows.active.size(); ++k) active_row(rows, k).p *= part;
}

void forget_impulses(Rows& rows) {
  for (int i = 0; i < rows.count; ++i) rows.row[i].p.setZero();
}

}  // namespace saltus
