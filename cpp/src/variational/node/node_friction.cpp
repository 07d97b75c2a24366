// Friction at a node: impacts, and the closing half kick of sustained contacts.
#include <algorithm>

#include "saltus/collision/slip.hpp"
#include "variational/node/node.hpp"

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

/// W, u and no impulses, of the contacts in s.contact.
void set_blocks(const ModelData& model, Node& node) {
  FrictionScratch& s = node.friction;
  ContactBlocks& W = s.W;
  for (auto* each : {&W.start, &W.contact}) each->clear();
  for (auto* each : {&W.friction, &W.restitution, &W.rest}) each->clear();
  W.block.clear();
  W.own.clear();
  s.u.clear();
  s.p.assign(s.contact.size(), Vec3::Zero());
  for (const int i : s.contact) {
    Contact& c = node.contacts[i];
    solve(model, node.trees, c.n, node.M, node.column, c.column);
    for (int k = 0; k < 2 && c.friction > 0; ++k) {
      solve(model, node.trees, c.t[k], node.M, node.column, c.t_column[k]);
    }
  }
  for (const int i : s.contact) {
    const Contact& by = node.contacts[i];
    W.start.push_back(static_cast<int>(W.contact.size()));
    for (std::size_t j = 0; j < s.contact.size(); ++j) {
      const Contact& at = node.contacts[s.contact[j]];
      if (!share_a_tree(at.n, by.n)) continue;
      W.contact.push_back(static_cast<int>(j));
      W.block.push_back(block_of(at, by));
    }
    const Mat3 own = block_of(by, by);
    W.own.push_back((own + own.transpose()) / 2);
    W.friction.push_back(by.friction);
    W.restitution.push_back(by.restitution);
    W.rest.push_back(by.epsilon_u);
    Vec3 u(by.u, 0, 0);
    for (int k = 1; k < rates(by); ++k) u[k] = dot(node.trees, row(by, k), node.v);
    s.u.push_back(u);
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

}  // namespace

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
  s.contact.clear();
  for (int i = 0; i < node.touching; ++i) s.contact.push_back(i);
  set_blocks(model, node);
  s.impulses.clear();
  if (!collide(s.W, options, s.pile, s.u, s.p, s.impulses)) return false;
  for (const FrictionImpulse& each : s.impulses) {
    apply(node.contacts[each.contact], each.p, node);
  }
  return true;
}

bool settle_with_friction(const ModelData& model, Node& node) {
  FrictionScratch& s = node.friction;
  if (!s.any) return false;
  s.contact.clear();
  bool any = false;
  for (int i = 0; i < node.touching; ++i) {
    const Contact& c = node.contacts[i];
    if (!node.held[c.pair]) continue;
    s.contact.push_back(i);
    any = any || c.friction > 0;
  }
  if (!any) return false;
  set_blocks(model, node);
  for (std::size_t i = 0; i < s.contact.size(); ++i) {
    const ImpulseMemory& memory = s.memory[node.contacts[s.contact[i]].pair];
    if (memory.flight != s.flight) continue;
    s.p[i] = memory.p;  // the opening half kick is near the closing one
    const int k = static_cast<int>(i);
    for (int e = s.W.start[k]; e < s.W.start[k + 1]; ++e) {
      s.u[s.W.contact[e]] += s.W.block[e] * memory.p;
    }
  }
  s.residual = std::max(s.residual, settle_for_sure(s.W, s.pile, s.u, s.p).excess);
  for (std::size_t i = 0; i < s.contact.size(); ++i) {
    const Contact& c = node.contacts[s.contact[i]];
    apply(c, s.p[i], node);
    node.closing.push_back(acted(node, c, s.p[i][0], across(c, s.p[i])));
  }
  return true;
}

}  // namespace saltus
