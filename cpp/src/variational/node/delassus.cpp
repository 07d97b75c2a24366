#include "variational/node/delassus.hpp"

#include "saltus/collision/slip.hpp"

namespace saltus {
namespace {

/// Row or column k of a contact: n, t0, t1.
const ContactVector& row(const Contact& c, int k) { return k == 0 ? c.n : c.t[k - 1]; }
const ContactVector& column(const Contact& c, int k) {
  return k == 0 ? c.column : c.t_column[k - 1];
}
int rates(const Contact& c) { return c.friction > 0 ? 3 : 1; }

Mat3 block_of(const Contact& at, const Contact& by) {
  Mat3 block = Mat3::Zero();
  for (int i = 0; i < rates(at); ++i) {
    for (int j = 0; j < rates(by); ++j) block(i, j) = dot(row(at, i), column(by, j));
  }
  return block;
}

void set_columns(const ModelData& model, Node& node, Contact& c) {
  solve(model, node.trees, c.n, node.M, node.column, c.column);
  for (int k = 0; k < 2 && c.friction > 0; ++k) {
    solve(model, node.trees, c.t[k], node.M, node.column, c.t_column[k]);
  }
}

}  // namespace

void set_contact_blocks(const ModelData& model, std::span<Contact* const> contacts, Node& node,
                        ContactBlocks& W, std::vector<Vec3>& u) {
  clear(W);
  u.clear();
  for (Contact* each : contacts) set_columns(model, node, *each);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact& by = *contacts[i];
    W.start.push_back(static_cast<int>(W.contact.size()));
    for (std::size_t j = 0; j < contacts.size(); ++j) {
      if (!share_a_tree(contacts[j]->n, by.n)) continue;
      W.contact.push_back(static_cast<int>(j));
      W.block.push_back(block_of(*contacts[j], by));
      if (i == j) W.own.push_back((W.block.back() + W.block.back().transpose()) / 2);
    }
    W.friction.push_back(by.friction);
    W.restitution.push_back(by.restitution);
    W.rest.push_back(by.epsilon_u);
    u.push_back(Vec3::Zero());
    for (int k = 0; k < rates(by); ++k) u.back()[k] = dot(node.trees, row(by, k), node.v);
  }
  W.start.push_back(static_cast<int>(W.contact.size()));
}

void apply(const Contact& c, const Vec3& p, Node& node) {
  for (int k = 0; k < rates(c); ++k) {
    if (p[k] == 0) continue;
    add(node.trees, p[k], row(c, k), node.p);
    add(node.trees, p[k], column(c, k), node.v);
  }
}

void set_tangents(const ModelData& model, const Gap& gap, const Pair& pair, Node& node,
                  Contact& c) {
  const Tangents t = tangents(gap.n_W, tangent_axis(gap.n_W));
  const Vec3 P = contact_point(gap);
  for (int k = 0; k < 2; ++k) {
    c.t_W[k] = k == 0 ? t.t0 : t.t1;
    add_motion_gradient(model.tree, node.kin, pair, P, c.t_W[k], node.dense);
    c.t[k] = c.n;  // its parts
    take_from(node.trees, node.dense, c.t[k]);
  }
}

bool has_friction(const Node& node) {
  if (!node.friction.any) return false;
  for (int i = 0; i < node.touching; ++i) {
    if (node.contacts[i].friction > 0) return true;
  }
  return false;
}

bool collide_at_node(const ModelData& model, const CascadeOptions& options, Node& node) {
  FrictionScratch& s = node.friction;
  node.colliding.clear();
  for (int i = 0; i < node.touching; ++i) node.colliding.push_back(&node.contacts[i]);
  set_contact_blocks(model, node.colliding, node, s.W, s.u);
  s.p.assign(node.colliding.size(), Vec3::Zero());
  s.impulses.clear();
  if (!collide(s.W, options, s.pile, s.u, s.p, s.impulses)) return false;
  for (const FrictionImpulse& each : s.impulses) {
    apply(node.contacts[each.contact], each.p, node);
  }
  return true;
}

}  // namespace saltus
