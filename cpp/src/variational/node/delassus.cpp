#include "variational/node/delassus.hpp"

#include <algorithm>

namespace saltus {
namespace {

constexpr std::size_t most_on_a_tree = 64;  ///< reserved

Mat3 block_of(const Contact& at, const Contact& by) {
  Mat3 block = Mat3::Zero();
  for (int i = 0; i < at.rates(); ++i) {
    for (int j = 0; j < by.rates(); ++j) block(i, j) = dot(at.row(i), by.response(j));
  }
  return block;
}

/// column <- M_N^-1 row
void set_column(const Scene& scene, const ContactVector& row, Node& node, ContactVector& column) {
  solve(scene.model, scene.trees, row, node.M, node.column, column);
  if (!node.loops.some) return;
  add(scene.trees, 1, column, node.dense);
  node.loops.solver.hold(node.dense);
  take_from(scene.trees, node.dense, column);
}

void set_columns(const Scene& scene, Node& node, Contact& c) {
  set_column(scene, c.n, node, c.column);
  for (int k = 0; k < 2 && c.friction > 0; ++k) set_column(scene, c.t[k], node, c.t_column[k]);
}

}  // namespace

Neighbours::Neighbours(const Scene& scene) : on_(scene.trees.of.size()) {
  const std::size_t pairs =
      static_cast<std::size_t>(scene.model.pairs.size()) + scene.model.limits.size();
  for (auto& each : on_) each.reserve(std::min(pairs, most_on_a_tree));
  found_.reserve(std::min(pairs, most_on_a_tree));
}

const std::vector<int>& Neighbours::of(const ContactVector& row) {
  found_.clear();
  for (const ContactVector::Part& part : row.part) {
    if (part.tree < 0) continue;
    for (const int j : on_[part.tree]) {
      // a pair that shares both trees is met twice
      if (std::find(found_.begin(), found_.end(), j) == found_.end()) found_.push_back(j);
    }
  }
  return found_;
}

void add_factors(const TreeCoordinates& trees, std::span<const ContactVector* const> rates,
                 std::span<const ContactVector* const> responses, ContactBlocks& W) {
  ContactBlocks::Factors out;
  out.begin = W.rates.size();
  std::size_t count = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    const ContactVector::Part& part = rates[0]->part[k];
    if (part.tree >= 0) out.body[k] = {trees.first[part.tree], part.count};
    count += static_cast<std::size_t>(out.body[k].count);
  }
  W.factors.push_back(out);
  W.coordinates = trees.first.back();
  const auto add = [&](std::span<const ContactVector* const> rows, std::vector<double>& to) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (k < rows.size()) {
        to.insert(to.end(), rows[k]->value.begin(), rows[k]->value.end());
      } else {
        to.insert(to.end(), count, 0.0);
      }
    }
  };
  add(rates, W.rates);
  add(responses, W.responses);
}

void set_contact_blocks(const Scene& scene, std::span<Contact* const> contacts, Node& node,
                        Neighbours& neighbours, ContactBlocks& W, std::vector<Vec3>& u) {
  clear(W);
  u.clear();
  for (Contact* each : contacts) set_columns(scene, node, *each);
  neighbours.list(static_cast<int>(contacts.size()),
                  [&](int i) -> const ContactVector& { return contacts[i]->n; });
  for (const Contact* by : contacts) {
    W.start.push_back(static_cast<int>(W.contact.size()));
    for (const int j : neighbours.of(by->n)) {
      W.contact.push_back(j);
      W.block.push_back(block_of(*contacts[j], *by));
    }
    const std::array<const ContactVector*, 3> rates{&by->n, &by->t[0], &by->t[1]};
    const std::array<const ContactVector*, 3> responses{&by->column, &by->t_column[0],
                                                        &by->t_column[1]};
    const auto used = static_cast<std::size_t>(by->rates());
    add_factors(scene.trees, std::span(rates).first(used), std::span(responses).first(used), W);
    const Mat3 own = block_of(*by, *by);
    W.own.push_back((own + own.transpose()) / 2);
    W.friction.push_back(by->friction);
    W.restitution.push_back(by->restitution);
    W.rest.push_back(by->epsilon_u);
    W.bound.push_back(by->bound);
    u.push_back(Vec3::Zero());
    for (int k = 0; k < by->rates(); ++k) u.back()[k] = dot(scene.trees, by->row(k), node.v);
  }
  W.start.push_back(static_cast<int>(W.contact.size()));
}

void set_contact_matrix(const Scene& scene, Node& node, Neighbours& neighbours, ContactMatrix& G) {
  const auto& contacts = node.contacts;
  for (int i = 0; i < node.touching; ++i) {
    Contact& c = node.contacts[i];
    set_column(scene, c.n, node, c.column);
  }
  for (auto* each : {&G.start, &G.column}) each->clear();
  for (auto* each : {&G.value, &G.diagonal}) each->clear();
  neighbours.list(node.touching, [&](int i) -> const ContactVector& { return contacts[i].n; });
  for (int i = 0; i < node.touching; ++i) {
    G.start.push_back(static_cast<int>(G.column.size()));
    for (const int j : neighbours.of(contacts[i].n)) {
      // the upper triangle is what is computed
      const int row = std::min(i, j), column = std::max(i, j);
      G.column.push_back(j);
      G.value.push_back(dot(contacts[row].n, contacts[column].column));
      if (j == i) G.diagonal.push_back(G.value.back());
    }
  }
  G.start.push_back(static_cast<int>(G.column.size()));
}

void apply(const Scene& scene, const Contact& c, const Vec3& p, Node& node) {
  for (int k = 0; k < c.rates(); ++k) {
    if (p[k] == 0) continue;
    add(scene.trees, p[k], c.row(k), node.p);
    add(scene.trees, p[k], c.response(k), node.v);
  }
}

}  // namespace saltus
