// What is checked before urdfdom sees the file, because it would let it pass, drop it or refuse it
// without a line. All throw ModelError.
#pragma once

#include <string>

#include "urdf/document.hpp"
#include "urdf/warnings.hpp"

namespace saltus::reader {

/// Elements, attributes and numbers against the schema. What URDF does not know is a warning, in
/// the `<saltus>` block an error.
void check_schema(const Document& document, Warnings& warnings);

/// Names, joint types, axes, limits, rotations; needs check_schema.
void check_elements(const Document& document, Warnings& warnings);

/// Parents, children, one root, no cycle; needs check_elements.
/// @return name of the root link
std::string check_tree(const Document& document);

/// Types of joints, as URDF and this library write them.
bool is_spherical(const std::string& joint_type);  ///< not URDF's
bool has_axis(const std::string& joint_type);

}  // namespace saltus::reader
