#include "urdf/mesh_path.hpp"

#include <algorithm>

#include "saltus/model/model.hpp"

namespace saltus::reader {
namespace {

namespace fs = std::filesystem;

bool begins_with(const std::string& text, const std::string& prefix) {
  return text.rfind(prefix, 0) == 0;
}

/// Looks for `relative` below the folder unless it is found already.
void look(MeshPath& mesh, const fs::path& folder, const fs::path& relative) {
  if (!mesh.found.empty()) return;
  const std::string shown = folder.string();
  if (std::find(mesh.folders.begin(), mesh.folders.end(), shown) != mesh.folders.end()) return;
  mesh.folders.push_back(shown);
  std::error_code error;
  if (fs::is_regular_file(folder / relative, error)) mesh.found = folder / relative;
}

void look_for_package(MeshPath& mesh, const fs::path& folder, const fs::path& package,
                      const fs::path& rest) {
  look(mesh, folder, package / rest);
  if (folder.filename() == package) look(mesh, folder.parent_path(), package / rest);
}

/// The folder itself without "." and "..", and without the empty last part of "a/b/".
fs::path clean(const std::string& folder) {
  std::error_code error;
  const fs::path path = fs::absolute(folder, error).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

MeshPath find_in_package(const std::string& path, const fs::path& urdf_folder,
                         const std::vector<std::string>& package_dirs) {
  const std::size_t slash = std::min(path.find('/'), path.size());
  const fs::path package = path.substr(0, slash);
  const fs::path rest = path.substr(std::min(slash + 1, path.size()));
  MeshPath mesh;
  for (const std::string& folder : package_dirs) {
    look_for_package(mesh, clean(folder), package, rest);
  }
  for (fs::path folder = urdf_folder; !folder.empty(); folder = folder.parent_path()) {
    look_for_package(mesh, folder, package, rest);
    if (folder == folder.parent_path()) break;
  }
  return mesh;
}

}  // namespace

MeshPath find_mesh(const std::string& uri, const fs::path& urdf_folder,
                   const std::vector<std::string>& package_dirs) {
  for (const std::string scheme : {"package://", "model://"}) {
    if (!begins_with(uri, scheme)) continue;
    return find_in_package(uri.substr(scheme.size()), urdf_folder, package_dirs);
  }
  const fs::path path = begins_with(uri, "file://") ? uri.substr(7) : uri;
  MeshPath mesh;
  if (path.is_absolute()) {
    look(mesh, path.parent_path(), path.filename());
    return mesh;
  }
  look(mesh, urdf_folder, path);
  for (const std::string& folder : package_dirs) look(mesh, clean(folder), path);
  return mesh;
}

std::string describe(const MeshPath& mesh) {
  if (!mesh.found.empty()) return "found at " + mesh.found.string();
  return "not found; looked in " + list_names(mesh.folders);
}

}  // namespace saltus::reader
