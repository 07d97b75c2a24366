// Where a mesh file is.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace saltus::reader {

struct MeshPath {
  std::filesystem::path found;       ///< "" where there is no such file
  std::vector<std::string> folders;  ///< where it was looked for, in this order, each once
};

/// `package://name/rest` and `model://name/rest` in each package directory and each folder above
/// the URDF file that holds `name` or is `name` itself; `file://` and absolute paths as they are;
/// relative paths in the URDF file's folder and the package directories.
MeshPath find_mesh(const std::string& uri, const std::filesystem::path& urdf_folder,
                   const std::vector<std::string>& package_dirs);

/// "found at /a/b.stl" or "not found; looked in /a, /b".
std::string describe(const MeshPath& mesh);

}  // namespace saltus::reader
