// The energies of a state, and the one that a fixed step conserves.
#pragma once

namespace saltus {

/// Energies of one state.
struct Energies {
  double kinetic, potential;  ///< [J]
  double shadow;              ///< [J] H - h^2 kappa / 24 (theory, section 5)
};

}  // namespace saltus
