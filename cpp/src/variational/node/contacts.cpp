// What touches at a node.
#include <algorithm>
#include <cmath>
#include <limits>

#include "saltus/collision/slip.hpp"
#include "variational/node/node.hpp"

namespace saltus {
namespace {

Contact& next_in_pool(Node& node) {
  if (node.touching == static_cast<int>(node.contacts.size())) {
    node.contacts.push_back(fresh_contact(node.trees, node.friction.any));
  }
  return node.contacts[node.touching];
}

void reset_contacts(Node& node) {
  for (int i = 0; i < node.touching; ++i) node.contact_of[node.contacts[i].pair] = -1;
  node.touching = 0;
  for (const int pair : node.silent) node.sunk[pair] = 0;
  node.silent.clear();
}

/// [m] Gaps beyond this do not close within epsilon_t h: no pair closes faster than the bodies
/// move, and 100 times the typical speed bounds light bodies'.
double nearly(const StepOptions& options, double speed) {
  return 100 * options.simultaneous * options.h * speed;
}

/// A pair that touches but does not face the other is no contact; from here on it may not sink.
void note_silent(const ModelData& model, double near, int index, const Gap& g, Node& node) {
  const Pair& pair = node.pool[index];
  if (pair.kind == PairKind::crossing) {
    if (edge_distance(model.tree, node.kin, pair) > near) return;
    node.sunk[index] = -std::numeric_limits<double>::infinity();
  } else {
    node.sunk[index] = g.phi;
  }
  node.silent.push_back(index);
}

/// [m/s] of a against b at a point. `row` is scratch.
Vec3 motion_of_point(const ModelData& model, const Pair& pair, const Vec3& P_W, Node& node,
                     ContactVector& row) {
  Vec3 motion;
  for (int k = 0; k < 3; ++k) {
    add_motion_gradient(model.tree, node.kin, pair, P_W, Vec3::Unit(k), node.dense);
    shape_row(model, node.trees, pair, row);
    take_from(node.trees, node.dense, row);
    motion[k] = dot(node.trees, row, node.v);
  }
  return motion;
}

/// Adds the pair to the contacts if it touches, or would within epsilon_t h.
void add_if_touching(const ModelData& model, const StepOptions& options, double speed, int index,
                     Node& node) {
  const Pair& pair = node.pool[index];
  const Gap g = pair_gap(model.tree, node.kin, pair);
  const double soon = options.simultaneous * options.h, near = pair.touch + nearly(options, speed);
  if (pair.kind == PairKind::whole && g.phi > near) return;
  if (is_silent(model.tree, node.kin, pair, g)) return note_silent(model, near, index, g, node);
  if (g.phi > near) return;
  Contact& c = next_in_pool(node);
  write_contact(model, options, speed, index, pair, g, node, c);
  if (c.motion == Contact::Motion::approaches && !pair.inward.empty()) {
    const Vec3 motion = motion_of_point(model, pair, contact_point(g), node, c.column);
    const Gap other = pair_gap(model.tree, node.kin, pair, motion);
    write_contact(model, options, speed, index, pair, other, node, c);
  }
  if (g.phi <= pair.touch || (c.u < 0 && g.phi <= -c.u * soon)) {
    node.contact_of[index] = node.touching++;
  }
}

}  // namespace

void write_contact(const ModelData& model, const StepOptions& options, double speed, int place,
                   const Pair& as, const Gap& g, Node& node, Contact& c) {
  const Pair& pair = node.pool[place];
  add_gap_gradient(model.tree, node.kin, as, g, node.dense);
  shape_row(model, node.trees, as, c.n);
  take_from(node.trees, node.dense, c.n);
  c.pair = place;
  c.phi = g.phi;
  c.n_W = g.n_W;
  c.p_WB = g.p_WB;
  c.point_W = contact_point(g);
  const ContactProperties& properties = model.materials.between(pair.a, pair.b);
  c.restitution = properties.restitution;
  c.friction = properties.friction;
  classify(node, speed, options.rest, c);
  if (c.friction > 0) set_tangents(model, g, as, node, c);
}

bool set_velocity_at_node(const ModelData& model, Node& node) {
  mass_pass(model.packed, node.w);
  if (!factorize(model.tree, model.packed, node.w, 0, node.M)) return false;
  node.has_factors = true;
  node.v = node.p;
  solve(model.tree, model.packed, node.M, node.v);
  return node.v.allFinite();
}

bool start_from_momenta(const ModelData& model, Node& node) {
  set_coordinates(model.tree, model.packed, node.q, node.w);
  place(model.packed, node.w);
  return set_velocity_at_node(model, node);
}

Contact fresh_contact(const TreeCoordinates& trees, bool with_friction) {
  Contact fresh;
  const auto most = 2 * static_cast<std::size_t>(trees.most);
  for (ContactVector* each : {&fresh.n, &fresh.column}) each->value.reserve(most);
  for (int k = 0; k < 2 && with_friction; ++k) {
    for (ContactVector* each : {&fresh.t[k], &fresh.t_column[k]}) each->value.reserve(most);
  }
  return fresh;
}

Contact::Motion motion_of(double u, double epsilon_u) {
  if (u < -epsilon_u) return Contact::Motion::approaches;
  return u > epsilon_u ? Contact::Motion::leaves : Contact::Motion::rests;
}

void classify(const Node& node, double speed, double relative, Contact& c) {
  c.u = dot(node.trees, c.n, node.v);
  c.epsilon_u = relative * (speed + dot_sizes(node.trees, c.n, node.v));
  c.motion = motion_of(c.u, c.epsilon_u);
}

double typical_speed(const ModelData& model, const StepOptions& options, const Node& node) {
  const double twice_T = std::max(0.0, node.p.dot(node.v));
  return std::sqrt(twice_T / node.total_mass) + options.h * model.mass.gravity.norm();
}

int place_of(const ModelData& model, int number, Node& node) {
  const int place = node.pool.place_of(model, number);
  const auto pairs = static_cast<std::size_t>(node.pool.size());
  if (node.contact_of.size() < pairs) {
    node.contact_of.resize(pairs, -1);
    node.sunk.resize(pairs, 0);
  }
  return place;
}

void forget_pairs(Node& node) {
  reset_contacts(node);
  node.pool.clear();
  node.contact_of.assign(static_cast<std::size_t>(node.pool.size()), -1);
  node.sunk.assign(node.contact_of.size(), 0);
}

void place_node(const ModelData& model, Node& node) {
  node.has_factors = false;
  if (model.pairs.empty()) return;
  set_coordinates(model.tree, model.packed, node.q, node.w);
  place(model.packed, node.w);
  copy_poses(model.tree, model.packed, node.w, node.kin);
}

bool find_contacts(const ModelData& model, const StepOptions& options, Node& node) {
  if (model.pairs.empty()) return true;
  node.dq = options.simultaneous * options.h * node.v;
  find_candidates(model.tree, model.shapes, model.pairs, node.kin, node.dq, node.most_touch,
                  node.broad);
  reset_contacts(node);
  if (node.broad.candidates.empty()) return true;
  if (!node.has_factors && !set_velocity_at_node(model, node)) return false;
  const double speed = typical_speed(model, options, node);
  const Pair* solid = nullptr;
  bool is_near = true;
  for (const int number : node.broad.candidates) {
    const int place = place_of(model, number, node);
    if (node.pool.solid(place) != solid) {  // no part is nearer than the whole
      solid = node.pool.solid(place);
      is_near = solid == nullptr ||
                pair_gap(model.tree, node.kin, *solid).phi <= solid->touch + nearly(options, speed);
    }
    if (is_near) add_if_touching(model, options, speed, place, node);
  }
  return true;
}

}  // namespace saltus
