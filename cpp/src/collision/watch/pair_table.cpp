#include "saltus/collision/pair_table.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "saltus/error.hpp"

namespace saltus {
namespace {

/// Entries of an ascending list that lie between i and j, both left out.
int count_between(const std::vector<int>& list, int i, int j) {
  const auto from = std::upper_bound(list.begin(), list.end(), i);
  return static_cast<int>(std::lower_bound(from, list.end(), j) - from);
}

/// Shapes alike in their kind and group; convex ones in their numbers of vertices and edges too,
/// since each can have a gap of its own.
using Signature = std::tuple<std::size_t, std::size_t, std::size_t, int>;

Signature signature(const Shape& shape, int group) {
  const auto* convex = std::get_if<Convex>(&shape);
  if (convex == nullptr) return {shape.index(), 0, 0, group};
  return {shape.index(), convex->hull->vertices.size(), convex->hull->edges.size(), group};
}

}  // namespace

PairTable::PairTable(const std::vector<PlacedShape>& shapes, const PairRules& rules) {
  classify(shapes, rules);
  const std::size_t n = shapes.size();
  excluded_.resize(n);
  std::set<std::pair<int, int>> excluded;
  for (const auto& [a, b] : rules.excluded) excluded.insert(std::minmax(a, b));
  std::vector<Count> missing(n, 0);  // gaps with earlier shapes that are excluded
  for (const auto& [a, b] : excluded) {
    const int parts = parts_[class_[a]][class_[b]];
    if (body_[a] == body_[b] || parts == 0) continue;
    excluded_[a].push_back(b);
    missing[b] += parts;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::vector<Members>& on = on_[body_[i]];
    plain_.push_back(excluded_[i].empty() && on.size() == 1 && on[0].shape.size() == 1);
  }
  row_.assign(1, 0);
  for (int i = 0; i < static_cast<int>(n); ++i) {
    row_.push_back(row_.back() + row_before(i, static_cast<int>(n)));
    const bool earlier = row_between(i, -1, i) > missing[i];
    used_.push_back(earlier || row_[i + 1] > row_[i]);
  }
  if (row_.back() > std::numeric_limits<int>::max()) {
    throw ModelError(std::to_string(row_.back()) + " pairs of shapes; at most " +
                     std::to_string(std::numeric_limits<int>::max()) +
                     " can be watched: exclude links or groups");
  }
}

void PairTable::classify(const std::vector<PlacedShape>& shapes, const PairRules& rules) {
  std::map<Signature, int> known;
  std::map<int, int> bodies;
  std::vector<int> example;  // a shape of each class
  for (int i = 0; i < static_cast<int>(shapes.size()); ++i) {
    const int next = static_cast<int>(known.size());
    const auto [found, fresh] = known.emplace(signature(shapes[i].shape, rules.group[i]), next);
    if (fresh) example.push_back(i);
    class_.push_back(found->second);
    const int body = static_cast<int>(bodies.size());
    body_.push_back(bodies.emplace(shapes[i].joint, body).first->second);
  }
  const std::size_t kinds = example.size();
  std::set<std::pair<int, int>> apart;
  for (const auto& [g, h] : rules.excluded_groups) apart.insert(std::minmax(g, h));
  parts_.assign(kinds, std::vector<int>(kinds, 0));
  for (std::size_t s = 0; s < kinds; ++s) {
    for (std::size_t t = 0; t < kinds; ++t) {
      const int a = example[s], b = example[t];
      if (apart.count(std::minmax(rules.group[a], rules.group[b])) > 0) continue;
      parts_[s][t] = part_count(shapes[a].shape, shapes[b].shape);
    }
  }
  const std::size_t stride = shapes.size() + 1;
  before_.assign(kinds * stride, 0);
  on_.resize(bodies.size());
  for (int i = 0; i < static_cast<int>(shapes.size()); ++i) {
    for (std::size_t t = 0; t < kinds; ++t) before_[t * stride + i + 1] = before_[t * stride + i];
    ++before_[class_[i] * stride + i + 1];
    std::vector<Members>& on = on_[body_[i]];
    auto members = std::find_if(on.begin(), on.end(),
                                [&](const Members& each) { return each.kind == class_[i]; });
    if (members == on.end()) members = on.insert(on.end(), {class_[i], {}});
    members->shape.push_back(i);
  }
}

PairTable::Count PairTable::row_between(int i, int from, int to) const {
  const std::vector<int>& parts = parts_[class_[i]];
  Count sum = 0;
  for (int t = 0; t < classes(); ++t) {
    sum += static_cast<Count>(parts[t]) * (before(t)[to] - before(t)[from + 1]);
  }
  if (plain_[i] != 0) return sum;  // most often: spares a look at three lists
  for (const Members& members : on_[body_[i]]) {
    const Count each = parts[members.kind];
    if (each > 0) sum -= each * count_between(members.shape, from, to);
  }
  return sum;
}

PairTable::Count PairTable::row_before(int i, int j) const {
  Count sum = row_between(i, i, j);
  if (plain_[i] != 0) return sum;
  for (const int other : excluded_[i]) {
    if (other >= j) break;
    sum -= parts_[class_[i]][class_[other]];
  }
  return sum;
}

PairTable::Range PairTable::range(int a, int b) const {
  const auto [i, j] = std::minmax(a, b);
  const int parts = parts_[class_[i]][class_[j]];
  if (parts == 0) return {0, 0};
  if (plain_[i] == 0) {
    if (body_[i] == body_[j]) return {0, 0};
    const std::vector<int>& excluded = excluded_[i];
    if (std::binary_search(excluded.begin(), excluded.end(), j)) return {0, 0};
  }
  return {static_cast<int>(row_[i] + row_before(i, j)), parts};
}

PairTable::Key PairTable::key(int pair) const {
  assert(pair >= 0 && pair < size());
  const auto row = std::upper_bound(row_.begin(), row_.end(), pair) - 1;
  const int i = static_cast<int>(row - row_.begin());
  const Count offset = pair - *row;
  int low = i + 1, high = static_cast<int>(class_.size());  // the last j with row_before <= offset
  while (high - low > 1) {
    const int middle = low + (high - low) / 2;
    (row_before(i, middle) <= offset ? low : high) = middle;
  }
  return {i, low, static_cast<int>(offset - row_before(i, low))};
}

}  // namespace saltus
