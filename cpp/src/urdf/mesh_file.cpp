#include "urdf/mesh_file.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <numeric>

#include "urdf/mesh_checks.hpp"

namespace saltus::reader {
namespace {

namespace fs = std::filesystem;

using Transform = Eigen::Matrix4d;

std::string ending(const fs::path& file) {
  std::string text = file.extension().string();
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// The decimal number that a single-precision number was written as, most likely: 0.1 for the float
/// next to 0.1, which is 1.5e-9 off. A cube of 0.2 m then stands at 0.1 m without an overlap.
double as_written(float x) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), x).ptr;
  double out = static_cast<double>(x);
  std::from_chars(text.data(), end, out);
  return out;
}

Transform transform_of(const aiNode& node) {
  Transform T;
  for (unsigned row = 0; row < 4; ++row) {
    for (unsigned column = 0; column < 4; ++column) {
      T(row, column) = as_written(node.mTransformation[row][column]);
    }
  }
  return T;
}

/// None of a material that Assimp made up because the file has none.
std::optional<Rgba> colour_of(const aiScene& scene, const aiMesh& mesh) {
  if (mesh.mMaterialIndex >= scene.mNumMaterials) return {};
  const aiMaterial& material = *scene.mMaterials[mesh.mMaterialIndex];
  if (material.GetName() == aiString(AI_DEFAULT_MATERIAL_NAME)) return {};
  aiColor4D colour;
  if (material.Get(AI_MATKEY_COLOR_DIFFUSE, colour) != AI_SUCCESS) return {};
  float opacity = 1;
  material.Get(AI_MATKEY_OPACITY, opacity);
  if (!(opacity > 0)) opacity = 1;  // programs disagree on which end of COLLADA's is opaque
  const auto part = [](float x) { return x >= 0 && x <= 1 ? as_written(x) : x > 1 ? 1.0 : 0.0; };
  return Rgba{part(colour.r), part(colour.g), part(colour.b), part(colour.a * opacity)};
}

using Surfaces = std::map<std::optional<Rgba>, Triangles>;

void add_mesh(const aiMesh& mesh, const Transform& T, Triangles& out) {
  constexpr std::size_t most_vertices = 10'000'000;
  const std::size_t first = out.vertices.size();
  if (first + mesh.mNumVertices > most_vertices) fail_mesh("has more than 10^7 vertices");
  for (unsigned k = 0; k < mesh.mNumVertices; ++k) {
    const aiVector3D& v = mesh.mVertices[k];
    const Vec3 p(as_written(v.x), as_written(v.y), as_written(v.z));
    out.vertices.push_back(T.topLeftCorner<3, 3>() * p + T.topRightCorner<3, 1>());
  }
  const bool is_mirrored = T.topLeftCorner<3, 3>().determinant() < 0;
  for (unsigned k = 0; k < mesh.mNumFaces; ++k) {
    const aiFace& face = mesh.mFaces[k];
    if (face.mNumIndices != 3) continue;  // points and lines
    std::array<int, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) corners[i] = static_cast<int>(first + face.mIndices[i]);
    if (is_mirrored) std::swap(corners[1], corners[2]);
    out.faces.push_back(corners);
  }
}

void add_node(const aiScene& scene, const aiNode& node, const Transform& above,
              Surfaces& surfaces) {
  const Transform T = above * transform_of(node);
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
    add_mesh(mesh, T, surfaces[colour_of(scene, mesh)]);
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) add_node(scene, *node.mChildren[i], T, surfaces);
}

/// Are there faces of more than three corners? Assimp must not be asked to cut them where a part of
/// the file has none at all.
bool has_polygons(const aiScene& scene) {
  bool any = false, empty = false;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[i];
    empty = empty || mesh.mNumFaces == 0 || mesh.mFaces == nullptr || mesh.mVertices == nullptr;
    for (unsigned k = 0; k < mesh.mNumFaces; ++k) any = any || mesh.mFaces[k].mNumIndices > 3;
  }
  if (any && empty) fail_mesh("cannot be read: a part of it is empty");
  return any;
}

/// Makes vertices distinct, in the order of their coordinates, and drops faces without area.
void unite(Triangles& mesh) {
  std::vector<Vec3>& vertices = mesh.vertices;
  const auto key = [&](int i) {
    const Vec3& v = vertices[static_cast<std::size_t>(i)];
    return std::array<double, 3>{v[0], v[1], v[2]};
  };
  std::vector<int> order(vertices.size()), number(vertices.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  std::vector<Vec3> distinct;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto at = static_cast<std::size_t>(order[i]);
    if (i == 0 || key(order[i - 1]) != key(order[i])) distinct.push_back(vertices[at]);
    number[at] = static_cast<int>(distinct.size()) - 1;
  }
  vertices = std::move(distinct);
  for (std::array<int, 3>& face : mesh.faces) {
    for (int& corner : face) corner = number[static_cast<std::size_t>(corner)];
  }
  std::erase_if(mesh.faces, [](const std::array<int, 3>& f) {
    return f[0] == f[1] || f[1] == f[2] || f[2] == f[0];
  });
}

}  // namespace

std::string unknown_format(const fs::path& file) {
  const std::string format = ending(file);
  if (format == ".stl" || format == ".obj" || format == ".dae") return "";
  return "has an unknown format, \"" + format + "\"; known are .stl, .obj, .dae";
}

std::vector<MeshSurface> read_mesh(const fs::path& file) {
  constexpr std::uintmax_t most_bytes = std::uintmax_t{256} << 20;
  const std::string format = ending(file), unknown = unknown_format(file);
  if (!unknown.empty()) fail_mesh(unknown);
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) fail_mesh("cannot be opened: " + error.message());
  if (size == 0) fail_mesh("is empty");
  if (size > most_bytes) fail_mesh("has more than 256 MiB, the most that is read as a mesh");
  check_is_here(file);
  if (format == ".stl") check_stl(file, size);
  if (format == ".dae") check_dae(file);

  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene = importer.ReadFile(file.string(), 0);
  if (scene != nullptr && has_polygons(*scene)) {
    scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  }
  if (scene == nullptr || scene->mRootNode == nullptr) {
    fail_mesh("cannot be read: " + std::string(importer.GetErrorString()));
  }
  Surfaces found;
  add_node(*scene, *scene->mRootNode, Transform::Identity(), found);
  std::vector<MeshSurface> surfaces;
  for (auto& [rgba, triangles] : found) {
    if (triangles.vertices.empty()) continue;
    for (const Vec3& v : triangles.vertices) {
      if (!v.allFinite()) fail_mesh("has a vertex that is not finite");
    }
    unite(triangles);
    surfaces.push_back({rgba, std::move(triangles)});
  }
  if (surfaces.empty()) fail_mesh("has no vertices");
  return surfaces;
}

const std::vector<MeshSurface>& MeshFiles::surfaces(const fs::path& file) {
  const std::string name = file.lexically_normal().string();
  const auto found = read_.find(name);
  return found == read_.end() ? read_.emplace(name, read_mesh(file)).first->second : found->second;
}

std::vector<Vec3> MeshFiles::points(const fs::path& file) {
  Triangles all;
  for (const MeshSurface& surface : surfaces(file)) {
    all.vertices.insert(all.vertices.end(), surface.triangles.vertices.begin(),
                        surface.triangles.vertices.end());
  }
  unite(all);
  return std::move(all.vertices);
}

}  // namespace saltus::reader
