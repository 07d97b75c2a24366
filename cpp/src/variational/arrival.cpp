#include "variational/arrival.hpp"

namespace saltus {
namespace {

/// Adds what the arc held in the plane of a face and does not touch it any more, as contacts with
/// that plane.
/// @return false where the mass matrix is singular.
bool add_slid_over(const ModelData& model, const StepOptions& options, const Flight& f,
                   Node& node) {
  for (int i = 0; i < f.active; ++i) {
    const ArcConstraint& c = f.constraints[i];
    if (c.kind != ArcConstraint::Kind::hold || !c.in_face || node.contact_of[c.place] >= 0) continue;
    // where no pair is near nothing was asked of the node's v
    if (node.broad.candidates.empty() && !set_velocity_at_node(model, node)) return false;
    const double speed = typical_speed(model, options, node);
    add_contact(model, options, speed, c.place, c.face, pair_gap(model.tree, node.kin, c.face),
                node);
    node.held[c.place] = 1;
  }
  return true;
}

/// Takes off what was added.
void drop_slid_over(int touching, Node& node) {
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
  if (!find_contacts(model, options, node)) return false;
  const int touching = node.touching;
  if (!add_slid_over(model, options, f, node)) return false;
  settle_held_contacts(model, node);
  drop_slid_over(touching, node);
  return true;
}

}  // namespace saltus
