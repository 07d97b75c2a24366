#include "variational/node/pair_pool.hpp"

#include <algorithm>

#include "saltus/collision/parts.hpp"

namespace saltus {
namespace {

constexpr int few = 50'000;  ///< some 500 bytes each
constexpr std::size_t first_entries = 4096;
constexpr int many = 1'000'000;

/// The parts of two shapes are met one after the other.
bool are_same_shapes(const Pair& x, const Pair& y) {
  return std::minmax(x.a, x.b) == std::minmax(y.a, y.b);
}

}  // namespace

PairPool::PairPool(const ModelData& model)
    : all_(model.pairs.size() <= few), limits_(static_cast<int>(model.limits.size())) {
  add_limits(model);
  if (!all_) table_.assign(first_entries, {0, -1});
  for (int k = 0; all_ && k < model.pairs.size(); ++k) add(model, k);
}

void PairPool::add_limits(const ModelData& model) {
  for (int k = 0; k < limits_; ++k) {
    const JointLimit& limit = model.limits[static_cast<std::size_t>(k)];
    pair_.push_back(make_stop(model.tree, limit.joint, limit.stop));
    touch_.push_back(pair_.back().touch);
    number_.push_back(model.first_limit + k);
    solid_of_.push_back(-1);
  }
}

void PairPool::add(const ModelData& model, int number) {
  const PairTable::Key key = model.pairs.key(number);
  Pair pair = make_pair(model.tree, model.shapes, key.a, key.b, key.part);
  const bool parts = model.pairs.count(key.a, key.b) > 1;
  if (parts && (pair_.empty() || !are_same_shapes(pair_.back(), pair))) {
    solid_.push_back(make_solid_pair(model.tree, model.shapes, key.a, key.b));
  }
  touch_.push_back(pair.touch);
  pair_.push_back(std::move(pair));
  number_.push_back(number);
  solid_of_.push_back(parts ? static_cast<int>(solid_.size()) - 1 : -1);
}

int PairPool::slot_of(const ModelData& model, int number) {
  if (all_) return limits_ + number;
  const std::size_t entry = entry_of(number);
  if (table_[entry].slot >= 0) return table_[entry].slot;
  table_[entry] = {number, size()};
  add(model, number);
  if (2 * number_.size() > table_.size()) grow_table();
  return size() - 1;
}

std::size_t PairPool::entry_of(int number) const {
  const std::size_t mask = table_.size() - 1;
  std::size_t entry = static_cast<unsigned>(number) * 0x9E3779B97F4A7C15u >> 20 & mask;
  while (table_[entry].slot >= 0 && table_[entry].number != number) entry = (entry + 1) & mask;
  return entry;
}

void PairPool::grow_table() {
  const std::vector<Entry> before = std::move(table_);
  table_.assign(2 * before.size(), {0, -1});
  for (const Entry& each : before) {
    if (each.slot >= 0) table_[entry_of(each.number)] = each;
  }
}

void PairPool::know_ulps(int slot, double coordinate) {
  const double touch = std::max(touch_[slot], ulps_of(coordinate));
  pair_[slot].touch = touch;
  if (solid_of_[slot] >= 0) solid_[solid_of_[slot]].touch = touch;
}

bool PairPool::is_full() const { return !all_ && size() > many; }

void PairPool::clear() {
  if (all_) return;
  const auto kept = static_cast<std::size_t>(limits_);
  pair_.resize(kept);
  number_.resize(kept);
  solid_.clear();
  solid_of_.resize(kept);
  touch_.resize(kept);
  table_.assign(first_entries, {0, -1});
}

}  // namespace saltus
