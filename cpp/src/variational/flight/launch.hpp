// The arc that leaves an impact, under the laws that make it match an energy.
//
// nodal_energy has its impulses in closed form. The others change the last strong impulse of the
// cascade by some delta n, so that an energy of what follows is that of what came before:
//
//   discrete_energy  E_d of the arc; paper, (11c). One more equation of the arc itself
//   compensated      the same, of arcs of L + (h^2 - tau^2) kappa / 24
//   shadow_energy    H - h^2 kappa / 24 at the end of the step; a root in delta alone
//
// An impulse too weak to carry the difference stays as it is (theory, section 5, warning a).
#pragma once

#include "variational/flight/flight.hpp"

namespace saltus {

/// Meets the launch by the arc over `left`, which is solved without it in flight.work.
/// @return false where that was not possible; the arc is then as it was.
bool meet(const Scene& scene, double left, const Launch& launch, const Node& node, Flight& flight);

/// Gives the energy of a launch up where an arc that matches it has no end: the next arc is solved
/// from the node anew.
void give_up(const Node& node, Flight& flight);

}  // namespace saltus
