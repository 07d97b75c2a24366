// Which links never collide, and states by name, from SRDF.
#pragma once

#include <string>

#include "saltus/model/model_builder.hpp"
#include "urdf/document.hpp"

namespace saltus::reader {

/// `<disable_collisions link1 link2>`, `<disable_default_collisions link>` and its exceptions,
/// `<enable_collisions link1 link2>`, as exclusions of bodies; `<group_state>` as states. No other
/// element is looked at. Links and joints that the robot has not are named in warnings: files for
/// one robot of a family are used with the others.
/// @throws ModelError with file and line on what is no SRDF, and on what is wrong if `strict`.
void add_srdf(const std::string& path_or_text, const Document& urdf, bool strict,
              ModelBuilder& builder);

/// `<group_state name group>` as states of the builder, whose joints are there already. Names that
/// several groups have become "group/name". Numbers outside of limits are put onto them, with a
/// warning.
/// @throws ModelError on what is no number, and on what is wrong if `strict`.
void add_group_states(const Document& srdf, bool strict, ModelBuilder& builder);

/// An attribute that must be there. @throws ModelError where it is not, or was left to xacro.
std::string given(const Document& document, const XMLElement& element, const char* name);

}  // namespace saltus::reader
