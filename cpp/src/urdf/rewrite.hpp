// The file as every version of urdfdom reads it.
#pragma once

#include <string>
#include <vector>

#include "saltus/spatial/spatial.hpp"
#include "urdf/document.hpp"

namespace saltus::reader {

/// Stands for "no limit": urdfdom reads neither "inf" nor, in URDF 1.0, a limit that is not there.
constexpr double no_limit = 1.7976931348623157e308;  // the largest double

/// The shape of a `<collision>` that is used, or null.
const XMLElement* usable_shape(const XMLElement& collision);

/// URDF 1.1's quat_xyzw, of any length but 0.
Mat3 rotation_from_quaternion(const std::vector<double>& xyzw);

/// URDF 1.0 text of what is used: links, inertias, collisions with a usable shape, joints. Numbers
/// are normalised ("+1", tabs, quat_xyzw), all shapes are balls and spherical joints floating ones.
/// Needs the checks.
std::string rewrite(const Document& document);

}  // namespace saltus::reader
