#include "urdf/collision_meshes.hpp"

#include "urdf/attributes.hpp"
#include "urdf/extension.hpp"
#include "urdf/mesh_path.hpp"

namespace saltus::reader {

CollisionMeshes::CollisionMeshes(const Document& document, MeshFolders folders, MeshFiles& files,
                                 MeshUse use)
    : document_(document),
      folders_(std::move(folders)),
      files_(files),
      use_(use),
      use_of_link_(mesh_uses(document)) {}

std::shared_ptr<const Hull> CollisionMeshes::hull(const XMLElement& mesh, const std::string& link) {
  const auto said = use_of_link_.find(link);
  if ((said == use_of_link_.end() ? use_ : said->second) == MeshUse::none) return nullptr;
  const Owner owner{"link", link};
  const std::string name = attribute(mesh, "filename");
  const std::string subject = "has a collision mesh, " + in_quotes(name) + ", ";
  const Vec3 scale = vector(mesh, "scale", Vec3::Ones());
  if ((scale.array() == 0).any()) {
    document_.fail(mesh, owner,
                   subject + "with scale=" + in_quotes(attribute(mesh, "scale")) +
                       ": a scale of zero makes it flat");
  }
  const MeshPath path = find_mesh(name, folders_.urdf, folders_.packages);
  if (path.found.empty()) {
    if (++missing_ == 1) {
      first_missing_ =
          document_.at(mesh) + owner.show() + " " + subject + "which is " + describe(path);
    }
    return nullptr;
  }
  try {
    if (used_.empty()) first_used_ = document_.at(mesh) + owner.show() + " ";
    return hull_of(path.found, scale, name);
  } catch (const ModelError& error) {
    document_.fail(mesh, owner,
                   subject + "which " + error.what() + " (" + describe(path) + "); <mesh link=" +
                       in_quotes(link) + " use=\"none\"/> in <saltus> does without it");
  }
}

std::shared_ptr<const Hull> CollisionMeshes::hull_of(const std::filesystem::path& file,
                                                     const Vec3& scale, const std::string& name) {
  std::shared_ptr<const Hull>& hull =
      hulls_[{file.lexically_normal().string(), scale[0], scale[1], scale[2]}];
  if (hull != nullptr) return hull;
  std::vector<Vec3> vertices = files_.points(file);
  for (Vec3& v : vertices) v = v.cwiseProduct(scale);
  hull = std::make_shared<const Hull>(convex_hull(vertices, "has no convex hull"));
  used_.push_back({name, " (" + std::to_string(hull->vertices.size()) + " of its " +
                             std::to_string(vertices.size()) + " vertices)"});
  return hull;
}

void CollisionMeshes::warn(ModelBuilder& builder) const {
  if (used_.size() == 1) {
    builder.add_warning(first_used_ + "has a collision mesh, used as its convex hull: " +
                        in_quotes(used_.front().uri) + used_.front().count);
  } else if (!used_.empty()) {
    std::vector<std::string> files;  // without their folders, for a line that can be read
    for (const Used& used : used_) {
      files.push_back(used.uri.substr(used.uri.find_last_of('/') + 1) + used.count);
    }
    builder.add_warning(first_used_ + "and below: " + std::to_string(used_.size()) +
                        " collision meshes are used as their convex hulls: " + list_names(files));
  }
  if (missing_ == 0) return;
  const std::string others =
      missing_ == 1 ? "" : "; so are " + std::to_string(missing_ - 1) + " others";
  builder.add_warning(first_missing_ + others);
}

}  // namespace saltus::reader
