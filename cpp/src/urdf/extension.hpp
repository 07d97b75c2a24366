// The `<saltus>` block, see load_urdf.hpp.
#pragma once

#include "saltus/model/model_builder.hpp"
#include "urdf/document.hpp"

namespace saltus::reader {

/// Adds what the block says; needs the checks, and the links added before.
void add_extension(const Document& document, ModelBuilder& builder);

}  // namespace saltus::reader
