// The elements that are shapes, as one table; the schema, the rewriting and the readers walk it.
#pragma once

#include <vector>

#include "saltus/collision/shapes.hpp"
#include "urdf/document.hpp"
#include "urdf/schema.hpp"

namespace saltus::reader {

/// [m] what a size of 0 below <geometry> is read as: a point, a plate.
constexpr double least_size = 1e-5;

struct ShapeElement {
  const char* name;
  std::vector<NumberRule> sizes;
  Shape (*read)(const XMLElement& element);
  bool in_geometry;  ///< as URDF's own, below <geometry>
  bool in_block;     ///< below <saltus>, with a link and an <origin>
};

const std::vector<ShapeElement>& shape_elements();

/// Null where no shape below <geometry>, or below <saltus>, has this name.
const ShapeElement* shape_in_geometry(const std::string& name);
const ShapeElement* shape_in_block(const std::string& name);

}  // namespace saltus::reader
