// What a joint's limits and its <mimic> come to, where they are not as URDF has them.
#pragma once

#include <optional>

#include "urdf/document.hpp"

namespace saltus::reader {

/// Is no value within? lower="1" upper="0" is Bullet's way to say "no limit".
bool are_crossed(const XMLElement& limit);

/// [rad | m] where a joint stands that mimics one that is fixed, or another that stands so; nothing
/// where it moves, or mimics itself, or what is not there.
std::optional<double> locked_displacement(const Document& document, const XMLElement& joint);

}  // namespace saltus::reader
