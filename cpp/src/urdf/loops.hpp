// Loops and couplings in the block `<saltus>`.
#pragma once

#include "saltus/model/model_builder.hpp"
#include "urdf/document.hpp"

namespace saltus::reader {

/// `<loop>` and `<coupling>`. @return false where the element is none of these.
bool add_loop_element(const Document& document, const XMLElement& element, ModelBuilder& builder);

}  // namespace saltus::reader
