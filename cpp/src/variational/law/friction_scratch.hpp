// What a node or a flight keeps of friction from one arc to the next.
#pragma once

#include <vector>

#include "saltus/variational/friction.hpp"
#include "variational/law/pile.hpp"

namespace saltus {

/// What an impulse was in the last arc, for a guess.
struct ImpulseMemory {
  Vec3 p = Vec3::Zero();  ///< [N s] over `tau`
  double tau = 0;         ///< [s]
  int flight = -1;        ///< its number; an older one is no guess
};

/// Empty where no materials have friction.
struct FrictionScratch {
  explicit FrictionScratch(bool with_friction);
  void reserve(std::size_t contacts);  ///< no effect where there is room
  bool any;                            ///< some pair of materials has friction
  ContactBlocks W;
  std::vector<Vec3> u, p;
  std::vector<int> contact;  ///< of each block: an index in the node's or flight's list
  std::vector<FrictionImpulse> impulses;
  PileScratch pile;
  std::vector<ImpulseMemory> memory;  ///< (pool), of a node
  double residual = 0;  ///< of Coulomb's law, the largest of a step's closing half kicks
  int flight = 0;       ///< the number of the flight that leaves the node
};

/// Index in `contact` of the one that is farthest from Coulomb's law, for messages.
int most_lawless(const FrictionScratch& x);

}  // namespace saltus
