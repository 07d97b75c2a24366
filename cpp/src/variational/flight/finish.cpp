#include "variational/flight/finish.hpp"

#include <cmath>

#include "variational/node/delassus.hpp"

namespace saltus {
namespace {

/// The rows that share the half kick, as contacts at the node: those that the arc pressed, and of
/// those that rested at its start and were not pressed what approaches. That has not come here by
/// itself.
/// @return false where the mass matrix is singular.
bool list_closing(const ModelData& model, const StepOptions& options, Node& node, Rows& rows) {
  rows.closing.clear();
  rows.p.clear();
  for (int i = 0; i < rows.count; ++i) {
    Row& row = rows.row[i];
    const int contact = node.contact_of[row.place];
    Contact* c = contact < 0 ? nullptr : &node.contacts[contact];
    const bool is_pressed = row.is_active && row.p[0] > 0;
    if (!is_pressed && (c == nullptr || c->motion != Contact::Motion::approaches)) continue;
    if (is_pressed && (c == nullptr || row.is_frozen)) {
      const Gap g = pair_gap(model.tree, node.kin, row.watched());
      if (!std::isfinite(g.phi)) continue;  // edges that have come to be parallel
      if (!node.has_factors && !set_velocity_at_node(model, node)) return false;
      c = &row.closing;
      write_contact(model, options, typical_speed(model, options, node), row.place, row.watched(),
                    g, node, *c);
    }
    rows.closing.push_back(c);
    rows.p.push_back(is_pressed ? row.p : Vec3::Zero());  // the opening half kick is near
  }
  return true;
}

/// The law, at all of them together. Changes p, v and what contacts do.
void share_half_kick(const ModelData& model, Node& node, Flight& f) {
  Rows& rows = f.rows;
  set_contact_blocks(model, rows.closing, node, rows.W, rows.u);
  rows.pile.reserve(rows.closing.size());
  add_rates(rows.W, rows.p, rows.u);
  rows.residual = settle_for_sure(rows.W, rows.pile, rows.u, rows.p).excess;
  for (std::size_t i = 0; i < rows.closing.size(); ++i) {
    const Contact& c = *rows.closing[i];
    apply(c, rows.p[i], node);
    f.closings.push_back(acted(node, c, rows.p[i][0], across(c, rows.p[i])));
  }
  refresh_motions(node);
}

}  // namespace

bool finish(const ModelData& model, const StepOptions& options, double t, Flight& f, Node& node) {
  node.t = t;
  node.q = f.arc.q_end;
  node.p = f.arc.p_end;
  node.v = f.arc.v;
  f.closings.clear();
  place_node(model, node);
  if (!find_contacts(model, options, node)) return false;
  if (!list_closing(model, options, node, f.rows)) return false;
  if (!f.rows.closing.empty()) share_half_kick(model, node, f);
  return true;
}

}  // namespace saltus
