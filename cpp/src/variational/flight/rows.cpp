#include "variational/flight/rows.hpp"

#include <algorithm>

#include "saltus/collision/slip.hpp"

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
    if (c.motion == Contact::Motion::rests && node.pool[c.pair].kind == PairKind::crossing &&
        node.pool.solid(c.pair) == node.pool.solid(end)) {
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
  row.frozen.kind = PairKind::whole;
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

void fit(const ModelData& model, bool with_friction, Row& row) {
  for (int k = 0; k < (with_friction ? 3 : 1); ++k) {
    row.rate[k].setZero(model.tree.n_v);
    row.column[k].setZero(model.tree.n_v);
  }
}

void activate(const ModelData& model, int i, const Node& node, Rows& rows) {
  Row& row = rows.row[i];
  const bool with_friction = node.contacts[row.contact].friction > 0;
  if (row.rate[with_friction ? 2 : 0].size() == 0) fit(model, with_friction, row);
  row.is_active = true;
  rows.active.push_back(i);
  rows.pile.reserve(rows.active.size());
}

Row& next_row(const TreeCoordinates& trees, bool with_friction, Rows& rows) {
  if (rows.count == static_cast<int>(rows.row.size())) {
    Row fresh;
    fresh.frozen.chain.reserve(static_cast<std::size_t>(rows.deepest_chain));
    fresh.closing = fresh_contact(trees, with_friction);
    rows.row.push_back(std::move(fresh));
  }
  return rows.row[rows.count++];
}

void add_row(const ModelData& model, int contact, double tau, Node& node, Rows& rows) {
  const Contact& c = node.contacts[contact];
  Row& row = next_row(node.trees, node.friction.any, rows);
  row.contact = contact;
  row.place = c.pair;
  row.pair = &node.pool[c.pair];
  row.is_active = row.is_frozen = false;
  // many that touch cannot all be brought to 0: they stay where rounding left them
  row.target = std::min(c.phi, 0.0);
  row.p.setZero();
  if (is_sharp(*row.pair) || (is_rod_end(model, *row.pair) && rests_on_edge(c.pair, node))) {
    freeze(model, node, row);
  }
  const ImpulseMemory& memory = rows.memory[c.pair];
  const bool was_pressed = memory.flight == rows.flight - 1;
  if (was_pressed) row.p = tau / memory.tau * memory.p;
  if (was_pressed || c.friction > 0) activate(model, rows.count - 1, node, rows);
}

}  // namespace

Rows::Rows(const ModelData& model, bool with_friction) {
  // reserve: a few boxes; what is more grows once
  const std::size_t few = std::min<std::size_t>(static_cast<std::size_t>(model.pairs.size()), 64);
  std::vector<int> depth(static_cast<std::size_t>(model.tree.joints()), 1);
  for (int i = 0; i < model.tree.joints(); ++i) {
    if (model.tree.parent[i] >= 0) depth[i] = depth[model.tree.parent[i]] + 1;
    deepest_chain = std::max(deepest_chain, 2 * depth[i]);
  }
  const TreeCoordinates trees(model);
  for (std::size_t i = 0; i < few; ++i)
    fit(model, with_friction, next_row(trees, with_friction, *this));
  count = 0;
  active.reserve(few);
  closing.reserve(few);
  pile.reserve(std::min<std::size_t>(few, 16));
  for (auto* each : {&u, &p, &before}) each->reserve(few);
  reserve(W, std::min<std::size_t>(few, 16));
  for (VecX* x : {&momentum, &size}) x->setZero(model.tree.n_v);
}

int count_pressed(const Rows& rows) {
  return static_cast<int>(std::count_if(rows.active.begin(), rows.active.end(),
                                        [&](int i) { return rows.row[i].p[0] > 0; }));
}

void make_rows(const ModelData& model, double tau, Node& node, Rows& rows) {
  ++rows.flight;
  rows.count = 0;
  rows.active.clear();
  rows.tau = tau;
  rows.residual = 0;
  if (tau <= 0 || node.touching == 0) return;
  const auto pairs = static_cast<std::size_t>(node.pool.size());
  rows.memory.resize(std::max(pairs, rows.memory.size()));
  for (int i = 0; i < node.touching; ++i) {
    const Contact& c = node.contacts[i];
    if (c.motion == Contact::Motion::rests) add_row(model, i, tau, node, rows);
  }
}

void rest_from_now(const ModelData& model, int contact, Node& node, Rows& rows) {
  node.contacts[contact].motion = Contact::Motion::rests;
  add_row(model, contact, rows.tau, node, rows);
  if (!rows.row[rows.count - 1].is_active) activate(model, rows.count - 1, node, rows);
}

double floor_of(const Node& node, int place) {
  const int contact = node.contact_of[place];
  const double phi = contact < 0 ? node.sunk[place] : node.contacts[contact].phi;
  return std::min(0.0, phi) - node.pool[place].touch;
}

bool press_rows(const ModelData& model, const VecX& q_end, const Node& node, Rows& rows,
                ArcScratch& s) {
  bool changed = false, placed = false;
  for (int i = 0; i < rows.count; ++i) {
    const Row& row = rows.row[i];
    if (row.is_active) continue;
    if (!placed) place_end(model, q_end, s);
    placed = true;
    if (pair_gap_at_end(model, row.watched(), s).phi >= floor_of(node, row.place)) continue;
    activate(model, i, node, rows);
    changed = true;
  }
  return changed || level_rods(model, q_end, node, rows, s);
}

bool level_rods(const ModelData& model, const VecX& q_end, const Node& node, Rows& rows,
                ArcScratch& s) {
  bool changed = false;
  for (int i = 0; i < rows.count; ++i) {
    Row& row = rows.row[i];
    if (row.is_frozen || !is_rod_end(model, *row.pair)) continue;
    place_end(model, q_end, s);
    const Gap whole = pair_gap_at_end(model, *node.pool.solid(row.place), s);
    if (whole.phi >= floor_of(node, row.place)) continue;
    freeze(model, node, row);
    changed = true;
  }
  return changed;
}

bool level_held_ends(const ModelData& model, const Node& node, Rows& rows) {
  bool changed = false;
  for (int i = 0; i < rows.count; ++i) {
    Row& row = rows.row[i];
    if (!row.is_active || row.is_frozen || !is_rod_end(model, *row.pair)) continue;
    freeze(model, node, row);
    changed = true;
  }
  return changed;
}

void scale_impulses(double tau, Rows& rows) {
  const double part = rows.tau > 0 ? tau / rows.tau : 1;
  rows.tau = tau;
  for (std::size_t k = 0; k < rows.active.size(); ++k) active_row(rows, k).p *= part;
}

void forget_impulses(Rows& rows) {
  for (int i = 0; i < rows.count; ++i) rows.row[i].p.setZero();
}

void remember_impulses(Rows& rows) {
  for (const int i : rows.active) {
    const Row& row = rows.row[i];
    if (row.p[0] > 0) rows.memory[row.place] = {row.p, rows.tau, rows.flight};
  }
}

void forget_memory(Rows& rows) { ++rows.flight; }

}  // namespace saltus
