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
#include "urdf/warnings.hpp"

namespace saltus::reader {

struct MeshFolders {
  std::filesystem::path urdf;
  std::vector<std::string> packages;
};

/// Reads the meshes of one URDF file, each once.
class CollisionMeshes {
 public:
  /// `use` holds for links of which the block `<saltus>` does not say otherwise.
  CollisionMeshes(const Document& document, MeshFolders folders, MeshFiles& files, MeshUse use,
                  Warnings& warnings);

  /// The hull of this mesh of the link; null where the link's meshes are not used, or this one is
  /// not found. Meshes with the same file and scale have the same hull.
  /// One that is flat is a thin plate, below the side that its faces look at, and a flaw; one of an
  /// unknown format is a flaw, too, and null.
  /// @throws ModelError where the file has no hull, or the scale is zero.
  std::shared_ptr<const Hull> hull(const XMLElement& mesh, const std::string& link);

  /// What became of them, in a line for those that were found and one for the others.
  void warn(ModelBuilder& builder) const;

 private:
  using Key = std::tuple<std::string, double, double, double>;  // file, scale
  struct Mesh {
    std::filesystem::path file;
    Vec3 scale;
    std::string uri;
  };
  std::shared_ptr<const Hull> hull_of(const Mesh& mesh, bool flat);
  Vec3 face_normal(const Mesh& mesh);

  const Document& document_;
  MeshFolders folders_;
  MeshFiles& files_;
  Warnings& warnings_;
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
