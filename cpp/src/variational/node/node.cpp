#include "variational/node/node.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

}  // namespace

Node::Node(const ModelData& model)
    : pool(model),
      contact_of(static_cast<std::size_t>(pool.size()), -1),
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
  colliding.reserve(reserved);
  cascade.winner.reserve(4 * reserved);
  contacts_on.resize(trees.of.size());
  for (auto& each : contacts_on) each.reserve(std::min(reserved, most_on_a_tree));
  impulses.reserve(impulses_reserved);
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

void refresh_motions(Node& node) {
  for (int i = 0; i < node.touching; ++i) {
    Contact& c = node.contacts[i];
    c.u = dot(node.trees, c.n, node.v);
    c.motion = motion_of(c.u, c.epsilon_u);
  }
}

bool impact_pending(const Node& node) {
  for (int i = 0; i < node.touching; ++i) {
    if (node.contacts[i].motion == Contact::Motion::approaches) return true;
  }
  return false;
}

double node_energy(const ModelData& model, const Node& node) {
  return 0.5 * node.p.dot(node.v) + potential_energy(model.packed, node.w);
}

}  // namespace saltus
