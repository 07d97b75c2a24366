#include "variational/node/node.hpp"

#include <algorithm>
#include <cmath>

namespace saltus {
namespace {

/// As many as can touch in a plain scene; a pool that is too small grows once.
constexpr std::size_t contacts_reserved = 64;

}  // namespace

Node::Node(const Scene& scene, PairPool& pairs)
    : pool(pairs),
      contact_of(static_cast<std::size_t>(pool.size()), -1),
      sunk(contact_of.size(), 0),
      w(scene.model.packed),
      kin(scene.model.tree),
      M(scene.model.tree, scene.model.packed),
      loops(scene.model),
      clearances(scene.model.shapes.size()),
      broad(scene.model.tree, scene.model.shapes, scene.model.pairs) {
  q.setZero(scene.model.tree.n_q);
  for (VecX* x : {&p, &v, &dq, &dense, &column}) x->setZero(scene.model.tree.n_v);
  const std::size_t reserved = std::min(static_cast<std::size_t>(pool.size()), contacts_reserved);
  for (std::size_t i = 0; i < reserved; ++i) contacts.push_back(fresh_contact(scene));
  clearances.fit(pool.size(), pool.solids());
  add_dry_joints(scene, *this);
  M.lock = locks_of(scene.model.tree, scene.model.equalities);
}

void add_dry_joints(const Scene& scene, Node& node) {
  const ModelData& model = scene.model;
  const VecX& friction = model.forces.friction;
  for (int i = 0; i < model.tree.joints() && friction.size() > 0; ++i) {
    const Drive& drive = model.tree.drive[i];
    const bool is_base = model.packed.slot_of_velocity[drive.velocity] == model.packed.slot[i];
    if (!is_base || !(friction[drive.velocity] > 0)) continue;
    Contact row = fresh_contact(scene);
    node.dense[drive.velocity] = 1;
    shape_row(model, scene.trees, make_stop(model.tree, i, {1, 0}), row.n);
    take_from(scene.trees, node.dense, row.n);
    node.dry.push_back(std::move(row));
    node.dry_force.push_back(friction[drive.velocity]);
  }
}

double largest_coordinate(const Scene& scene, const Pair& pair, const Node& node) {
  double coordinate = 0;
  for (const int joint : {pair.on_a.joint, pair.on_b.joint}) {
    if (joint < 0) continue;
    coordinate =
        std::max(coordinate, node.kin.X_WJ(scene.model.tree, joint).p.cwiseAbs().maxCoeff());
  }
  return coordinate;
}

ContactProperties properties_of(const Scene& scene, int slot, const Node& node) {
  const Pair& pair = node.pool[slot];
  if (pair.is_stop()) return scene.model.contact_properties(node.pool.number(slot));
  return scene.model.materials.between(pair.a, pair.b);
}

double most_touch(const Scene& scene, const Node& node) {
  return std::max(scene.most_touch, ulps_of(scene.reach + node.q.cwiseAbs().maxCoeff()));
}

bool set_velocity_at_node(const Scene& scene, Node& node) {
  const ModelData& model = scene.model;
  mass_pass(model.packed, node.w);
  if (!factorize(model.tree, model.packed, node.w, 0, node.M)) return false;
  node.has_factors = true;
  node.v = node.p;
  solve(model.tree, model.packed, node.M, node.v);
  if (node.loops.some && !hold_loops(scene, node)) return false;
  return node.v.allFinite();
}

void place_frames(const Scene& scene, Node& node) {
  const ModelData& model = scene.model;
  set_coordinates(model.tree, model.packed, node.q, node.w);
  place(model.packed, node.w);
  copy_poses(model.tree, model.packed, node.w, node.kin);
}

namespace {

void put(const Scene& scene, double t, const VecX& q, const VecX& p, Packed* placed, Node& node) {
  node.t = t;
  node.q = q;
  node.p = p;
  node.has_factors = false;
  // else nobody asks for them
  if (!scene.model.has_gaps() && node.dry.empty() && !node.loops.some) return;
  if (placed == nullptr) return place_frames(scene, node);
  std::swap(node.w, *placed);
  copy_poses(scene.model.tree, scene.model.packed, node.w, node.kin);
}

}  // namespace

void place_node(const Scene& scene, double t, const VecX& q, const VecX& p, Node& node) {
  put(scene, t, q, p, nullptr, node);
  node.clearances.forget();
}

void move_node(const Scene& scene, double t, const VecX& q, const VecX& p,
               const std::vector<double>& motion, Packed* placed, Node& node) {
  put(scene, t, q, p, placed, node);
  node.clearances.go(motion);
}

Contact::Motion motion_of(double u, double epsilon_u) {
  if (u < -epsilon_u) return Contact::Motion::approaches;
  return u > epsilon_u ? Contact::Motion::leaves : Contact::Motion::rests;
}

void classify(const Scene& scene, const Node& node, double speed, Contact& c) {
  c.u = dot(scene.trees, c.n, node.v);
  c.epsilon_u = scene.options.rest * (speed + dot_sizes(scene.trees, c.n, node.v));
  c.motion = motion_of(c.u, c.epsilon_u);
}

void refresh_motions(const Scene& scene, Node& node) {
  for (int i = 0; i < node.touching; ++i) {
    Contact& c = node.contacts[i];
    c.u = dot(scene.trees, c.n, node.v);
    c.motion = motion_of(c.u, c.epsilon_u);
  }
}

double typical_speed(const Scene& scene, const Node& node) {
  const double twice_T = std::max(0.0, node.p.dot(node.v));
  return std::sqrt(twice_T / scene.total_mass) + scene.options.h * scene.model.mass.gravity.norm();
}

double lowest_gap(const Node& node) {
  double lowest = 0;
  for (int i = 0; i < node.touching; ++i) lowest = std::min(lowest, node.contacts[i].phi);
  return lowest;
}

bool has_approach(const Node& node) {
  for (int i = 0; i < node.touching; ++i) {
    if (node.contacts[i].motion == Contact::Motion::approaches) return true;
  }
  return false;
}

bool has_friction(const Node& node) {
  for (int i = 0; i < node.touching; ++i) {
    if (node.contacts[i].friction > 0) return true;
  }
  return false;
}

double floor_of(const Node& node, int slot) {
  const int contact = node.contact_at(slot);
  const double phi = contact < 0 ? node.sunk_at(slot) : node.contacts[contact].phi;
  return std::min(0.0, phi) - node.pool[slot].touch;
}

double press_below(const Node& node, int slot) {
  if (slot >= node.pool.limits()) return floor_of(node, slot);
  const int contact = node.contact_at(slot);
  const double phi = contact < 0 ? 0 : node.contacts[contact].phi;
  constexpr double part_of_touch = 1e-4;
  return std::min(phi, -part_of_touch * node.pool[slot].touch);
}

double node_energy(const Scene& scene, const Node& node) {
  return 0.5 * node.p.dot(node.v) + potential_energy(scene.model.packed, node.w);
}

}  // namespace saltus
