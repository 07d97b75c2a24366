// The pairs that a stepper has met, each made once.
//
// What a step keeps by pair (contact, held, passed) is kept by its slot here. The first slots are
// the joints' limits. Where the model has few pairs of shapes all are made at once, in order, and a
// step allocates nothing; of 5e7 only those that come near each other are ever made.
#pragma once

#include <deque>
#include <limits>
#include <vector>

#include "saltus/model/model.hpp"

namespace saltus {

/// [m] What rounding makes of a gap between bodies with such coordinates: some ulp.
inline double ulps_of(double coordinate) {
  return 8 * std::numeric_limits<double>::epsilon() * coordinate;
}

class PairPool {
 public:
  explicit PairPool(const ModelData& model);

  /// The slot of a pair, which is made if it is new: then slots grow by one.
  int slot_of(const ModelData& model, int number);

  int limits() const { return limits_; }  ///< slots below are joints' limits
  int size() const { return static_cast<int>(number_.size()); }
  const Pair& operator[](int slot) const { return pair_[slot]; }
  int number(int slot) const { return number_[slot]; }  ///< in model.pairs
  /// Far from the origin the rounding of coordinates is more than what touches near it: a pair's
  /// touch is some ulp of them at least.
  /// @param coordinate [m] the largest of the pair's two bodies where they are now
  void know_ulps(int slot, double coordinate);
  /// Of a pair of parts the two shapes as wholes, which say in one gap that no part is near; the
  /// same for all parts. None where the pair is of wholes.
  const Pair* solid(int slot) const {
    return solid_of_[slot] < 0 ? nullptr : &solid_[solid_of_[slot]];
  }

  /// Number of a pair's solid, or -1; below solids().
  int solid_number(int slot) const { return solid_of_[slot]; }
  int solids() const { return static_cast<int>(solid_.size()); }

  /// True where so many have been met that the memory of them is better given back.
  bool is_full() const;
  void clear();  ///< no effect where all are made

 private:
  struct Entry {
    int number, slot;
  };

  void add(const ModelData& model, int number);
  std::size_t entry_of(int number) const;
  void grow_table();

  void add_limits(const ModelData& model);

  bool all_;
  int limits_;
  std::deque<Pair> pair_, solid_;  ///< at addresses that stay
  std::vector<int> number_;        ///< (slots)
  std::vector<int> solid_of_;      ///< (slots) index in solid_, or -1
  std::vector<double> touch_;      ///< (slots) [m] near the origin
  /// Open addressing: the entry of a number is near its hash, slot -1 marks a free one. A power
  /// of two of entries, half of them free at least. Unused where all are made.
  std::vector<Entry> table_;
};

}  // namespace saltus
