// How far the contacts that rest at the start of an arc are from Coulomb's law in it.
#pragma once

#include "variational/flight.hpp"

namespace saltus {

constexpr double strict = 1e-10;  ///< lawlessness that is none

/// Of the most lawless contact, which is then flight.closing: by a part of the forces, or of the
/// speeds that there are. One that is pulled, or that sinks and is not held, is quite so: 1.
double lawlessness(const ModelData& model, const Node& node, Flight& flight);

}  // namespace saltus
