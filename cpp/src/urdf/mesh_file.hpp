// The triangles of a mesh file.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "saltus/model/visual.hpp"

namespace saltus::reader {

/// What of a mesh file has one colour; none where the file says none.
struct MeshSurface {
  std::optional<Rgba> rgba;
  Triangles triangles;  ///< vertices distinct; those that no triangle has are there too
};

/// "" where the ending of the file's name is known; else what a sentence about it goes on with.
std::string unknown_format(const std::filesystem::path& file);

/// The surfaces of an STL (binary or ASCII), OBJ or DAE file, in the file's axes: a DAE's `<unit>`
/// and the transforms of its nodes are applied, its `<up_axis>` is not, as in RViz and other
/// robotics tools. Bounds: 256 MiB, 10^7 vertices; of a DAE, see check_dae. Thread-safe.
/// @throws ModelError "is empty", "is cut short: ...": what a sentence about the file goes on with.
std::vector<MeshSurface> read_mesh(const std::filesystem::path& file);

/// Reads the mesh files of a robot, each once.
class MeshFiles {
 public:
  /// @throws as read_mesh.
  const std::vector<MeshSurface>& surfaces(const std::filesystem::path& file);
  /// The distinct vertices of all surfaces.
  std::vector<Vec3> points(const std::filesystem::path& file);

 private:
  std::map<std::string, std::vector<MeshSurface>> read_;
};

}  // namespace saltus::reader
