#include "variational/arc/finish.hpp"

#include <algorithm>
#include <cmath>

#include "saltus/collision/slip.hpp"
#include "variational/law/coulomb.hpp"

namespace saltus {
namespace {

/// What the row held, as a contact at the node: its own where the node has it, and one with the
/// plane or edge that it was held by where not.
/// @return nullptr where edges have come to be parallel
Contact* held_contact(const Scene& scene, const Row& row, const Arc& arc, std::size_t used,
                      Node& node, HalfKick& kick) {
  const int contact = node.contact_at(row.slot);
  if (contact >= 0) {
    Contact& c = node.contacts[contact];
    // what it was frozen to is the same where nothing moves
    if (!row.is_frozen || is_still(scene, c, row, arc)) return &c;
  }
  const Gap g = pair_gap(scene.model.tree, node.kin, row.watched());
  if (!std::isfinite(g.phi)) return nullptr;
  Contact& own = kick.own[used];
  write_contact(scene, typical_speed(scene, node), row.slot, row.watched(), g, node, node.dense,
                own);
  return &own;
}

/// The friction of a row that slid, per unit of its normal impulse, along the tangents of the
/// contact at the arc's end.
Vec3 push_of(const Scene& scene, const Row& row, const Contact& c, const Node& node) {
  if (!row.slides || !(c.friction > 0)) return Vec3::Zero();
  Vec3 d_W;
  if (row.is_frozen) {
    const Pose X_WJ = node.kin.X_WJ(scene.model.tree, row.pair->on_b.joint);
    d_W = X_WJ.R * (row.p[1] * row.t_B[0] + row.p[2] * row.t_B[1]);
  } else {
    const Tangents t = tangents(c.n_W, row.axis);
    d_W = row.p[1] * t.t0 + row.p[2] * t.t1;
  }
  const Vec2 d(d_W.dot(c.t_W[0]), d_W.dot(c.t_W[1]));
  if (!(d.norm() > 0)) return Vec3::Zero();
  const Vec2 beta = c.friction * d.normalized();
  return Vec3(1, beta[0], beta[1]);
}

/// Those that the arc pressed, and of those that rested at its start and were not pressed what
/// approaches: that has not come here by itself.
void list_contacts(const Scene& scene, const ArcWork& work, Node& node, HalfKick& kick) {
  const Rows& rows = work.rows;
  kick.contacts.clear();
  kick.p.clear();
  kick.sizes.clear();
  kick.push.clear();
  while (static_cast<int>(kick.own.size()) < rows.count) kick.own.push_back(fresh_contact(scene));
  for (int i = 0; i < rows.count; ++i) {
    const Row& row = rows.row[i];
    Contact* c = nullptr;
    if (row.is_joint()) {
      c = &node.dry[row.dry];
      c->bound = rows.tau / 2 * node.dry_force[row.dry];
      c->slot = row.slot;
    } else if (row.is_pressed()) {
      c = held_contact(scene, row, work.arc, static_cast<std::size_t>(i), node, kick);
    } else if (const int contact = node.contact_at(row.slot); contact >= 0) {
      c = &node.contacts[contact];
      if (c->motion != Contact::Motion::approaches) continue;
    }
    if (c == nullptr) continue;
    kick.contacts.push_back(c);
    kick.sizes.push_back(row.is_active ? row.own : Mat3(Mat3::Zero()));
    kick.p.push_back(row.p);  // the opening half kick is near
    kick.push.push_back(push_of(scene, row, *c, node));
  }
}

/// True where the friction of a normal impulse is against the slip.
bool is_against_slip(const Scene& scene, const Contact& c, const Vec3& push, const VecX& v) {
  return push[1] * dot(scene.trees, c.t[0], v) + push[2] * dot(scene.trees, c.t[1], v) <= 0;
}

bool is_given(const Vec3& push) { return !push.isZero(0); }

/// Where the direction of friction is given, a contact has one rate, u_n, and one impulse.
void hold_directions(HalfKick& kick) {
  ContactBlocks& W = kick.W;
  if (std::any_of(kick.push.begin(), kick.push.end(), is_given)) forget_factors(W);
  for (int j = 0; j < W.size(); ++j) {
    const bool given = is_given(kick.push[j]);
    for (int k = W.start[j]; k < W.start[j + 1]; ++k) {
      Mat3& block = W.block[k];
      if (given) block << Vec3(block * kick.push[j]), Vec3::Zero(), Vec3::Zero();
      if (is_given(kick.push[W.contact[k]])) block.bottomRows<2>().setZero();
    }
    if (!given) continue;
    W.own[j] = Vec3(W.own[j].row(0).dot(kick.push[j]), 0, 0).asDiagonal();
    W.friction[j] = 0;
    kick.u[j].tail<2>().setZero();
    kick.p[j].tail<2>().setZero();
  }
}

/// Coulomb's law of all where friction that is given would draw its contact in, or push it on; of
/// all contacts where with it no impulses meet the law: W has no symmetry then, and many contacts
/// of a body may contradict each other. Coulomb's law has always a solution.
/// @return true where one has changed
bool release(const Scene& scene, const Node& node, HalfKick& kick) {
  bool released = false;
  if (!(kick.residual <= small_residual)) {
    kick.push.assign(kick.push.size(), Vec3::Zero());
    return true;
  }
  for (std::size_t i = 0; i < kick.push.size(); ++i) {
    if (!is_given(kick.push[i])) continue;
    if (is_against_slip(scene, *kick.contacts[i], kick.push[i], node.v)) continue;
    kick.push[i].setZero();
    released = true;
  }
  return released;
}

/// Of joints with dry friction, before.
void set_dry_rates(const Scene& scene, const Node& node, HalfKick& kick) {
  kick.dry_rate.clear();
  for (const Contact* c : kick.contacts) {
    kick.dry_rate.push_back(c->bound > 0 ? dot(scene.trees, c->n, node.v) : 0);
  }
}

/// The law, at all of them together. Changes p and v.
void share_once(const Scene& scene, Node& node, HalfKick& kick) {
  set_contact_blocks(scene, kick.contacts, node, kick.neighbours, kick.W, kick.u);
  for (std::size_t i = 0; i < kick.push.size(); ++i) {  // Painleve's: it would draw in
    const Mat3& own = kick.W.own[i];
    if (!(own.row(0).dot(kick.push[i]) > 0.1 * own(0, 0))) kick.push[i].setZero();
  }
  hold_directions(kick);
  add_rates(kick.W, kick.p, kick.u);
  const bool given = std::any_of(kick.push.begin(), kick.push.end(), is_given);
  kick.residual = given ? settle_pile(kick.W, kick.pile, kick.u, kick.p).excess
                        : settle_for_sure(kick.W, kick.pile, kick.u, kick.p).excess;
  kick.unlawful =
      kick.contacts[static_cast<std::size_t>(most_lawless(kick.W, kick.u, kick.p))]->slot;
  for (std::size_t i = 0; i < kick.contacts.size(); ++i) {
    if (is_given(kick.push[i])) kick.p[i] = kick.p[i][0] * kick.push[i];
    apply(scene, *kick.contacts[i], kick.p[i], node);
  }
}

/// What rests is most often held by the impulses of the opening half kick.
/// @return true where they are lawful, to rounding; p and v have them then
bool share_as_before(const Scene& scene, Node& node, HalfKick& kick) {
  const auto is_unknown = [](const Mat3& own) { return own.isZero(0); };
  if (node.loops.some || std::any_of(kick.sizes.begin(), kick.sizes.end(), is_unknown)) {
    return false;
  }
  ContactBlocks& W = kick.W;
  clear(W);
  kick.p_before = node.p;
  kick.v_before = node.v;
  for (std::size_t i = 0; i < kick.contacts.size(); ++i) {
    const Contact& c = *kick.contacts[i];
    for (int k = 0; k < c.rates(); ++k) add(scene.trees, kick.p[i][k], c.row(k), node.p);
    W.own.push_back(kick.sizes[i]);
    W.friction.push_back(c.friction);
    W.rest.push_back(c.epsilon_u);
    W.bound.push_back(c.bound);
  }
  node.v = node.p;
  solve(scene.model.tree, scene.model.packed, node.M, node.v);
  kick.u.clear();
  for (const Contact* c : kick.contacts) {
    kick.u.push_back(Vec3::Zero());
    for (int k = 0; k < c->rates(); ++k) kick.u.back()[k] = dot(scene.trees, c->row(k), node.v);
  }
  const Lawlessness law = lawlessness(W, kick.u, kick.p);
  // more than rounding would go on to the next arc, whose half kick turns it round
  if (law.residual <= 4e-15) {
    kick.residual = law.excess;
    return true;
  }
  node.p = kick.p_before;
  node.v = kick.v_before;
  return false;
}

void share(const Scene& scene, Node& node, HalfKick& kick) {
  kick.pile.reserve(kick.contacts.size());
  release(scene, node, kick);
  const bool any = std::any_of(kick.push.begin(), kick.push.end(), is_given);
  if (any) kick.p_before = node.p, kick.v_before = node.v;
  set_dry_rates(scene, node, kick);
  if (any || !share_as_before(scene, node, kick)) share_once(scene, node, kick);
  bool may_release = any;
  while (may_release && release(scene, node, kick)) {  // fewer are given each time
    may_release = std::any_of(kick.push.begin(), kick.push.end(), is_given);
    node.p = kick.p_before;
    node.v = kick.v_before;
    share_once(scene, node, kick);
  }
  for (std::size_t i = 0; i < kick.contacts.size(); ++i) {
    const Contact& c = *kick.contacts[i];
    if (c.bound > 0) continue;
    kick.impulses.push_back(acted(node, c, kick.p[i][0], across(c, kick.p[i])));
  }
  kick.sticking.assign(scene.trees.of.size(), 0);
  for (std::size_t i = 0; i < kick.contacts.size(); ++i) {
    const Contact& c = *kick.contacts[i];
    if (!(c.bound > 0)) continue;
    const double u = dot(scene.trees, c.n, node.v);
    note_sticking(c, kick.p[i][0], c.bound, u, kick.W.own[i](0, 0), kick.sticking);
  }
  for (VecX* each : {&node.p, &node.v}) still_trees(scene, kick.sticking, *each);
  for (std::size_t i = 0; i < kick.contacts.size(); ++i) {
    const Contact& c = *kick.contacts[i];
    if (!(c.bound > 0)) continue;
    kick.dry_work += kick.p[i][0] * (kick.dry_rate[i] + dot(scene.trees, c.n, node.v)) / 2;
  }
  refresh_motions(scene, node);
}

}  // namespace

HalfKick::HalfKick(const Scene& scene) : neighbours(scene) {
  const auto pairs = static_cast<std::size_t>(scene.model.pairs.size()) + scene.model.limits.size();
  const auto dry = static_cast<std::size_t>(scene.model.forces.friction.size());
  const std::size_t reserved = std::min<std::size_t>(pairs, 64) + dry;
  const std::size_t boxes = std::min<std::size_t>(pairs, 16) + dry;
  sticking.resize(scene.trees.of.size());
  dry_rate.reserve(reserved);
  for (std::size_t i = 0; i < reserved; ++i) own.push_back(fresh_contact(scene));
  impulses.reserve(reserved);
  contacts.reserve(reserved);
  for (auto* each : {&u, &p, &push}) each->reserve(reserved);
  sizes.reserve(reserved);
  for (VecX* x : {&p_before, &v_before}) x->setZero(scene.model.tree.n_v);
  pile.reserve(boxes);
  pile.body_of.assign(static_cast<std::size_t>(scene.trees.first.back()), -1);
  reserve(W, boxes, 6 * static_cast<std::size_t>(scene.trees.most));
}

void remember(const HalfKick& kick, Memory& memory) {
  for (std::size_t i = 0; i < kick.contacts.size(); ++i) {
    const int slot = kick.contacts[i]->slot;
    std::vector<ImpulseMemory>& known = slot < 0 ? memory.dry : memory.impulses;
    const auto k = static_cast<std::size_t>(slot < 0 ? -2 - slot : slot);
    if (k < known.size() && known[k].arc == memory.arcs) known[k].p = (known[k].p + kick.p[i]) / 2;
  }
}

bool finish(const Scene& scene, double t, const std::vector<double>& motion, ArcWork& work,
            Node& node, HalfKick& kick) {
  kick.impulses.clear();
  kick.contacts.clear();
  kick.residual = kick.dry_work = 0;
  node.v = work.arc.v;
  ArcScratch& s = work.scratch;
  const bool is_placed = s.is_placed && s.q_placed == work.arc.q_end;
  s.is_placed = false;
  move_node(scene, t, work.arc.q_end, work.arc.p_end, motion, is_placed ? &s.w_end : nullptr, node);
  if (node.loops.some && !set_velocity_at_node(scene, node)) return false;
  if (!find_contacts(scene, node)) return false;
  if (work.rows.count == 0) return true;
  // where something was held, all of it may have parted
  const bool is_held = count_pressed(work.rows) > 0 || !node.dry.empty();
  if (is_held && !node.has_factors && !set_velocity_at_node(scene, node)) return false;
  list_contacts(scene, work, node, kick);
  if (!kick.contacts.empty()) {
    share(scene, node, kick);
    if (node.loops.some) take_momentum(scene, node);
  }
  return true;
}

}  // namespace saltus
