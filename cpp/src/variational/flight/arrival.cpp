#include "variational/flight/arrival.hpp"

#include <cmath>

namespace saltus {
namespace {

constexpr double same_face = 0.1;  ///< [rad] between normals, at most

/// What the arc held and what does not face the other any more, as a contact: corners with the
/// plane of their face, edges with the line of the other. A corner on the border of its face is on
/// another one too, but stays on that where it was held.
/// @return false where the mass matrix is singular.
bool keep_held(const ModelData& model, const StepOptions& options, const Flight& f, Node& node) {
  for (int i = 0; i < f.active; ++i) {
    const ArcConstraint& c = f.constraints[i];
    if (c.kind != ArcConstraint::Kind::hold) continue;
    const int contact = node.contact_of[c.place];
    if (contact >= 0 && !c.in_face) continue;
    const Gap g = pair_gap(model.tree, node.kin, c.watched());
    if (contact >= 0 && (node.contacts[contact].n_W - g.n_W).norm() < same_face) continue;
    if (!std::isfinite(g.phi)) continue;  // edges that have come to be parallel
    // where no pair is near nothing was asked of the node's v
    if (node.broad.candidates.empty() && !set_velocity_at_node(model, node)) return false;
    const double speed = typical_speed(model, options, node);
    write_contact(model, options, speed, c.place, c.watched(), g, node);
    node.held[c.place] = 1;
  }
  return true;
}

/// What rests at the node, before the arc's end becomes the node.
void note_resting(Node& node) {
  node.rested.clear();
  for (int i = 0; i < node.touching; ++i) {
    const Contact& c = node.contacts[i];
    if (c.motion == Contact::Motion::rests) node.rested.push_back(c.pair);
  }
}

/// What rested at the arc's start, was not pressed, and still touches has not come here by itself:
/// its approach is the half kick's.
void keep_rested(Node& node) {
  for (const int pair : node.rested) {
    const int contact = node.contact_of[pair];
    if (contact < 0 || node.contacts[contact].motion != Contact::Motion::approaches) continue;
    node.held[pair] = 1;
  }
}

/// Takes off what was added beyond the first `touching`.
void drop_added(int touching, Node& node) {
  while (node.touching > touching) {
    node.held[node.contacts[node.touching - 1].pair] = 0;
    drop_last_contact(node);
  }
}

}  // namespace

bool arrive_at_node(const ModelData& model, const StepOptions& options, double t, Flight& f,
                    Node& node) {
  node.t = t;
  node.q = f.arc.q_end;
  node.p = f.arc.p_end;
  node.v = f.arc.v;
  note_resting(node);
  if (!find_contacts(model, options, node)) return false;
  const int touching = node.touching;
  if (!keep_held(model, options, f, node)) return false;
  keep_rested(node);
  settle_held_contacts(model, node);
  drop_added(touching, node);
  return true;
}

}  // namespace saltus
