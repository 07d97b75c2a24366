#include "urdf/shape_elements.hpp"

#include "urdf/attributes.hpp"

namespace saltus::reader {
namespace {

constexpr NumberRule radius = {"radius", 1, true, true}, length = {"length", 1, true, true};

double size(const XMLElement& e, const char* name) {
  const double given = number(e, name, 0);
  return given == 0 ? least_size : given;
}

/// `length` is from end to end, of a capsule without its caps.
template <class Round>
Shape round(const XMLElement& e) {
  return Round{size(e, "radius"), 0.5 * size(e, "length")};
}

const ShapeElement* find(const std::string& name, bool ShapeElement::* is_there) {
  for (const ShapeElement& each : shape_elements()) {
    if (each.*is_there && each.name == name) return &each;
  }
  return nullptr;
}

}  // namespace

const std::vector<ShapeElement>& shape_elements() {
  static const std::vector<ShapeElement> all = {
      {.name = "sphere",
       .sizes = {radius},
       .read = [](const XMLElement& e) -> Shape { return Sphere{size(e, "radius")}; },
       .in_geometry = true,
       .in_block = false},
      {.name = "box",
       .sizes = {{"size", 3, true, true}},
       .read = [](const XMLElement& e) -> Shape {
         const Vec3 given = vector(e, "size", Vec3::Zero());
         return Box{0.5 * (given.array() == 0).select(Vec3::Constant(least_size), given)};
       },
       .in_geometry = true,
       .in_block = false},
      {.name = "cylinder",
       .sizes = {radius, length},
       .read = round<Cylinder>,
       .in_geometry = true,
       .in_block = false},
      {.name = "capsule",
       .sizes = {radius, length},
       .read = round<Capsule>,
       .in_geometry = true,
       .in_block = true},
      {.name = "ellipsoid",
       .sizes = {{"radii", 3, true, true}},
       .read = [](const XMLElement& e) -> Shape {
         return Ellipsoid{vector(e, "radii", Vec3::Zero())};
       },
       .in_geometry = false,
       .in_block = true}};
  return all;
}

const ShapeElement* shape_in_geometry(const std::string& name) {
  return find(name, &ShapeElement::in_geometry);
}

const ShapeElement* shape_in_block(const std::string& name) {
  return find(name, &ShapeElement::in_block);
}

}  // namespace saltus::reader
