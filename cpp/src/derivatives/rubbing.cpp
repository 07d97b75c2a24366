#include "derivatives/rubbing.hpp"

#include <algorithm>

namespace saltus {

double Rubbing::of(int pair) const {
  if (value.size() == 0) return 0;
  const auto at = std::lower_bound(pairs.begin(), pairs.end(), pair);
  return at != pairs.end() && *at == pair ? value[at - pairs.begin()] : 0;
}

void Rubbing::add(int pair, double x) {
  const auto at = std::lower_bound(pairs.begin(), pairs.end(), pair);
  if (at != pairs.end() && *at == pair) value[at - pairs.begin()] += x;
}

void list_rubbing(const Tape& tape, std::vector<int>& pairs) {
  pairs.clear();
  const auto add = [&](int pair, double friction) {
    if (friction > 0) pairs.push_back(pair);
  };
  for (int k = 0; k < tape.n_arcs; ++k) {
    const TapeArc& arc = tape.arcs[static_cast<std::size_t>(k)];
    for (int i = 0; i < arc.n_held; ++i) {
      add(arc.held[static_cast<std::size_t>(i)].pair,
          arc.held[static_cast<std::size_t>(i)].friction);
    }
    for (int i = 0; i < arc.n_kick; ++i) {
      add(arc.kick[static_cast<std::size_t>(i)].pair,
          arc.kick[static_cast<std::size_t>(i)].friction);
    }
  }
  for (int k = 0; k < tape.n_impacts; ++k) {
    const TapeImpact& impact = tape.impacts[static_cast<std::size_t>(k)];
    for (const TapeImpulse& each : impact.impulses) {
      const TapeContact& contact = impact.contacts[static_cast<std::size_t>(each.contact)];
      add(contact.pair, contact.friction);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

}  // namespace saltus
