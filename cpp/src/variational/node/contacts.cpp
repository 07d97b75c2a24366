// What touches at a node.
#include <algorithm>
#include <cmath>
#include <limits>

#include "saltus/collision/slip.hpp"
#include "variational/node/node.hpp"

namespace saltus {
namespace {

Contact& next_in_pool(const Scene& scene, Node& node) {
  if (node.touching == static_cast<int>(node.contacts.size())) {
    node.contacts.push_back(fresh_contact(scene));
  }
  return node.contacts[node.touching];
}

void reset_contacts(Node& node) {
  for (int i = 0; i < node.touching; ++i) node.contact_of[node.contacts[i].slot] = -1;
  node.touching = 0;
  for (const int slot : node.silent) node.sunk[slot] = 0;
  node.silent.clear();
}

/// [m] Gaps beyond this do not close within epsilon_t h: no pair closes faster than the bodies
/// move, and 100 times the typical speed bounds light bodies'.
double nearly(const StepOptions& options, double speed) {
  return 100 * options.simultaneous * options.h * speed;
}

/// Between the lines of edges, which is the distance of edges at least.
double line_distance(const Pair& pair, const Gap& g) {
  if (!std::holds_alternative<Crossing>(pair.kind) || !std::isfinite(g.d)) {
    return -std::numeric_limits<double>::infinity();
  }
  return std::abs(g.d) - (g.d - g.phi);  // less the radii
}

/// The gap of a pair, noted where it is a distance.
Gap measured_gap(const Scene& scene, double near, int slot, Node& node) {
  const Pair& pair = node.pool[slot];
  const Gap g = pair_gap(scene.model.tree, node.kin, pair);
  const double distance = pair.kind == PairKind::crossing ? line_distance(pair, g) : g.phi;
  if (distance > near) node.clearances.note(Clearances::pairs, slot, pair, distance);
  return g;
}

bool are_edges_near(const Scene& scene, double near, int slot, Node& node) {
  const Pair& pair = node.pool[slot];
  if (node.clearances.least(Clearances::pairs, slot, pair) > near) return false;
  if (node.clearances.most(Clearances::pairs, slot, pair) <= near) return true;
  const double distance = edge_distance(scene.model.tree, node.kin, pair);
  if (std::holds_alternative<Crossing>(pair.kind))
    node.clearances.note(Clearances::pairs, slot, pair, distance);
  return distance <= near;
}

/// A pair that touches but does not face the other is no contact; from here on it may not sink.
void note_silent(const Scene& scene, double near, int slot, const Gap& g, Node& node) {
  const Pair& pair = node.pool[slot];
  if (pair.kind == PairKind::crossing) {
    if (!are_edges_near(scene, near, slot, node)) return;
    node.sunk[slot] = -std::numeric_limits<double>::infinity();
  } else {
    node.sunk[slot] = g.phi;
  }
  node.silent.push_back(slot);
}

/// [m/s] of a against b at a point. `row` is scratch.
Vec3 motion_of_point(const Scene& scene, const Pair& pair, const Vec3& P_W, Node& node,
                     ContactVector& row) {
  Vec3 motion;
  for (int k = 0; k < 3; ++k) {
    add_motion_gradient(scene.model.tree, node.kin, pair, P_W, Vec3::Unit(k), node.dense);
    shape_row(scene.model, scene.trees, pair, row);
    take_from(scene.trees, node.dense, row);
    motion[k] = dot(scene.trees, row, node.v);
  }
  return motion;
}

/// Adds the pair to the contacts if it touches, or would within epsilon_t h.
void add_if_touching(const Scene& scene, double speed, int slot, Node& node) {
  const Tree& tree = scene.model.tree;
  const StepOptions& options = scene.options;
  const Pair& pair = node.pool[slot];
  const double soon = options.simultaneous * options.h, near = pair.touch + nearly(options, speed);
  const Gap g = measured_gap(scene, near, slot, node);
  if (pair.kind == PairKind::whole && g.phi > near) return;
  if (is_silent(tree, node.kin, pair, g)) return note_silent(scene, near, slot, g, node);
  if (g.phi > near) return;
  Contact& c = next_in_pool(scene, node);
  write_contact(scene, speed, slot, pair, g, node, node.dense, c);
  if (c.motion == Contact::Motion::approaches && !pair.inward.empty()) {
    const Vec3 motion = motion_of_point(scene, pair, contact_point(g), node, c.column);
    const Gap other = pair_gap(tree, node.kin, pair, motion);
    write_contact(scene, speed, slot, pair, other, node, node.dense, c);
  }
  const bool touches = g.phi <= pair.touch || (c.u < 0 && g.phi <= -c.u * soon);
  if (touches && node.loops.some && is_held_by_loops(scene, c.n, node)) {
    // nothing pushes it away; so long as it does not close it is no contact
    if (c.motion == Contact::Motion::approaches) node.driven_together = slot;
    return;
  }
  if (touches) {
    node.contact_of[slot] = node.touching++;
  }
}

void set_tangents(const Scene& scene, const Gap& gap, const Pair& pair, const Node& node,
                  VecX& dense, Contact& c) {
  const Tangents t = tangents(gap.n_W, tangent_axis(gap.n_W));
  const Vec3 P = friction_point(gap, pair);
  for (int k = 0; k < 2; ++k) {
    c.t_W[k] = k == 0 ? t.t0 : t.t1;
    add_motion_gradient(scene.model.tree, node.kin, pair, P, c.t_W[k], dense);
    c.t[k] = c.n;  // its parts
    take_from(scene.trees, dense, c.t[k]);
  }
}

/// What the parts of two solids have found: lists from there on are theirs.
struct FirstOf {
  int contact = 0;
  std::size_t silent = 0;
};

void remove_contact(int at, Node& node) {
  node.contact_of[node.contacts[at].slot] = -1;
  const auto begin = node.contacts.begin();
  std::rotate(begin + at, begin + at + 1, begin + node.touching);  // the pool keeps its room
  --node.touching;
  for (int i = at; i < node.touching; ++i) node.contact_of[node.contacts[i].slot] = i;
}

/// The lowest point of a rim may be one of the four points that are watched on it. The two are one
/// contact, that of the rim: it is as low or lower wherever it rolls, so nothing is sought of the
/// point in the arc from here.
void leave_points_to_rim(int rim_contact, const FirstOf& first, Node& node) {
  constexpr double same_point = 1e-3;  // of the radius: rows of points so near are equal
  // by value: removing contacts moves the others
  const double phi = node.contacts[rim_contact].phi;
  const Vec3 point_W = node.contacts[rim_contact].point_W;
  const Pair& pair = node.pool[node.contacts[rim_contact].slot];
  const auto is_on_rim = [&](int slot) {
    const Pair& other = node.pool[slot];
    const auto* corner = std::get_if<Corner>(&other.kind);
    return corner != nullptr && other.a == pair.a &&
           corner->out.dot(std::get<Rim>(pair.kind).out) > 0;
  };
  const double apart = same_point * std::get<Cylinder>(pair.on_a.shape).radius;
  for (std::size_t i = first.silent; i < node.silent.size(); ++i) {
    const int slot = node.silent[i];
    if (!is_on_rim(slot) || node.sunk[slot] > phi + 2 * pair.touch) continue;
    node.sunk[slot] = -std::numeric_limits<double>::infinity();
  }
  for (int i = node.touching - 1; i >= first.contact; --i) {
    const Contact& c = node.contacts[i];
    if (!is_on_rim(c.slot) || (c.point_W - point_W).norm() > apart) continue;
    node.sunk[c.slot] = -std::numeric_limits<double>::infinity();
    node.silent.push_back(c.slot);
    remove_contact(i, node);
  }
}

/// Parts of two solids with the same witness are one contact.
void merge_witnesses(const FirstOf& first, Node& node) {
  for (int i = node.touching - 1; i >= first.contact; --i) {
    const int slot = node.contacts[i].slot;
    if (!std::holds_alternative<Rim>(node.pool[slot].kind)) continue;
    leave_points_to_rim(i, first, node);
    i = node.contact_of[slot];
  }
}

/// The lists by slot grow with the pool.
void fit(Node& node) {
  const auto slots = static_cast<std::size_t>(node.pool.size());
  node.clearances.fit(node.pool.size(), node.pool.solids());
  if (node.contact_of.size() >= slots) return;
  node.contact_of.resize(slots, -1);
  node.sunk.resize(slots, 0);
}

}  // namespace

void write_contact(const Scene& scene, double speed, int slot, const Pair& as, const Gap& g,
                   const Node& node, VecX& dense, Contact& c) {
  add_gap_gradient(scene.model.tree, node.kin, as, g, dense);
  shape_row(scene.model, scene.trees, as, c.n);
  take_from(scene.trees, dense, c.n);
  c.slot = slot;
  c.phi = g.phi;
  c.n_W = g.n_W;
  c.p_WB = g.p_WB;
  c.point_W = contact_point(g);
  const ContactProperties properties = properties_of(scene, slot, node);
  c.restitution = properties.restitution;
  c.friction = properties.friction;
  classify(scene, node, speed, c);
  if (c.friction > 0) set_tangents(scene, g, as, node, dense, c);
}

Contact fresh_contact(const Scene& scene) {
  Contact fresh;
  const auto most = 2 * static_cast<std::size_t>(scene.trees.most);
  for (ContactVector* each : {&fresh.n, &fresh.column}) each->value.reserve(most);
  for (int k = 0; k < 2 && scene.has_friction; ++k) {
    for (ContactVector* each : {&fresh.t[k], &fresh.t_column[k]}) each->value.reserve(most);
  }
  return fresh;
}

void forget_pairs(Node& node) {
  reset_contacts(node);
  node.pool.clear();
  node.contact_of.assign(static_cast<std::size_t>(node.pool.size()), -1);
  node.sunk.assign(node.contact_of.size(), 0);
}

namespace {

/// True where a joint's stop may touch, or would within epsilon_t h; node.dq is the way until then.
bool is_near_a_stop(const Scene& scene, const Node& node) {
  for (int slot = 0; slot < node.pool.limits(); ++slot) {
    const Pair& pair = node.pool[slot];
    const int joint = pair.on_a.joint;
    const double phi = pair.stop.side * (node.kin.joint[joint].s - pair.stop.bound);
    // 100: the velocity here may be another than that of the arc that ended here, as in `nearly`
    const double way = 100 * std::abs(node.dq[scene.model.tree.drive[joint].velocity]);
    if (phi <= pair.touch + way) return true;
  }
  return false;
}

}  // namespace

/// True where parts of two solids may touch, or would within epsilon_t h.
bool is_solid_near(const Scene& scene, double speed, int slot, Node& node) {
  const Pair& solid = *node.pool.solid(slot);
  const double near = solid.touch + nearly(scene.options, speed);
  const int number = node.pool.solid_number(slot);
  if (node.clearances.least(Clearances::solids, number, solid) > near) return false;
  if (node.clearances.most(Clearances::solids, number, solid) <= near) return true;
  const double phi = pair_gap(scene.model.tree, node.kin, solid).phi;
  node.clearances.note(Clearances::solids, number, solid, phi);
  return phi <= near;
}

bool find_contacts(const Scene& scene, Node& node) {
  const ModelData& model = scene.model;
  if (!model.has_gaps()) return true;
  node.dq = scene.options.simultaneous * scene.options.h * node.v;
  if (!model.pairs.empty()) {
    find_candidates(model.tree, model.shapes, model.pairs, node.kin, node.dq,
                    most_touch(scene, node), node.broad);
  }
  reset_contacts(node);
  node.driven_together = -1;
  const bool is_at_a_stop = is_near_a_stop(scene, node);
  if (node.broad.candidates.empty() && !is_at_a_stop) return true;
  if (!node.has_factors && !set_velocity_at_node(scene, node)) return false;
  const double speed = typical_speed(scene, node), near = nearly(scene.options, speed);
  for (int slot = 0; is_at_a_stop && slot < node.pool.limits(); ++slot) {
    add_if_touching(scene, speed, slot, node);
  }
  const Pair* solid = nullptr;
  bool is_near = true;
  double coordinate = 0;  // of the two bodies, whose parts follow each other
  FirstOf first;
  for (const int number : node.broad.candidates) {
    const int slot = node.pool.slot_of(model, number);
    fit(node);
    const Pair* of_parts = node.pool.solid(slot);
    if (of_parts == nullptr || of_parts != solid) {
      coordinate = largest_coordinate(scene, node.pool[slot], node);
    }
    if (of_parts != solid) {  // no part is nearer than the whole
      node.pool.know_ulps(slot, coordinate);
      merge_witnesses(first, node);
      solid = of_parts;
      is_near = solid == nullptr || is_solid_near(scene, speed, slot, node);
      first = {node.touching, node.silent.size()};
    }
    const Pair& pair = node.pool[slot];
    if (!is_near || node.clearances.least(Clearances::pairs, slot, pair) > pair.touch + near)
      continue;
    node.pool.know_ulps(slot, coordinate);
    add_if_touching(scene, speed, slot, node);
  }
  merge_witnesses(first, node);
  return true;
}

}  // namespace saltus
