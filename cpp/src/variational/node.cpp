#include "variational/node.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "variational/small_system.hpp"

namespace saltus {
namespace {

bool set_velocity_at_node(const ModelData& model, Node& node) {
  mass_pass(model.packed, node.w);
  if (!factorize(model.tree, model.packed, node.w, 0, node.M)) return false;
  node.v = node.p;
  solve(model.tree, model.packed, node.M, node.v);
  return node.v.allFinite();
}

/// As many as can touch in a plain scene; a pool that is too small grows once.
constexpr std::size_t contacts_reserved = 64;
constexpr std::size_t impulses_reserved = 1024;
/// Of the contacts that one tree takes part in.
constexpr std::size_t most_on_a_tree = 64;

Contact fresh_contact(const TreeCoordinates& trees) {
  Contact fresh;
  for (ContactVector* each : {&fresh.n, &fresh.column}) {
    each->value.reserve(2 * static_cast<std::size_t>(trees.most));
  }
  return fresh;
}

Contact& next_in_pool(Node& node) {
  if (node.touching == static_cast<int>(node.contacts.size())) {
    node.contacts.push_back(fresh_contact(node.trees));
  }
  return node.contacts[node.touching];
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

/// A speed of the whole model, [m/s].
double typical_speed(const ModelData& model, const StepOptions& options, const Node& node) {
  const double twice_T = std::max(0.0, node.p.dot(node.v));
  return std::sqrt(twice_T / node.total_mass) + options.h * model.mass.gravity.norm();
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
  add_gap_gradient(model.tree, node.kin, pair, g, node.dense);
  shape_row(model, node.trees, pair, c.n);
  take_from(node.trees, node.dense, c.n);
  c.pair = index;
  c.phi = g.phi;
  c.n_W = g.n_W;
  c.p_WB = g.p_WB;
  classify(node, speed, options.rest, c);
  if (g.phi > pair.touch && !(c.u < 0 && g.phi <= -c.u * soon)) return;
  node.contact_of[index] = node.touching++;
}

/// The contacts of every tree, in order.
void list_contacts_by_tree(Node& node) {
  for (int i = 0; i < node.touching; ++i) {
    for (const ContactVector::Part& part : node.contacts[i].n.part) {
      if (part.tree >= 0) node.contacts_on[part.tree].push_back(i);
    }
  }
}

void clear_contacts_by_tree(Node& node) {
  for (int i = 0; i < node.touching; ++i) {
    for (const ContactVector::Part& part : node.contacts[i].n.part) {
      if (part.tree >= 0) node.contacts_on[part.tree].clear();
    }
  }
}

/// Row i of G: its own trees' contacts.
void add_row(int i, Node& node) {
  ContactMatrix& G = node.G;
  const Contact& c = node.contacts[i];
  const int first = static_cast<int>(G.column.size());
  G.start.push_back(first);
  for (const ContactVector::Part& part : c.n.part) {
    if (part.tree < 0) continue;
    for (const int j : node.contacts_on[part.tree]) {
      // a pair that shares both trees is met twice
      if (std::find(G.column.begin() + first, G.column.end(), j) != G.column.end()) continue;
      G.column.push_back(j);
      // G is symmetric to the last bit: its upper triangle is what is computed
      const int row = std::min(i, j), column = std::max(i, j);
      G.value.push_back(dot(node.contacts[row].n, node.contacts[column].column));
      if (j == i) G.diagonal.push_back(G.value.back());
    }
  }
}

/// Columns, rates and G of all contacts.
void set_G(const ModelData& model, Node& node) {
  const int m = node.touching;
  if (node.u.size() < m) {
    node.u.resize(m);
    node.rest.resize(m);
  }
  for (int i = 0; i < m; ++i) {
    Contact& c = node.contacts[i];
    solve(model, node.trees, c.n, node.M, node.column, c.column);
    node.u[i] = c.u;
    node.rest[i] = c.epsilon_u;
  }
  node.G.start.clear();
  node.G.column.clear();
  node.G.value.clear();
  node.G.diagonal.clear();
  list_contacts_by_tree(node);
  for (int i = 0; i < m; ++i) add_row(i, node);
  node.G.start.push_back(static_cast<int>(node.G.column.size()));
  clear_contacts_by_tree(node);
}

void apply(Node& node, int contact, double lambda) {
  add(node.trees, lambda, node.contacts[contact].n, node.p);
  add(node.trees, lambda, node.contacts[contact].column, node.v);
}

}  // namespace

Node::Node(const ModelData& model)
    : pool(model),
      contact_of(static_cast<std::size_t>(pool.size()), -1),
      held(contact_of.size(), 0),
      sunk(contact_of.size(), 0),
      w(model.packed),
      kin(model.tree),
      M(model.tree, model.packed),
      broad(model.tree, model.shapes, model.pairs),
      trees(model) {
  const int n = model.tree.coordinates;
  for (VecX* x : {&q, &p, &v, &dq, &dense, &column, &launch.n}) x->setZero(n);
  for (const BodyInertia& body : model.mass.body) total_mass += body.mass;
  for (const PlacedShape& shape : model.shapes) {
    const double touch = 1e-10 * feature_size(shape.shape);
    if (std::isfinite(touch)) most_touch = std::max(most_touch, touch);
  }
  const std::size_t reserved =
      std::min(static_cast<std::size_t>(model.pairs.size()), contacts_reserved);
  for (std::size_t i = 0; i < reserved; ++i) contacts.push_back(fresh_contact(trees));
  G.start.reserve(reserved + 1);
  G.diagonal.reserve(reserved);
  G.column.reserve(reserved * reserved);
  G.value.reserve(reserved * reserved);
  cascade.key.reserve(reserved);
  cascade.winner.reserve(4 * reserved);
  contacts_on.resize(trees.of.size());
  for (auto& each : contacts_on) each.reserve(std::min(reserved, most_on_a_tree));
  impulses.reserve(impulses_reserved);
  u.setZero(static_cast<Eigen::Index>(reserved));
  rest.setZero(static_cast<Eigen::Index>(reserved));
}

int place_of(const ModelData& model, int number, Node& node) {
  const int place = node.pool.place_of(model, number);
  const auto pairs = static_cast<std::size_t>(node.pool.size());
  if (node.contact_of.size() < pairs) {
    node.contact_of.resize(pairs, -1);
    node.held.resize(pairs, 0);
    node.sunk.resize(pairs, 0);
  }
  return place;
}

void forget_pairs(Node& node) {
  reset_contacts(node);
  node.pool.clear();
  node.contact_of.assign(static_cast<std::size_t>(node.pool.size()), -1);
  node.held.assign(node.contact_of.size(), 0);
  node.sunk.assign(node.contact_of.size(), 0);
}

bool find_contacts(const ModelData& model, const StepOptions& options, Node& node) {
  if (model.pairs.empty()) return true;
  set_coordinates(model.tree, model.packed, node.q, node.w);
  place(model.packed, node.w);
  copy_poses(model.tree, model.packed, node.w, node.kin);
  node.dq = options.simultaneous * options.h * node.v;
  find_candidates(model.tree, model.shapes, model.pairs, node.kin, node.dq, node.most_touch,
                  node.broad);
  reset_contacts(node);
  if (node.broad.candidates.empty()) return true;
  if (!set_velocity_at_node(model, node)) return false;
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
    if (node.contact_of[place] < 0) node.held[place] = 0;
  }
  return true;
}

bool impact_pending(const Node& node) {
  for (int i = 0; i < node.touching; ++i) {
    if (node.contacts[i].motion == Contact::Motion::approaches) return true;
  }
  return false;
}

void settle_held_contacts(const ModelData& model, Node& node) {
  std::array<int, most_constraints> held;
  int count = 0;
  for (int i = 0; i < node.touching && count < most_constraints; ++i) {
    if (node.held[node.contacts[i].pair]) held[count++] = i;
  }
  if (count == 0) return;
  for (int i = 0; i < count; ++i) {
    Contact& c = node.contacts[held[i]];
    solve(model, node.trees, c.n, node.M, node.column, c.column);
  }
  SmallVec lambda;
  // impulses only push: those that would pull are let go, the worst first
  for (; count > 0; --count) {
    SmallMat G(count, count);
    SmallVec u(count);
    for (int i = 0; i < count; ++i) {
      u[i] = node.contacts[held[i]].u;
      for (int j = 0; j < count; ++j) {
        G(i, j) = dot(node.contacts[held[i]].n, node.contacts[held[j]].column);
      }
    }
    lambda = solve_small(G, -u);
    int worst = 0;
    if (lambda.minCoeff(&worst) >= 0) break;
    std::swap(held[worst], held[count - 1]);
  }
  for (int i = 0; i < count; ++i) apply(node, held[i], lambda[i]);
  for (int i = 0; i < node.touching; ++i) {
    Contact& c = node.contacts[i];
    c.u = dot(node.trees, c.n, node.v);
    c.motion = motion_of(c.u, c.epsilon_u);
  }
}

double node_energy(const ModelData& model, const Node& node) {
  return 0.5 * node.p.dot(node.v) + potential_energy(model.packed, node.w);
}

bool resolve_node_impact(const ModelData& model, const StepOptions& options, double arc_energy,
                         Node& node, StepReport& report) {
  set_G(model, node);
  const int m = node.touching;
  node.impulses.clear();
  CascadeOptions cascade_options;
  cascade_options.max_impulses = options.max_impulses;
  if (!cascade(node.G, node.u.head(m), node.rest.head(m), cascade_options, node.cascade,
               node.impulses)) {
    return false;
  }

  Impact impact{node.t,
                static_cast<int>(report.impulses.size()),
                static_cast<int>(node.impulses.size()),
                m,
                ImpactLaw::nodal_energy,
                false};
  double strongest = 0;
  for (const Impulse& impulse : node.impulses) {
    // lambda u / 2 is the normal kinetic energy u^2 / 2G four times over: lambda = -2 u / G
    const double energy = impulse.lambda * impulse.lambda * node.G.diagonal[impulse.pair] / 8;
    strongest = std::max(strongest, energy);
  }
  for (const Impulse& impulse : node.impulses) {
    const Contact& c = node.contacts[impulse.pair];
    const double energy = impulse.lambda * impulse.lambda * node.G.diagonal[impulse.pair] / 8;
    if (energy > 1e-3 * strongest) {  // the last strong one carries the energy match
      node.launch.normal_energy = energy;
      node.launch.n.setZero();
      add(node.trees, 1, c.n, node.launch.n);
    }
    apply(node, impulse.pair, impulse.lambda);
    report.impulses.push_back({node.pool.number(c.pair), impulse.lambda});
  }
  node.launch.pending = options.law == ImpactLaw::discrete_energy;
  node.launch.energy = arc_energy;
  impact.law = options.law;
  report.impacts.push_back(impact);
  const double speed = typical_speed(model, options, node);
  node.v = node.p;  // without the rounding that the cascade's updates have gathered
  solve(model.tree, model.packed, node.M, node.v);
  for (int i = 0; i < m; ++i) {
    node.held[node.contacts[i].pair] = 0;
    classify(node, speed, options.rest, node.contacts[i]);
  }
  return true;
}

}  // namespace saltus
