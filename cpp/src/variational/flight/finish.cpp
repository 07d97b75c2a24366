#include "variational/flight/finish.hpp"

#include <cmath>

#include "variational/node/delassus.hpp"

namespace saltus {
namespace {

/// The rows that share the half kick, as contacts at the node: those that the arc pressed, and of
/// those that rested at its start and were not pressed what approaches. That has not come here by
/// itself.
void list_closing(const ModelData& model, const StepOptions& options, Node& node, Rows& rows) {
  const double speed = typical_speed(model, options, node);
  rows.closing.clear();
  rows.p.clear();
  for (int i = 0; i < rows.count; ++i) {
    Row& row = rows.row[i];
    const bool is_pressed = row.is_active && row.p[0] > 0;
    const Pair& pair = is_pressed ? row.watched() : *row.pair;
    const Gap g = pair_gap(model.tree, node.kin, pair);
    if (!std::isfinite(g.phi)) continue;  // edges that have come to be parallel
    if (!is_pressed && (g.phi > pair.touch || is_silent(model.tree, node.kin, pair, g))) {
      continue;
    }
    write_contact(model, options, speed, row.place, pair, g, node, row.closing);
    if (!is_pressed && row.closing.motion != Contact::Motion::approaches) continue;
    rows.closing.push_back(&row.closing);
    rows.p.push_back(is_pressed ? row.p : Vec3::Zero());  // the opening half kick is near
  }
}

}  // namespace

bool finish(const ModelData& model, const StepOptions& options, double t, Flight& f, Node& node) {
  node.t = t;
  node.q = f.arc.q_end;
  node.p = f.arc.p_end;
  node.v = f.arc.v;
  f.closings.clear();
  place_node(model, node);
  Rows& rows = f.rows;
  if (rows.count == 0) return find_contacts(model, options, node);
  if (!set_velocity_at_node(model, node)) return false;
  list_closing(model, options, node, rows);
  if (!rows.closing.empty()) {
    set_contact_blocks(model, rows.closing, node, rows.W, rows.u);
    rows.pile.reserve(rows.closing.size());
    for (int k = 0; k < rows.W.size(); ++k) {
      for (int e = rows.W.start[k]; e < rows.W.start[k + 1]; ++e) {
        rows.u[rows.W.contact[e]] += rows.W.block[e] * rows.p[k];
      }
    }
    rows.residual = settle_for_sure(rows.W, rows.pile, rows.u, rows.p).excess;
    for (std::size_t i = 0; i < rows.closing.size(); ++i) {
      const Contact& c = *rows.closing[i];
      apply(c, rows.p[i], node);
      f.closings.push_back(acted(node, c, rows.p[i][0], across(c, rows.p[i])));
    }
  }
  return find_contacts(model, options, node);
}

}  // namespace saltus
