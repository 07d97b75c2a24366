// Files that a test writes: URDF, and meshes in the three formats.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "urdf/urdf_text.hpp"

namespace saltus::test {

namespace fs = std::filesystem;

/// An empty folder of this test's own, gone afterwards.
class UrdfFiles : public testing::Test {
 protected:
  void SetUp() override {
    const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    std::random_device seed;
    folder_ = fs::temp_directory_path() / ("saltus_" + name + std::to_string(seed()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string write(const fs::path& name, const std::string& text) {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }

  fs::path folder_;
};

/// Points, and triangles between them.
struct Mesh {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;
};

inline Mesh tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 4}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

inline std::string show(const Vec3& p) {
  std::ostringstream text;
  text << p[0] << " " << p[1] << " " << p[2];
  return text.str();
}

inline std::string ascii_stl(const Mesh& mesh) {
  std::string text = "solid it\n";
  for (const auto& triangle : mesh.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int i : triangle) text += "vertex " + show(mesh.points[i]) + "\n";
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid it\n";
}

/// `header` may be "solid ...", as some programs write it.
inline std::string binary_stl(const Mesh& mesh, std::string header = "") {
  header.resize(80);
  const auto put = [&](const auto& value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    header.append(bytes, sizeof value);
  };
  put(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) put(0.0f);
    for (const int i : triangle) {
      for (int k = 0; k < 3; ++k) put(static_cast<float>(mesh.points[i][k]));
    }
    put(std::uint16_t{0});
  }
  return header;
}

inline std::string obj(const Mesh& mesh) {
  std::string text = "mtllib none.mtl\n";
  for (const Vec3& p : mesh.points) text += "v " + show(p) + "\n";
  for (const auto& [a, b, c] : mesh.triangles) {
    for (const int i : {a, b, c}) text += (i == a ? "f " : " ") + std::to_string(i + 1);
    text += "\n";
  }
  return text;
}

/// `asset`: <unit> and <up_axis>; `transform`: of the node, as <translate>.
inline std::string dae(const Mesh& mesh, const std::string& asset = "",
                       const std::string& transform = "") {
  std::string points, indices;
  for (const Vec3& p : mesh.points) points += show(p) + " ";
  for (const auto& triangle : mesh.triangles) {
    for (const int i : triangle) indices += std::to_string(i) + " ";
  }
  const std::string n = std::to_string(mesh.points.size());
  return "<?xml version=\"1.0\"?>\n<COLLADA "
         "xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\"><asset>" +
         asset +
         "</asset><library_geometries><geometry id=\"g\"><mesh><source id=\"s\"><float_array "
         "id=\"a\" count=\"" +
         std::to_string(3 * mesh.points.size()) + "\">" + points +
         "</float_array><technique_common><accessor source=\"#a\" count=\"" + n +
         "\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" "
         "type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor></technique_common>"
         "</source><vertices id=\"v\"><input semantic=\"POSITION\" source=\"#s\"/></vertices>"
         "<triangles count=\"" +
         std::to_string(mesh.triangles.size()) +
         "\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>" + indices +
         "</p></triangles></mesh></geometry></library_geometries><library_visual_scenes>"
         "<visual_scene id=\"w\"><node id=\"n\">" +
         transform +
         "<instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes><scene>"
         "<instance_visual_scene url=\"#w\"/></scene></COLLADA>\n";
}

}  // namespace saltus::test
