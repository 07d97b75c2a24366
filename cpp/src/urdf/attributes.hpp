// What an attribute or an `<origin>` holds, once the checks have passed.
#pragma once

#include "saltus/model/at.hpp"
#include "urdf/document.hpp"

namespace saltus::reader {

double number(const XMLElement& element, const char* name, double otherwise);
Vec3 vector(const XMLElement& element, const char* name, const Vec3& otherwise);

/// As many numbers as there are; the checks leave these alone.
/// @throws ModelError where one is none
std::vector<double> numbers(const Document& document, const XMLElement& element, const Owner& owner,
                            const char* name);

/// A frame on a link, by the names of the attributes that say where.
At end_on(const XMLElement& element, const char* link, const char* xyz, const char* rpy);

/// Of the `<origin>` below the element; none is the identity.
Pose origin(const XMLElement& element);

}  // namespace saltus::reader
