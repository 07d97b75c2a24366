// urdfdom, with its messages.
#pragma once

#include <urdf_model/model.h>

#include <memory>
#include <string>

#include "urdf/document.hpp"

namespace saltus::reader {

/// What urdfdom makes of the rewritten document. Thread-safe.
/// @throws ModelError with urdfdom's own messages.
std::shared_ptr<urdf::ModelInterface> parse(const Document& document);

}  // namespace saltus::reader
