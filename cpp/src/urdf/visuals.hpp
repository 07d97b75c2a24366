// What links look like, from `<visual>`.
#pragma once

#include <map>
#include <string>

#include "saltus/model/model_builder.hpp"
#include "urdf/collision_meshes.hpp"
#include "urdf/document.hpp"
#include "urdf/mesh_file.hpp"

namespace saltus::reader {

/// Adds all visuals. None makes reading fail: one that is missing or broken is left out, and one
/// warning tells of all of them.
class Visuals {
 public:
  Visuals(const Document& document, const MeshFolders& folders, MeshFiles& files)
      : document_(document), folders_(folders), files_(files) {}

  void add(ModelBuilder& builder);

 private:
  void add(const XMLElement& visual, const std::string& link, ModelBuilder& builder);
  void add_mesh(const XMLElement& mesh, Visual visual, const std::optional<Rgba>& rgba,
                ModelBuilder& builder);
  std::optional<Rgba> colour(const XMLElement& visual) const;
  void find_materials();
  void leave_out(const XMLElement& element, const std::string& link, const std::string& what);

  const Document& document_;
  const MeshFolders& folders_;
  MeshFiles& files_;
  std::map<std::string, Rgba> materials_;  // by name
  std::map<std::tuple<std::string, double, double, double>, std::vector<TriangleMesh>> meshes_;
  std::string first_;  // of those left out
  int left_out_ = 0;
};

}  // namespace saltus::reader
