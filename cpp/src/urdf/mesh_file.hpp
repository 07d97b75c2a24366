// The points of a mesh file.
#pragma once

#include <filesystem>
#include <vector>

#include "saltus/spatial/spatial.hpp"

namespace saltus::reader {

/// The distinct vertices of an STL (binary or ASCII), OBJ or DAE file, in the file's axes: a DAE's
/// `<unit>` and the transforms of its nodes are applied, its `<up_axis>` is not, as in RViz and
/// other robotics tools. Thread-safe.
/// @throws ModelError "is empty", "is cut short: ...": what a sentence about the file goes on with.
std::vector<Vec3> read_mesh(const std::filesystem::path& file);

}  // namespace saltus::reader
