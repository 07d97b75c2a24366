// Room for an impact with friction at a node.
#pragma once

#include <vector>

#include "saltus/variational/friction.hpp"
#include "variational/law/pile.hpp"

namespace saltus {

/// Empty where no materials have friction.
struct FrictionScratch {
  explicit FrictionScratch(bool with_friction);
  void reserve(std::size_t contacts);  ///< no effect where there is room
  bool any;                            ///< some pair of materials has friction
  ContactBlocks W;
  std::vector<Vec3> u, p;
  std::vector<FrictionImpulse> impulses;
  PileScratch pile;
};

}  // namespace saltus
