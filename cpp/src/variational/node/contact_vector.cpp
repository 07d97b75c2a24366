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

/// Trees that feel each other, by the first of them.
class Ties {
 public:
  explicit Ties(const PackedTree& packed) : packed_(packed), first_(packed.trees.size()) {
    std::iota(first_.begin(), first_.end(), 0);
  }
  void tie_trees(int x, int y) {
    const int a = std::min(first_[x], first_[y]), b = std::max(first_[x], first_[y]);
    std::replace(first_.begin(), first_.end(), b, a);
  }
  /// -1 is the world, which ties nothing.
  void tie(int joint, int other) {
    if (joint >= 0 && other >= 0) tie_trees(packed_.tree[joint], packed_.tree[other]);
  }
  int joint_of(int velocity) const { return packed_.joint[packed_.slot_of_velocity[velocity]]; }
  const std::vector<int>& first() const { return first_; }

 private:
  const PackedTree& packed_;
  std::vector<int> first_;
};

/// (trees) The first of the trees that loops, or forces on several, tie it to.
std::vector<int> tied_trees(const ModelData& model) {
  Ties ties(model.packed);
  for (const Equality& each : model.equalities.all) ties.tie(each.a.joint, each.b.joint);
  for (const PointDamper& each : model.forces.dampers) ties.tie(each.joint_a, each.joint_b);
  for (const Actuator& each : model.forces.actuators) {
    const int first = ties.joint_of(each.gears.front().velocity);
    for (const Gear& gear : each.gears) ties.tie(first, ties.joint_of(gear.velocity));
  }
  for (const FunctionForce& each : model.forces.functions) {
    for (const int c : each.velocities) {
      ties.tie(ties.joint_of(each.velocities.front()), ties.joint_of(c));
    }
  }
  // potentials do not say whom they join
  for (std::size_t i = 1; i < model.packed.trees.size() && model.packed.columns > 0; ++i) {
    ties.tie_trees(0, static_cast<int>(i));
  }
  return ties.first();
}

}  // namespace

TreeCoordinates::TreeCoordinates(const ModelData& model) : one_to_one(model.packed.one_to_one) {
  const PackedTree& t = model.packed;
  if (!one_to_one) {
    of.resize(1);
    list.assign(t.trees.size(), 0);
    for (int c = 0; c < model.tree.n_v; ++c) of[0].push_back(c);
  }
  const std::vector<int> tied = tied_trees(model);
  for (std::size_t i = 0; i < t.trees.size() && one_to_one; ++i) {
    const bool is_first = tied[i] == static_cast<int>(i);
    list.push_back(is_first ? static_cast<int>(of.size()) : list[tied[i]]);
    if (is_first) of.emplace_back();
    const PackedGroup& g = t.groups[t.trees[i].group];
    for (int k = 0; k < g.positions; ++k) {
      of[list.back()].push_back(t.joint[g.slot(k) + t.trees[i].lane]);
    }
  }
  is_tied.assign(of.size(), 0);
  for (std::size_t i = 0; i < tied.size() && one_to_one; ++i) {
    if (tied[i] != static_cast<int>(i)) is_tied[list[i]] = 1;
  }
  first.push_back(0);
  for (const auto& each : of) first.push_back(first.back() + static_cast<int>(each.size()));
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

double largest(const TreeCoordinates& trees, const ContactVector& row, const VecX& x) {
  double most = 0;
  for_each(trees, row, [&](double, int c) { most = std::max(most, std::abs(x[c])); });
  return most;
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

namespace {

/// Trees of the part feel others, or J knows no trees.
bool is_dense(const TreeCoordinates& trees, const PackedMatrix& J, const ContactVector& row) {
  if (!trees.one_to_one || J.is_dense || J.is_coupled) return true;
  return std::any_of(row.part.begin(), row.part.end(), [&](const ContactVector::Part& part) {
    return part.tree >= 0 && trees.is_tied[part.tree] != 0;
  });
}

/// Calls f(tree, x), x the row's entries by position in the tree.
template <class F>
void for_each_tree(const ModelData& model, const TreeCoordinates& trees, ContactVector& row,
                   const F& f) {
  for (const ContactVector::Part& part : row.part) {
    if (part.tree < 0) continue;
    f(model.packed.tree[trees.of[part.tree].front()], &row.value[part.first]);
  }
}

/// Calls f(x) for the row's entries among all coordinates, (n_v).
template <class F>
void on_all(const TreeCoordinates& trees, VecX& scratch, ContactVector& row, const F& f) {
  scratch.setZero();
  add(trees, 1, row, scratch);
  f(scratch);
  for_each(trees, row, [&](double& value, int c) { value = scratch[c]; });
}

}  // namespace

void solve(const ModelData& model, const TreeCoordinates& trees, const ContactVector& row,
           PackedMatrix& J, VecX& scratch, ContactVector& column) {
  column.part = row.part;
  column.value = row.value;
  if (is_dense(trees, J, row)) {
    on_all(trees, scratch, column, [&](VecX& x) { solve(model.tree, model.packed, J, x); });
  } else {
    for_each_tree(model, trees, column,
                  [&](int tree, double* x) { solve_tree(model.packed, tree, J, x); });
  }
}

void pull_back_end(const ModelData& model, const TreeCoordinates& trees, const PackedMatrix& J,
                   VecX& scratch, ContactVector& row) {
  if (model.packed.balls.empty()) return;
  if (is_dense(trees, J, row)) {
    on_all(trees, scratch, row, [&](VecX& x) { pull_back_end(model.packed, J, x); });
  } else {
    for_each_tree(model, trees, row,
                  [&](int tree, double* x) { pull_back_end_tree(model.packed, tree, J, x); });
  }
}

}  // namespace saltus
