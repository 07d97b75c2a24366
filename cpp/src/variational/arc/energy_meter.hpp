// Energies of states, without allocating.
#pragma once

#include "saltus/lagrangian/shadow.hpp"
#include "saltus/model/model.hpp"
#include "saltus/variational/energies.hpp"

namespace saltus {

/// Velocity and energies of one state; scratch.
struct EnergyMeter {
  explicit EnergyMeter(const ModelData& model);

  VecX v;           ///< (n_v) written by measure
  Energies energy;  ///< written by measure

  Packed w;
  PackedMatrix M;
  FreeMotion free;
};

/// The shadow energy is that of a fixed step h.
/// @return false where the mass matrix is singular
bool measure(const ModelData& model, const VecX& q, const VecX& p, double h, EnergyMeter& meter);

}  // namespace saltus
