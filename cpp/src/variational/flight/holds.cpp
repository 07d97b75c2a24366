#include "variational/flight/holds.hpp"

#include <algorithm>

#include "saltus/collision/slip.hpp"
#include "variational/flight/launch.hpp"

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

/// A sharp corner that slides over the border of a face has no normal there: it is held in the
/// plane of the face, and at the next node it is beside it and free.
void hold_in_face(const ModelData& model, const Contact& contact, const Pair& pair,
                  const Node& node, ArcConstraint& c) {
  c.face.kind = Whole{};
  c.face.on_a = pair.on_a;
  c.face.on_b.joint = pair.on_b.joint;
  c.face.chain = pair.chain;  // no allocation: room for the deepest is reserved
  c.face.touch = pair.touch;
  put_plane_on_b(model.tree, node.kin, contact.p_WB, contact.n_W, c.face);
}

}  // namespace

ArcConstraint& prepare_hold(const ModelData& model, int pair, const Node& node, Flight& f) {
  const Contact& contact = node.contacts[node.contact_of[pair]];
  ArcConstraint& c = next_constraint(f, ArcConstraint::Kind::hold, pair, 0);
  --f.active;
  // many that touch cannot all be brought to 0: with friction they stay where rounding left them
  if (node.friction.any) c.target = std::min(contact.phi, 0.0);
  c.pair = &node.pool[pair];
  c.tangential.setZero();
  c.axis = tangent_axis(contact.n_W);
  c.in_face = is_sharp(*c.pair) || f.level[pair];
  if (c.in_face) hold_in_face(model, contact, *c.pair, node, c);
  return c;
}

bool hold(const ModelData& model, int pair, Node& node, Flight& f) {
  if (f.active + 1 == static_cast<int>(f.constraints.size())) return false;
  ArcConstraint& c = prepare_hold(model, pair, node, f);
  c.n.setZero();
  add(node.trees, 1, node.contacts[node.contact_of[pair]].n, c.n);
  ++f.active;
  node.held[pair] = 1;
  return true;
}

void release(int i, Node& node, Flight& f) {
  node.held[f.constraints[i].place] = 0;
  std::swap(f.constraints[i], f.constraints[f.active - 1]);
  --f.active;
}

namespace {

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

/// Holds the end of a rod in the plane of its face from now on, and anew if it is held.
void level_end(const ModelData& model, int pair, Node& node, Flight& f) {
  f.level[pair] = 1;
  for (int k = 0; k < f.active; ++k) {
    const ArcConstraint& held = f.constraints[k];
    if (held.kind != ArcConstraint::Kind::hold || held.place != pair) continue;
    release(k, node, f);
    hold(model, pair, node, f);
    return;
  }
}

}  // namespace

bool level_held_ends(const ModelData& model, Node& node, Flight& f) {
  bool changed = false;
  for (int i = 0; i < node.touching; ++i) {
    const int pair = node.contacts[i].pair;
    if (!node.held[pair] || f.level[pair] || !is_rod_end(model, node.pool[pair])) continue;
    level_end(model, pair, node, f);
    changed = true;
  }
  return changed;
}

bool start_holds(const ModelData& model, Node& node, Flight& f) {
  for (int i = 0; i < node.touching; ++i) {
    const Contact& c = node.contacts[i];
    if (is_rod_end(model, node.pool[c.pair])) f.level[c.pair] = rests_on_edge(c.pair, node);
  }
  for (int i = 0; i < node.touching; ++i) {
    const Contact& c = node.contacts[i];
    if (!node.held[c.pair]) continue;
    if (c.motion != Contact::Motion::rests) {
      node.held[c.pair] = 0;
    } else if (!hold(model, c.pair, node, f)) {
      return false;
    }
  }
  return true;
}

double floor_of(const Node& node, int pair) {
  const int contact = node.contact_of[pair];
  const double phi = contact < 0 ? node.sunk[pair] : node.contacts[contact].phi;
  return std::min(0.0, phi) - node.pool[pair].touch;
}

bool level_rods(const ModelData& model, Node& node, Flight& f) {
  bool changed = false;
  for (int i = 0; i < node.touching; ++i) {
    const Contact& c = node.contacts[i];
    if (c.motion != Contact::Motion::rests || f.level[c.pair]) continue;
    if (!is_rod_end(model, node.pool[c.pair])) continue;
    place_end(model, f.arc.q_end, f.scratch);
    const Gap whole = pair_gap_at_end(model, *node.pool.solid(c.pair), f.scratch);
    if (whole.phi >= floor_of(node, c.pair)) continue;
    level_end(model, c.pair, node, f);
    changed = true;
  }
  return changed;
}

Holds update_holds(const ModelData& model, Node& node, Flight& f) {
  for (int i = 0; i < f.active; ++i) {
    const ArcConstraint& c = f.constraints[i];
    if (c.kind != ArcConstraint::Kind::hold || c.lambda >= 0 || f.flips[c.place] >= 2) continue;
    ++f.flips[c.place];
    release(i, node, f);
    return Holds::changed;
  }
  bool changed = false, placed = false;
  for (int i = 0; i < node.touching; ++i) {
    const Contact& c = node.contacts[i];
    if (c.motion != Contact::Motion::rests || node.held[c.pair]) continue;
    if (!placed) place_end(model, f.arc.q_end, f.scratch);
    placed = true;
    const Pair& pair = prepare_hold(model, c.pair, node, f).watched();
    if (pair_gap_at_end(model, pair, f.scratch).phi >= floor_of(node, c.pair)) continue;
    if (!hold(model, c.pair, node, f)) return Holds::too_many;
    changed = true;
  }
  changed = changed || level_rods(model, node, f);
  return changed ? Holds::changed : Holds::unchanged;
}

}  // namespace saltus
