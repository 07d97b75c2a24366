#include "urdf/visuals.hpp"

#include <algorithm>
#include <cmath>

#include "urdf/attributes.hpp"
#include "urdf/mesh_path.hpp"
#include "urdf/numbers.hpp"
#include "urdf/shape_elements.hpp"

namespace saltus::reader {
namespace {

/// The attribute's numbers, `otherwise` where it is not there.
/// @throws ModelError where they are not as many, or not finite.
std::vector<double> numbers(const XMLElement& element, const char* name, std::size_t count,
                            std::vector<double> otherwise) {
  const char* text = element.Attribute(name);
  if (text == nullptr) return otherwise;
  Numbers found = parse_numbers(text);
  if (count >= 3 && found.values.size() > count) found.values.resize(count);  // as elsewhere
  const bool finite = std::all_of(found.values.begin(), found.values.end(),
                                  [](double x) { return std::isfinite(x); });
  if (found.bad.empty() && found.values.size() == count && finite) return found.values;
  throw ModelError("with " + std::string(name) + "=" + in_quotes(text) + ": " +
                   std::to_string(count) + (count == 1 ? " number is" : " numbers are") +
                   " needed");
}

/// attributes.hpp's, for what the schema has not checked.
Pose checked_origin(const XMLElement& visual) {
  const XMLElement* e = visual.FirstChildElement("origin");
  if (e == nullptr) return {};
  numbers(*e, "xyz", 3, {});
  numbers(*e, "rpy", 3, {});
  const std::vector<double> q = numbers(*e, "quat_xyzw", 4, {1, 0, 0, 0});
  if (std::all_of(q.begin(), q.end(), [](double x) { return x == 0; })) {
    throw ModelError("with zero quat_xyzw");
  }
  return origin(visual);
}

std::optional<Rgba> colour_of(const XMLElement* material) {
  const XMLElement* e = material == nullptr ? nullptr : material->FirstChildElement("color");
  const std::vector<double> x = parse_numbers(e == nullptr ? "" : attribute(*e, "rgba")).values;
  if (x.size() < 3 || x.size() > 4) return {};
  Rgba rgba = {0, 0, 0, 1};
  for (std::size_t i = 0; i < x.size(); ++i) rgba[i] = x[i] > 0 ? std::min(x[i], 1.0) : 0;
  return rgba;
}

const XMLElement& only_shape(const XMLElement& visual) {
  const XMLElement* geometry = visual.FirstChildElement("geometry");
  const XMLElement* shape = geometry == nullptr ? nullptr : geometry->FirstChildElement();
  if (shape == nullptr) throw ModelError("without a shape");
  return *shape;
}

Shape read_shape(const XMLElement& element) {
  const ShapeElement* known = shape_in_geometry(element.Name());
  if (known == nullptr) {
    throw ModelError("of an unknown shape, <" + std::string(element.Name()) + ">");
  }
  for (const NumberRule& size : known->sizes) {
    if (element.Attribute(size.name) == nullptr) {
      throw ModelError("without attribute " + in_quotes(size.name));
    }
    const std::vector<double> values = numbers(element, size.name, size.count, {});
    if (std::any_of(values.begin(), values.end(), [](double x) { return x <= 0; })) {
      throw ModelError("with " + std::string(size.name) + "=" +
                       in_quotes(attribute(element, size.name)) + ": a size must be positive");
    }
  }
  return known->read(element);
}

TriangleMesh scaled(const Triangles& triangles, const Vec3& scale) {
  Triangles out = triangles;
  for (Vec3& v : out.vertices) v = v.cwiseProduct(scale);
  if (scale.prod() < 0) {
    for (std::array<int, 3>& face : out.faces) std::swap(face[1], face[2]);
  }
  return {std::make_shared<const Triangles>(std::move(out))};
}

}  // namespace

void Visuals::add(ModelBuilder& builder) {
  find_materials();
  for (const XMLElement* link : document_.all("link")) {
    const std::string name = attribute(*link, "name");
    for (auto v = link->FirstChildElement("visual"); v; v = v->NextSiblingElement("visual")) {
      try {
        add(*v, name, builder);
      } catch (const ModelError& error) {
        leave_out(*v, name, error.what());
      }
    }
  }
  if (left_out_ > 1) first_ += "; so are " + std::to_string(left_out_ - 1) + " others";
  if (left_out_ > 0) builder.add_warning(first_);
}

void Visuals::add(const XMLElement& visual, const std::string& link, ModelBuilder& builder) {
  Visual out{link, Sphere{1}, checked_origin(visual), Visual::grey, attribute(visual, "name")};
  const std::optional<Rgba> rgba = colour(visual);
  const XMLElement& shape = only_shape(visual);
  if (shape.Name() == std::string("mesh")) return add_mesh(shape, out, rgba, builder);
  out.shape = read_shape(shape);
  out.rgba = rgba.value_or(Visual::grey);
  builder.add_visual(out);
}

void Visuals::add_mesh(const XMLElement& mesh, Visual visual, const std::optional<Rgba>& rgba,
                       ModelBuilder& builder) {
  const std::vector<double> s = numbers(mesh, "scale", 3, {1, 1, 1});
  const std::string uri = attribute(mesh, "filename");
  if (uri.empty()) throw ModelError("of a mesh without attribute \"filename\"");
  const MeshPath path = find_mesh(uri, folders_.urdf, folders_.packages);
  if (path.found.empty())
    throw ModelError("mesh, " + in_quotes(uri) + ", which is " + describe(path));
  try {
    const std::vector<MeshSurface>& surfaces = files_.surfaces(path.found);
    std::vector<TriangleMesh>& meshes =
        meshes_[{path.found.lexically_normal().string(), s[0], s[1], s[2]}];
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      if (i == meshes.size()) {
        meshes.push_back(scaled(surfaces[i].triangles, {s[0], s[1], s[2]}));
      }
      visual.shape = meshes[i];
      visual.rgba = rgba.value_or(surfaces[i].rgba.value_or(Visual::grey));
      builder.add_visual(visual);
    }
  } catch (const ModelError& error) {
    throw ModelError("mesh, " + in_quotes(uri) + ", which " + error.what() + " (" + describe(path) +
                     ")");
  }
}

/// Of its own, or of the material that it names.
std::optional<Rgba> Visuals::colour(const XMLElement& visual) const {
  const XMLElement* material = visual.FirstChildElement("material");
  if (material == nullptr) return {};
  if (const std::optional<Rgba> own = colour_of(material)) return own;
  const auto found = materials_.find(attribute(*material, "name"));
  return found == materials_.end() ? std::optional<Rgba>() : found->second;
}

/// Those of the robot first, then those of visuals, which URDF shares too.
void Visuals::find_materials() {
  const auto note = [&](const XMLElement* material) {
    if (const std::optional<Rgba> rgba = colour_of(material)) {
      materials_.emplace(attribute(*material, "name"), *rgba);
    }
  };
  for (const XMLElement* material : document_.all("material")) note(material);
  for (const XMLElement* link : document_.all("link")) {
    for (auto v = link->FirstChildElement("visual"); v; v = v->NextSiblingElement("visual")) {
      note(v->FirstChildElement("material"));
    }
  }
}

void Visuals::leave_out(const XMLElement& element, const std::string& link,
                        const std::string& what) {
  if (++left_out_ > 1) return;
  const Owner owner{"link", link};
  const bool is_mesh = what.rfind("mesh, ", 0) == 0;
  first_ = document_.at(element) + owner.show() + " has a visual " + what +
           (is_mesh ? "" : " (not used)");
}

}  // namespace saltus::reader
