// The energies of a state, and the shadow energy (modified Hamiltonian) of a fixed step.
#pragma once

namespace saltus {

/// Energies of one state.
struct Energies {
  double kinetic;    ///< [J]
  double potential;  ///< [J]
  double shadow;     ///< [J] H - h^2 kappa / 24, conserved to O(h^4) (theory, section 5)
};

}  // namespace saltus
