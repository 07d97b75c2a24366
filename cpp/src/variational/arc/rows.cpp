#include "variational/arc/rows.hpp"

#include <algorithm>
#include <cmath>

#include "saltus/collision/slip.hpp"
#include "variational/arc/freeze.hpp"
#include "variational/arc/memory.hpp"

namespace saltus {
namespace {

void fit(const Scene& scene, bool with_friction, Row& row) {
  const auto most = 2 * static_cast<std::size_t>(scene.trees.most);
  for (int k = 0; k < (with_friction ? 3 : 1); ++k) {
    row.rate[k].value.reserve(most);
    row.column[k].value.reserve(most);
    row.by_loops[k].setZero(scene.model.equalities.rows);
  }
}

void activate(const Scene& scene, int i, const Node& node, Rows& rows) {
  Row& row = rows.row[i];
  const int rates = contact_of(node, row).rates();
  if (row.rate[rates - 1].value.capacity() == 0) fit(scene, rates == 3, row);
  row.is_active = true;
  rows.active.push_back(i);
  rows.pile.reserve(rows.active.size());
}

Row& next_row(Rows& rows) {
  if (rows.count == static_cast<int>(rows.row.size())) rows.row.emplace_back();
  return rows.row[rows.count++];
}

void remind(const ImpulseMemory& before, double tau, Row& row) {
  row.p = tau / before.tau * before.p;
  row.own = before.own;
}

void add_row(const Scene& scene, const Contact& c, const Node& node, Rows& rows) {
  Row& row = next_row(rows);
  const int contact = node.contact_at(c.slot);
  row.contact = &c;
  row.dry = -1;
  if (contact >= 0) rows.of_contact[contact] = rows.count - 1;
  row.slot = c.slot;
  row.pair = &node.pool[c.slot];
  row.is_active = row.is_frozen = row.is_point = row.slides = false;
  row.axis = tangent_axis(c.n_W);
  // many that touch cannot all be brought to 0: they stay where rounding left them
  row.target = c.phi <= gap_rounding(c, *row.pair) ? c.phi : 0;
  row.p.setZero();
  row.own.setZero();
  if (is_held_in_plane(scene.model, row, node)) freeze(scene.model, node, row);
  hold_edges(scene.model, node, row);
}

void add_joint_row(int dry, double tau, const Memory& memory, Rows& rows) {
  Row& row = next_row(rows);
  row.contact = nullptr;
  row.dry = dry;
  row.slot = -2 - dry;
  row.pair = nullptr;
  row.is_active = row.is_frozen = row.is_point = row.slides = false;
  row.target = 0;
  row.p.setZero();
  row.own.setZero();
  const auto k = static_cast<std::size_t>(dry);
  const bool is_known = k < memory.dry.size() && memory.dry[k].arc == memory.arcs;
  if (is_known) remind(memory.dry[k], tau, row);
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

}  // namespace

Rows::Rows(const Scene& scene) : neighbours(scene) {
  constexpr std::size_t few = 64;  // what is more grows once
  const auto pairs = static_cast<std::size_t>(scene.model.pairs.size()) + scene.model.limits.size();
  const auto dry = static_cast<std::size_t>(scene.model.forces.friction.size());
  const std::size_t reserved = std::min(pairs, few) + dry;
  const std::size_t boxes = std::min<std::size_t>(pairs, 16) + dry;
  sticking.resize(scene.trees.of.size());
  const auto chain = static_cast<std::size_t>(deepest_chain(scene.model.tree));
  row.resize(reserved);
  for (Row& each : row) {
    fit(scene, scene.has_friction, each);
    each.frozen.chain.reserve(chain);
  }
  for (auto* each : {&active, &of_contact}) each->reserve(reserved);
  for (auto* each : {&u, &p, &before}) each->reserve(reserved);
  pile.reserve(boxes);
  pile.body_of.assign(static_cast<std::size_t>(scene.trees.first.back()), -1);
  reserve(W, boxes, 6 * static_cast<std::size_t>(scene.trees.most));
  for (std::size_t i = 0; i < std::min<std::size_t>(pairs, 16); ++i) {
    ahead.push_back(fresh_contact(scene));
  }
  for (VecX* x : {&momentum, &size, &dense, &column}) x->setZero(scene.model.tree.n_v);
  for (VecX& x : change) x.setZero(scene.model.tree.n_v);
}

bool is_still(const Scene& scene, const Contact& c, const Row& row, const Arc& arc) {
  return arc.tau * largest(scene.trees, c.n, arc.v) <= 10 * row.pair->touch;
}

int count_pressed(const Rows& rows) {
  return static_cast<int>(std::count_if(rows.active.begin(), rows.active.end(),
                                        [&](int i) { return rows.row[i].is_pressed(); }));
}

void make_rows(const Scene& scene, double tau, const Node& node, const Memory& memory, Rows& rows) {
  rows.count = rows.count_ahead = 0;
  rows.active.clear();
  rows.tau = tau;
  rows.residual = 0;
  rows.of_contact.assign(static_cast<std::size_t>(node.touching), -1);
  if (tau <= 0) return;
  for (int i = 0; i < node.touching; ++i) {
    const Contact& c = node.contacts[i];
    if (c.motion != Contact::Motion::rests) continue;
    add_row(scene, c, node, rows);
    Row& row = rows.row[rows.count - 1];
    const bool is_known = c.slot < static_cast<int>(memory.impulses.size()) &&
                          memory.impulses[c.slot].arc == memory.arcs;
    if (is_known) remind(memory.impulses[c.slot], tau, row);
    if (is_known || c.friction > 0) activate(scene, rows.count - 1, node, rows);
  }
  for (std::size_t k = 0; k < node.dry.size(); ++k) {
    if (node.is_still(k)) continue;
    add_joint_row(static_cast<int>(k), tau, memory, rows);
    activate(scene, rows.count - 1, node, rows);
  }
}

void rest_from_now(const Scene& scene, int contact, const Node& node, Rows& rows) {
  add_row(scene, node.contacts[contact], node, rows);
  activate(scene, rows.count - 1, node, rows);
}

void rest_ahead(const Scene& scene, const Contact& c, const Node& node, Rows& rows) {
  const auto k = static_cast<std::size_t>(rows.count_ahead++);
  if (k == rows.ahead.size()) rows.ahead.push_back(fresh_contact(scene));
  rows.ahead[k] = c;
  add_row(scene, rows.ahead[k], node, rows);
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
