#include "variational/arc/finish.hpp"

#include <algorithm>
#include <cmath>

namespace saltus {
namespace {

/// What the row held, as a contact at the node: its own where the node has it, and one with the
/// plane or edge that it was held by where not.
/// @return nullptr where edges have come to be parallel
Contact* held_contact(const Scene& scene, const Row& row, std::size_t used, Node& node,
                      HalfKick& kick) {
  const int contact = node.contact_at(row.slot);
  if (contact >= 0 && !row.is_frozen) return &node.contacts[contact];
  const Gap g = pair_gap(scene.model.tree, node.kin, row.watched());
  if (!std::isfinite(g.phi)) return nullptr;
  Contact& own = kick.own[used];
  write_contact(scene, typical_speed(scene, node), row.slot, row.watched(), g, node, own);
  return &own;
}

/// Those that the arc pressed, and of those that rested at its start and were not pressed what
/// approaches: that has not come here by itself.
void list_contacts(const Scene& scene, const Rows& rows, Node& node, HalfKick& kick) {
  kick.contacts.clear();
  kick.p.clear();
  while (static_cast<int>(kick.own.size()) < rows.count) kick.own.push_back(fresh_contact(scene));
  for (int i = 0; i < rows.count; ++i) {
    const Row& row = rows.row[i];
    Contact* c = nullptr;
    if (row.is_joint()) {
      c = &node.dry[-1 - row.contact];
      c->bound = rows.tau / 2 * node.dry_force[-1 - row.contact];
      c->slot = row.slot;
    } else if (row.is_pressed()) {
      c = held_contact(scene, row, static_cast<std::size_t>(i), node, kick);
    } else if (const int contact = node.contact_at(row.slot); contact >= 0) {
      c = &node.contacts[contact];
      if (c->motion != Contact::Motion::approaches) continue;
    }
    if (c == nullptr) continue;
    kick.contacts.push_back(c);
    kick.p.push_back(row.p);  // the opening half kick is near
  }
}

/// The law, at all of them together. Changes p, v and what contacts do.
void share(const Scene& scene, Node& node, HalfKick& kick) {
  set_contact_blocks(scene, kick.contacts, node, kick.neighbours, kick.W, kick.u);
  kick.pile.reserve(kick.contacts.size());
  add_rates(kick.W, kick.p, kick.u);
  kick.residual = settle_for_sure(kick.W, kick.pile, kick.u, kick.p).excess;
  kick.unlawful =
      kick.contacts[static_cast<std::size_t>(most_lawless(kick.W, kick.u, kick.p))]->slot;
  kick.dry_rate.clear();
  for (const Contact* c : kick.contacts) {
    kick.dry_rate.push_back(c->bound > 0 ? dot(scene.trees, c->n, node.v) : 0);
  }
  for (std::size_t i = 0; i < kick.contacts.size(); ++i) {
    const Contact& c = *kick.contacts[i];
    apply(scene, c, kick.p[i], node);
    if (c.bound > 0) continue;
    kick.impulses.push_back(acted(node, c, kick.p[i][0], across(c, kick.p[i])));
  }
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
  const std::size_t reserved = std::min<std::size_t>(pairs, 64);
  const std::size_t boxes = std::min<std::size_t>(pairs, 16);
  for (std::size_t i = 0; i < reserved; ++i) own.push_back(fresh_contact(scene));
  impulses.reserve(reserved);
  contacts.reserve(reserved);
  for (auto* each : {&u, &p}) each->reserve(reserved);
  pile.reserve(boxes);
  reserve(W, boxes);
}

bool finish(const Scene& scene, double t, const ArcWork& work, Node& node, HalfKick& kick) {
  kick.impulses.clear();
  kick.residual = kick.dry_work = 0;
  node.v = work.arc.v;
  place_node(scene, t, work.arc.q_end, work.arc.p_end, node);
  if (!find_contacts(scene, node)) return false;
  if (work.rows.count == 0) return true;
  // where something was held, all of it may have parted
  const bool is_held = count_pressed(work.rows) > 0 || !node.dry.empty();
  if (is_held && !node.has_factors && !set_velocity_at_node(scene, node)) return false;
  list_contacts(scene, work.rows, node, kick);
  if (!kick.contacts.empty()) share(scene, node, kick);
  return true;
}

}  // namespace saltus
