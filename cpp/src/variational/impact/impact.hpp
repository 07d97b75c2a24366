// What an impact does to the momenta at a node (theory, sections 5 and 6).
#pragma once

#include <vector>

#include "variational/law/friction_scratch.hpp"
#include "variational/node/delassus.hpp"

namespace saltus {

/// What laws other than nodal_energy ask of the arc after an impact: this energy, by a change of
/// the last strong impulse, along n.
struct Launch {
  double energy = 0;         ///< [J] what the law conserves, less what restitution took
  double normal_energy = 0;  ///< [J] u^2 / 2G of the last strong impulse
  VecX n, response;          ///< (n_v) and M^-1 n
  int impulse = -1;          ///< that impulse's index in the report
};

/// Room for impacts, and what the last one left. Written by resolve_impact_at.
struct ImpactScratch {
  explicit ImpactScratch(const Scene& scene);

  Launch launch;
  std::vector<Impulse> impulses;  ///< `pair` is the contact's index
  Neighbours neighbours;
  // without friction
  ContactMatrix G;
  VecX u, rest, restitution;  ///< (touching and more)
  CascadeScratch cascade;
  // with friction
  std::vector<Contact*> colliding;
  FrictionScratch friction;
};

/// Resolves the impact at the node: changes p, v and what contacts do, and appends to the report.
/// @param energy [J] what options.law conserves, before the impact; of no use to nodal_energy
/// @param launch what the next arc has to meet, or nullptr
/// @return false when the cascade does not end (JammedError is the caller's)
bool resolve_impact_at(const Scene& scene, double energy, Node& node, ImpactScratch& s,
                       StepReport& report, const Launch*& launch);

/// Is there a motion that opens all contacts of the node?
bool can_open(const Scene& scene, Node& node, ImpactScratch& s);

}  // namespace saltus
