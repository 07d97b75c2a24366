// Which links never collide, from SRDF.
#pragma once

#include <string>

#include "saltus/model/model_builder.hpp"
#include "urdf/document.hpp"

namespace saltus::reader {

/// `<disable_collisions link1 link2>`, `<disable_default_collisions link>` and its exceptions,
/// `<enable_collisions link1 link2>`, as exclusions of bodies; no other element is looked at. Links
/// that the robot has not are named in one warning: files for one robot of a family are used with
/// the others.
/// @throws ModelError with file and line on what is no SRDF, and on what is wrong if `strict`.
void add_srdf(const std::string& path_or_text, const Document& urdf, bool strict,
              ModelBuilder& builder);

}  // namespace saltus::reader
