#include "variational/node/contact_vector.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace saltus {
namespace {

/// Calls f(value, coordinate) for every entry.
template <class Row, class F>
void for_each(const TreeCoordinates& trees, Row& row, const F& f) {
  for (const ContactVector::Part& part : row.part) {
    if (part.tree < 0) continue;
    const std::vector<int>& coordinates = trees.of[part.tree];
    for (int k = 0; k < part.count; ++k) f(row.value[part.first + k], coordinates[k]);
  }
}

}  // namespace

namespace {

/// (trees) The first of the trees that loops tie it to.
std::vector<int> tied_trees(const ModelData& model) {
  std::vector<int> first(model.packed.trees.size());
  std::iota(first.begin(), first.end(), 0);
  for (const Equality& each : model.equalities.all) {
    if (each.a.joint < 0 || each.b.joint < 0) continue;
    const int a = first[model.packed.tree[each.a.joint]],
              b = first[model.packed.tree[each.b.joint]];
    for (int& tree : first) {
      if (tree == std::max(a, b)) tree = std::min(a, b);
    }
  }
  return first;
}

}  // namespace

TreeCoordinates::TreeCoordinates(const ModelData& model) : one_to_one(model.packed.one_to_one) {
  const PackedTree& t = model.packed;
  if (!one_to_one) {
    of.resize(1);
    list.assign(t.trees.size(), 0);
    for (int c = 0; c < model.tree.n_v; ++c) of[0].push_back(c);
  }
  const std::vector<int> first = tied_trees(model);
  for (std::size_t i = 0; i < t.trees.size() && one_to_one; ++i) {
    const bool is_first = first[i] == static_cast<int>(i);
    list.push_back(is_first ? static_cast<int>(of.size()) : list[first[i]]);
    if (is_first) of.emplace_back();
    const PackedGroup& g = t.groups[t.trees[i].group];
    for (int k = 0; k < g.positions; ++k) {
      of[list.back()].push_back(t.joint[g.slot(k) + t.trees[i].lane]);
    }
  }
  is_tied.assign(of.size(), 0);
  for (std::size_t i = 0; i < first.size() && one_to_one; ++i) {
    if (first[i] != static_cast<int>(i)) is_tied[list[i]] = 1;
  }
  for (const auto& each : of) most = std::max(most, static_cast<int>(each.size()));
}

bool share_a_tree(const ContactVector& x, const ContactVector& y) {
  for (const ContactVector::Part& a : x.part) {
    for (const ContactVector::Part& b : y.part) {
      if (a.tree >= 0 && a.tree == b.tree) return true;
    }
  }
  return false;
}

void shape_row(const ModelData& model, const TreeCoordinates& trees, const Pair& pair,
               ContactVector& row) {
  row.part = {};
  row.value.clear();
  for (const ChainJoint& k : pair.chain) {
    const int tree = trees.list[model.packed.tree[k.joint]];
    if (row.part[0].tree == tree || row.part[1].tree == tree) continue;
    ContactVector::Part& part = row.part[row.part[0].tree < 0 ? 0 : 1];
    part = {tree, static_cast<int>(row.value.size()), static_cast<int>(trees.of[tree].size())};
    row.value.resize(row.value.size() + trees.of[tree].size(), 0.0);
  }
}

void take_from(const TreeCoordinates& trees, VecX& dense, ContactVector& row) {
  for_each(trees, row, [&](double& value, int c) {
    value = dense[c];
    dense[c] = 0;
  });
}

double dot(const TreeCoordinates& trees, const ContactVector& row, const VecX& x) {
  double sum = 0;
  for_each(trees, row, [&](double value, int c) { sum += value * x[c]; });
  return sum;
}

double dot_sizes(const TreeCoordinates& trees, const ContactVector& row, const VecX& x) {
  double sum = 0;
  for_each(trees, row, [&](double value, int c) { sum += std::abs(value * x[c]); });
  return sum;
}

double dot(const ContactVector& row, const ContactVector& column) {
  double sum = 0;
  for (const ContactVector::Part& a : row.part) {
    for (const ContactVector::Part& b : column.part) {
      if (a.tree < 0 || a.tree != b.tree) continue;
      for (int k = 0; k < a.count; ++k) sum += row.value[a.first + k] * column.value[b.first + k];
    }
  }
  return sum;
}

void add(const TreeCoordinates& trees, double factor, const ContactVector& row, VecX& x) {
  for_each(trees, row, [&](double value, int c) { x[c] += factor * value; });
}

void add_sizes(const TreeCoordinates& trees, double factor, const ContactVector& row, VecX& x) {
  for_each(trees, row, [&](double value, int c) { x[c] += std::abs(factor * value); });
}

void solve(const ModelData& model, const TreeCoordinates& trees, const ContactVector& row,
           PackedMatrix& M, VecX& scratch, ContactVector& column) {
  column.part = row.part;
  column.value = row.value;
  const bool is_dense =
      std::any_of(column.part.begin(), column.part.end(), [&](const ContactVector::Part& part) {
        return part.tree >= 0 && (!trees.one_to_one || trees.is_tied[part.tree] != 0);
      });
  if (!is_dense) {
    for (const ContactVector::Part& part : column.part) {
      if (part.tree < 0) continue;
      const int tree = model.packed.tree[trees.of[part.tree].front()];
      solve_tree(model.packed, tree, M, &column.value[part.first]);
    }
    return;
  }
  scratch.setZero();
  add(trees, 1, row, scratch);
  solve(model.tree, model.packed, M, scratch);
  for_each(trees, column, [&](double& value, int c) { value = scratch[c]; });
}

}  // namespace saltus
