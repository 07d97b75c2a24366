// Collision meshes as convex hulls.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "saltus/collision/hull.hpp"
#include "saltus/urdf/load_urdf.hpp"
#include "urdf/document.hpp"
#include "urdf/mesh_file.hpp"

namespace saltus::reader {

struct MeshFolders {
  std::filesystem::path urdf;
  std::vector<std::string> packages;
};

/// Reads the meshes of one URDF file, each once.
class CollisionMeshes {
 public:
  /// `use` holds for links of which the block `<saltus>` does not say otherwise.
  CollisionMeshes(const Document& document, MeshFolders folders, MeshFiles& files, MeshUse use);

  /// The hull of this mesh of the link; null where the link's meshes are not used, or this one is
  /// not found. Meshes with the same file and scale have the same hull.
  /// @throws ModelError where the file has no hull, or the scale is zero.
  std::shared_ptr<const Hull> hull(const XMLElement& mesh, const std::string& link);

  /// What became of them, in a line for those that were found and one for the others.
  void warn(ModelBuilder& builder) const;

 private:
  using Key = std::tuple<std::string, double, double, double>;  // file, scale
  std::shared_ptr<const Hull> hull_of(const std::filesystem::path& file, const Vec3& scale,
                                      const std::string& name);

  const Document& document_;
  MeshFolders folders_;
  MeshFiles& files_;
  MeshUse use_;
  std::map<std::string, MeshUse> use_of_link_;
  std::map<Key, std::shared_ptr<const Hull>> hulls_;
  struct Used {
    std::string uri, count;
  };
  std::vector<Used> used_;                  // one for each of hulls_
  std::string first_used_, first_missing_;  // the place in the file, and the link
  int missing_ = 0;
};

}  // namespace saltus::reader
