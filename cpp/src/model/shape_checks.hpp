// What no shape or placement of a model may be.
#pragma once

#include <string>

#include "saltus/collision/shapes.hpp"

namespace saltus {

/// @throws ModelError about the link: sizes that are not finite and positive, a convex without a
/// hull or with one that does not fit together.
void check_shape(const Shape& shape, const std::string& link);

/// The placement, with its rotation made orthonormal; @throws where it is none.
Pose checked_pose(const Pose& X, const std::string& element, const std::string& name);

}  // namespace saltus
