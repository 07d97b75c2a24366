#include "saltus/model/visual.hpp"

#include <algorithm>
#include <cmath>

#include "model/assembly.hpp"
#include "model/shape_checks.hpp"

namespace saltus {
namespace {

void check_mesh(const TriangleMesh& mesh, const std::string& link) {
  const auto fail = [&](const std::string& what) {
    throw ModelError("link " + quoted(link) + " has a visual mesh " + what, "link", link);
  };
  if (mesh.triangles == nullptr) return fail("without triangles");
  const std::vector<Vec3>& vertices = mesh.triangles->vertices;
  const int count = static_cast<int>(vertices.size());
  for (int i = 0; i < count; ++i) {
    if (!vertices[i].allFinite()) fail("whose vertex " + std::to_string(i) + " is not finite");
  }
  for (const std::array<int, 3>& face : mesh.triangles->faces) {
    for (const int corner : face) {
      if (corner >= 0 && corner < count) continue;
      fail("with a face of vertex " + std::to_string(corner) + "; it has vertices 0 to " +
           std::to_string(count - 1));
    }
  }
}

}  // namespace

std::string visual_kind(const Visual& visual) {
  const auto* shape = std::get_if<Shape>(&visual.shape);
  return shape == nullptr ? TriangleMesh::name : shape_name(*shape);
}

void check_visual(const Visual& visual) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&visual.shape)) {
    check_mesh(*mesh, visual.link);
  } else {
    const Shape& shape = std::get<Shape>(visual.shape);
    if (std::holds_alternative<HalfSpace>(shape)) {
      throw ModelError(
          "link " + quoted(visual.link) + " has a half-space as a visual; it has no end", "link",
          visual.link);
    }
    check_shape(shape, visual.link);
  }
  for (const double x : visual.rgba) {
    if (x >= 0 && x <= 1) continue;
    throw ModelError("link " + quoted(visual.link) + " has a visual of colour " +
                         std::to_string(x) + "; red, green, blue and opacity are in [0, 1]",
                     "link", visual.link);
  }
}

void Assembly::check_visuals() const {
  for (const Visual& visual : d_.visuals) {
    link_index(visual.link, "a visual is put on", "link", visual.link);
  }
}

const std::vector<Visual>& Model::visuals() const { return data_->description->visuals; }

}  // namespace saltus
