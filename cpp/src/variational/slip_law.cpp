#include "variational/slip_law.hpp"

#include <algorithm>
#include <cmath>

#include "variational/holds.hpp"
#include "variational/slip_blocks.hpp"

namespace saltus {
namespace {

using Kind = ArcConstraint::Kind;

/// How fast a held pair slides in the arc's middle.
Vec2 slide_of(const ModelData& model, const ArcConstraint& c, Flight& f) {
  SlipRows& row = f.slip.row[0];
  add_slide_rows(model, c, f.scratch, row.t0, row.t1);
  return {row.t0.dot(f.arc.v), row.t1.dot(f.arc.v)};
}

/// How far a hold is from Coulomb's law: by a part of the forces, or of the speeds that there are.
double lawlessness_of(const ModelData& model, const Node& node, double size, const ArcConstraint& c,
                      Flight& f) {
  const Contact& contact = contact_of(node, c);
  if (c.lambda < -1e-12 * size) return 1;
  if (!(contact.friction > 0) || !(c.lambda > 1e-12 * size)) return 0;
  if (c.grip.mode == Grip::Mode::none) return 1;
  // of the speeds that there are: what hardly slides has hardly a direction
  const double least = std::max(contact.epsilon_u, 1e-14);
  if (c.grip.mode == Grip::Mode::slides) {
    const Vec2 slide = slide_of(model, c, f);
    return strict * (slide - slide.norm() * c.grip.slide).norm() / least;
  }
  const double limit = contact.friction * c.lambda;
  const double over = (impulse_of(node, c, f).tail<2>().norm() - limit) / (contact.friction * size);
  // a tangent that is no unknown follows from others, as long as they are held
  if (c.carried.isZero(0)) return over;
  return std::max(over, strict * slide_of(model, c, f).norm() / least);
}

}  // namespace

double lawlessness(const ModelData& model, const Node& node, Flight& f) {
  double most = 0, size = 0;
  for (int i = 0; i < f.active; ++i) {
    if (f.constraints[i].kind == Kind::hold) size = std::max(size, f.constraints[i].lambda);
  }
  for (int i = 0; i < f.active; ++i) {
    const ArcConstraint& c = f.constraints[i];
    if (c.kind != Kind::hold) continue;
    const double each = lawlessness_of(model, node, size, c, f);
    if (!(each > most)) continue;
    most = each;
    f.closing = c.place;
  }
  place_end(model, f.arc.q_end, f.scratch);
  for (int i = 0; i < node.touching; ++i) {
    const Contact& c = node.contacts[i];
    if (c.motion != Contact::Motion::rests || node.held[c.pair]) continue;
    const Pair& pair = prepare_hold(model, c.pair, node, f).watched();
    const Gap g = pair_gap_at_end(model, pair, f.scratch);
    // a hundredth of what touches: many that sank each by its own part would fit no motion
    if (g.phi >= std::min(0.0, c.phi) - 1e-2 * node.pool[c.pair].touch) continue;
    f.closing = c.pair;
    return 1;
  }
  return most;
}

}  // namespace saltus
