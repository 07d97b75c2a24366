#include "variational/node.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "variational/small_system.hpp"

namespace saltus {
namespace {

/// As many as can touch in a plain scene; a pool that is too small grows once.
constexpr std::size_t contacts_reserved = 64;
constexpr std::size_t impulses_reserved = 1024;
/// Of the contacts that one tree takes part in.
constexpr std::size_t most_on_a_tree = 64;

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
    node.restitution.setOnes(m);
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
    const double touch = relative_touch * feature_size(shape.shape);
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
  restitution.setOnes(static_cast<Eigen::Index>(reserved));
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
  if (!cascade(node.G, node.u.head(m), node.rest.head(m), node.restitution.head(m), cascade_options,
               node.cascade, node.impulses)) {
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
