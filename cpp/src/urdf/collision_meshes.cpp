#include "urdf/collision_meshes.hpp"

#include <cmath>

#include "urdf/attributes.hpp"
#include "urdf/extension.hpp"
#include "urdf/mesh_path.hpp"

namespace saltus::reader {

namespace {

/// Adds to points in a plane the same 10^-5 of their size below, and 10^-5 m at least.
void thicken(std::vector<Vec3>& points, const Vec3& side) {
  Vec3 low = points.front(), high = low;
  for (const Vec3& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const Vec3 step = 1e-5 * std::fmax((high - low).norm(), 1.0) * side.normalized();
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; ++i) points.push_back(points[i] - step);
}

}  // namespace

CollisionMeshes::CollisionMeshes(const Document& document, MeshFolders folders, MeshFiles& files,
                                 MeshUse use, Warnings& warnings)
    : document_(document),
      folders_(std::move(folders)),
      files_(files),
      warnings_(warnings),
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
  const std::string place = document_.at(mesh) + owner.show() + " ";
  const std::string unknown = unknown_format(path.found);
  if (!unknown.empty()) {
    warnings_.add_flaw("mesh format", place + subject + "which " + unknown, "; it is not used",
                       owner);
    return nullptr;
  }
  if (used_.empty()) first_used_ = place;
  const Mesh found{path.found, scale, name};
  std::string what;
  try {
    return hull_of(found, false);
  } catch (const ModelError& error) {
    what = error.what();
  }
  const bool is_flat = what.find("plane") != std::string::npos;
  what = subject + "which " + what + " (" + describe(path) + "); " +
         (is_flat ? "a floor is <half_space name=\"floor\"/> in <saltus>, and " : "") +
         "<mesh link=" + in_quotes(link) + " use=\"none\"/> in <saltus> does without it";
  std::shared_ptr<const Hull> plate;
  try {
    if (is_flat) plate = hull_of(found, true);
  } catch (const ModelError&) {
    plate = nullptr;  // it is a line
  }
  if (plate == nullptr) document_.fail(mesh, owner, what);
  warnings_.add_flaw("flat mesh", place + what, "; it is read as a thin plate", owner);
  return plate;
}

/// The sum over all triangles of twice their area, out of the side that they look at.
Vec3 CollisionMeshes::face_normal(const Mesh& mesh) {
  Vec3 sum = Vec3::Zero(), any = Vec3::Zero();
  for (const MeshSurface& surface : files_.surfaces(mesh.file)) {
    const std::vector<Vec3>& v = surface.triangles.vertices;
    for (const auto& [a, b, c] : surface.triangles.faces) {
      const auto side = [&](int to) -> Vec3 {
        return (v[static_cast<std::size_t>(to)] - v[static_cast<std::size_t>(a)])
            .cwiseProduct(mesh.scale);
      };
      const Vec3 normal = side(b).cross(side(c));
      sum += normal;
      if (normal.norm() > any.norm()) any = normal;
    }
  }
  const bool looks_both_ways = sum.norm() < 0.5 * any.norm();
  const Vec3 normal = looks_both_ways ? any : sum;
  return mesh.scale.prod() < 0 ? Vec3(-normal) : normal;
}

std::shared_ptr<const Hull> CollisionMeshes::hull_of(const Mesh& mesh, bool flat) {
  const Vec3& scale = mesh.scale;
  std::shared_ptr<const Hull>& hull =
      hulls_[{mesh.file.lexically_normal().string(), scale[0], scale[1], scale[2]}];
  if (hull != nullptr) return hull;
  std::vector<Vec3> vertices = files_.points(mesh.file);
  const std::size_t count = vertices.size();
  for (Vec3& v : vertices) v = v.cwiseProduct(scale);
  if (flat) thicken(vertices, face_normal(mesh));
  hull = std::make_shared<const Hull>(convex_hull(vertices, "has no convex hull"));
  if (!flat) {
    used_.push_back({mesh.uri, " (" + std::to_string(hull->vertices.size()) + " of its " +
                                   std::to_string(count) + " vertices)"});
  }
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
