// Loops, couplings and prescribed motion in the block `<saltus>`.
#pragma once

#include "saltus/model/model_builder.hpp"
#include "urdf/document.hpp"

namespace saltus::reader {

/// `<loop>`, `<coupling>` and `<prescribed>`. @return false where the element is none of these.
bool add_loop_element(const Document& document, const XMLElement& element, ModelBuilder& builder);

}  // namespace saltus::reader
