#include "variational/node/node.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "variational/law/small_system.hpp"

namespace saltus {
namespace {

constexpr std::size_t impulses_reserved = 1024;
/// As many as can touch in a plain scene; a pool that is too small grows once.
constexpr std::size_t contacts_reserved = 64;
/// Of the contacts that one tree takes part in.
constexpr std::size_t most_on_a_tree = 64;

bool have_friction(const MaterialTable& materials) {
  const auto& all = materials.contact;
  return std::any_of(all.begin(), all.end(), [](const auto& each) { return each.friction > 0; });
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

void apply(Node& node, int contact, double lambda) {
  add(node.trees, lambda, node.contacts[contact].n, node.p);
  add(node.trees, lambda, node.contacts[contact].column, node.v);
}

void refresh_motions(Node& node) {
  for (int i = 0; i < node.touching; ++i) {
    Contact& c = node.contacts[i];
    c.u = dot(node.trees, c.n, node.v);
    c.motion = motion_of(c.u, c.epsilon_u);
  }
}

}  // namespace

Node::Node(const ModelData& model)
    : pool(model),
      contact_of(static_cast<std::size_t>(pool.size()), -1),
      held(contact_of.size(), 0),
      sunk(contact_of.size(), 0),
      friction(have_friction(model.materials)),
      w(model.packed),
      kin(model.tree),
      M(model.tree, model.packed),
      broad(model.tree, model.shapes, model.pairs),
      trees(model) {
  q.setZero(model.tree.n_q);
  for (VecX* x : {&p, &v, &dq, &dense, &column, &launch.n}) x->setZero(model.tree.n_v);
  for (const BodyInertia& body : model.mass.body) total_mass += body.mass;
  for (const PlacedShape& shape : model.shapes) {
    const double touch = relative_touch * feature_size(shape.shape);
    if (std::isfinite(touch)) most_touch = std::max(most_touch, touch);
  }
  const std::size_t reserved =
      std::min(static_cast<std::size_t>(model.pairs.size()), contacts_reserved);
  for (std::size_t i = 0; i < reserved; ++i) contacts.push_back(fresh_contact(trees, friction.any));
  G.start.reserve(reserved + 1);
  G.diagonal.reserve(reserved);
  G.column.reserve(reserved * reserved);
  G.value.reserve(reserved * reserved);
  cascade.key.reserve(reserved);
  rested.reserve(reserved);
  cascade.winner.reserve(4 * reserved);
  if (friction.any) friction.memory.resize(contact_of.size());
  contacts_on.resize(trees.of.size());
  for (auto& each : contacts_on) each.reserve(std::min(reserved, most_on_a_tree));
  impulses.reserve(impulses_reserved);
  closing.reserve(contacts_reserved);
  u.setZero(static_cast<Eigen::Index>(reserved));
  rest.setZero(static_cast<Eigen::Index>(reserved));
  restitution.setOnes(static_cast<Eigen::Index>(reserved));
}

void set_contact_matrix(const ModelData& model, Node& node) {
  const int m = node.touching;
  if (node.u.size() < m) {
    node.u.resize(m);
    node.rest.resize(m);
    node.restitution.resize(m);
  }
  for (int i = 0; i < m; ++i) {
    Contact& c = node.contacts[i];
    solve(model, node.trees, c.n, node.M, node.column, c.column);
    node.u[i] = c.u;
    node.rest[i] = c.epsilon_u;
    node.restitution[i] = c.restitution;
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

bool impact_pending(const Node& node) {
  for (int i = 0; i < node.touching; ++i) {
    if (node.contacts[i].motion == Contact::Motion::approaches) return true;
  }
  return false;
}

void come_to_rest(const ModelData& model, int contact, Node& node) {
  Contact& c = node.contacts[contact];
  solve(model, node.trees, c.n, node.M, node.column, c.column);
  const double lambda = -c.u / dot(c.n, c.column);  // below 0: it takes the last bounce away
  apply(node, contact, lambda);
  node.closing.push_back(acted(node, c, lambda, Vec3::Zero()));
  node.held[c.pair] = 1;
  refresh_motions(node);
  settle_held_contacts(model, node);
}

void settle_held_contacts(const ModelData& model, Node& node) {
  if (settle_with_friction(model, node)) return refresh_motions(node);
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
  for (int i = 0; i < count; ++i) {
    apply(node, held[i], lambda[i]);
    node.closing.push_back(acted(node, node.contacts[held[i]], lambda[i], Vec3::Zero()));
  }
  refresh_motions(node);
}

double node_energy(const ModelData& model, const Node& node) {
  return 0.5 * node.p.dot(node.v) + potential_energy(model.packed, node.w);
}

}  // namespace saltus
