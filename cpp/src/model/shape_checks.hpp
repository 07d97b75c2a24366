// What no shape of a model may be.
#pragma once

#include <string>

#include "saltus/collision/shapes.hpp"

namespace saltus {

/// @throws ModelError about the link: sizes that are not finite and positive, a convex without a
/// hull or with one that does not fit together.
void check_shape(const Shape& shape, const std::string& link);

}  // namespace saltus
