#include "urdf/mesh_file.hpp"

#include <assimp/config.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <string>

#include "saltus/error.hpp"

namespace saltus::reader {
namespace {

namespace fs = std::filesystem;

using Transform = Eigen::Matrix4d;

[[noreturn]] void fail(const std::string& what) { throw ModelError(what); }

std::string ending(const fs::path& file) {
  std::string text = file.extension().string();
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::string read(std::ifstream& file, std::uintmax_t from, std::uintmax_t count) {
  std::string text(count, '\0');
  file.seekg(static_cast<std::streamoff>(from));
  file.read(text.data(), static_cast<std::streamsize>(count));
  return text;
}

/// Assimp reads as far as an ASCII file goes, and does not say why it refuses a binary one.
void check_stl_is_whole(const fs::path& path, std::uintmax_t size) {
  constexpr std::uintmax_t header = 84, facet = 50;
  std::ifstream file(path, std::ios::binary);
  const std::string head = read(file, 0, std::min(size, header));
  if (head.rfind("version https://git-lfs", 0) == 0) fail("is a pointer of Git LFS, not the mesh");
  std::uintmax_t facets = 0;
  for (std::size_t i = 0; i < 4 && 80 + i < head.size(); ++i) {
    facets += std::uintmax_t{static_cast<unsigned char>(head[80 + i])} << (8 * i);
  }
  const std::uintmax_t needed = header + facet * facets;
  if (size >= header && size == needed) return;
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && head.compare(first, 5, "solid") == 0) {
    const std::uintmax_t tail = std::min<std::uintmax_t>(size, 4096);
    if (read(file, size - tail, tail).find("endsolid") == std::string::npos) {
      fail("is cut short: an ASCII STL ends with \"endsolid\"");
    }
  } else if (size < needed || size < header) {
    fail("is cut short: it has " + std::to_string(size) + " bytes, and a binary STL of " +
         std::to_string(facets) + " facets has " + std::to_string(needed));
  }
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

void add_vertices(const aiScene& scene, const aiNode& node, const Transform& above,
                  std::vector<Vec3>& vertices) {
  Transform own;
  for (unsigned row = 0; row < 4; ++row) {
    for (unsigned column = 0; column < 4; ++column) {
      own(row, column) = static_cast<double>(node.mTransformation[row][column]);
    }
  }
  const Transform T = above * own;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
    for (unsigned k = 0; k < mesh.mNumVertices; ++k) {
      const aiVector3D& v = mesh.mVertices[k];
      const Vec3 p(as_written(v.x), as_written(v.y), as_written(v.z));
      vertices.push_back(T.topLeftCorner<3, 3>() * p + T.topRightCorner<3, 1>());
    }
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) {
    add_vertices(scene, *node.mChildren[i], T, vertices);
  }
}

void keep_distinct(std::vector<Vec3>& vertices) {
  const auto key = [](const Vec3& v) { return std::array<double, 3>{v[0], v[1], v[2]}; };
  std::sort(vertices.begin(), vertices.end(),
            [&](const Vec3& a, const Vec3& b) { return key(a) < key(b); });
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
}

}  // namespace

std::vector<Vec3> read_mesh(const fs::path& file) {
  const std::string format = ending(file);
  if (format != ".stl" && format != ".obj" && format != ".dae") {
    fail("has an unknown format, \"" + format + "\"; known are .stl, .obj, .dae");
  }
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) fail("cannot be opened: " + error.message());
  if (size == 0) fail("is empty");
  if (format == ".stl") check_stl_is_whole(file, size);

  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene = importer.ReadFile(file.string(), 0);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    fail("cannot be read: " + std::string(importer.GetErrorString()));
  }
  std::vector<Vec3> vertices;
  add_vertices(*scene, *scene->mRootNode, Transform::Identity(), vertices);
  if (vertices.empty()) fail("has no vertices");
  for (const Vec3& v : vertices) {
    if (!v.allFinite()) fail("has a vertex that is not finite");
  }
  keep_distinct(vertices);
  return vertices;
}

}  // namespace saltus::reader
