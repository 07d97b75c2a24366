#include "variational/pair_pool.hpp"

#include <algorithm>

#include "saltus/collision/parts.hpp"

namespace saltus {
namespace {

constexpr int few = 50'000;  ///< some 500 bytes each
constexpr int many = 1'000'000;

/// The parts of two shapes are met one after the other.
bool are_same_shapes(const Pair& x, const Pair& y) {
  return std::minmax(x.a, x.b) == std::minmax(y.a, y.b);
}

}  // namespace

PairPool::PairPool(const ModelData& model) : all_(model.pairs.size() <= few) {
  for (int k = 0; all_ && k < model.pairs.size(); ++k) add(model, k);
}

void PairPool::add(const ModelData& model, int number) {
  const PairTable::Key key = model.pairs.key(number);
  Pair pair = make_pair(model.tree, model.shapes, key.a, key.b, key.part);
  const bool parts = model.pairs.count(key.a, key.b) > 1;
  if (parts && (pair_.empty() || !are_same_shapes(pair_.back(), pair))) {
    solid_.push_back(make_solid_pair(model.tree, model.shapes, key.a, key.b));
  }
  pair_.push_back(std::move(pair));
  number_.push_back(number);
  solid_of_.push_back(parts ? static_cast<int>(solid_.size()) - 1 : -1);
}

int PairPool::place_of(const ModelData& model, int pair) {
  if (all_) return pair;
  const auto [found, fresh] = place_.emplace(pair, size());
  if (fresh) add(model, pair);
  return found->second;
}

bool PairPool::is_full() const { return !all_ && size() > many; }

void PairPool::clear() {
  if (all_) return;
  pair_.clear();
  number_.clear();
  solid_.clear();
  solid_of_.clear();
  place_.clear();
}

}  // namespace saltus
