// What shapes are made of, and what happens where two of these meet.
//
// Restitution and friction belong to pairs of materials, not to bodies: steel on steel rebounds,
// steel on clay does not. Of a pair holds the first of these that is said: the contact of its two
// materials, the properties of its floor, the default contact. A pair that nothing is said of is
// elastic and without friction, and a warning says so where a free body falls on a floor.
#pragma once

#include <string>
#include <vector>

#include "saltus/export.hpp"

namespace saltus {

/// What happens where two materials meet.
struct ContactProperties {
  double restitution = 1;  ///< e in [0, 1]: the rebound's part of the gap rate, u+ = -e u-
  double friction = 0;     ///< mu >= 0 (Coulomb): tangential by normal force, at most

  /// Equal to the bit.
  bool operator==(const ContactProperties&) const = default;
};

/// @throws ModelError where no contact can have these; `between` says whose they are.
SALTUS_EXPORT void check_properties(const ContactProperties& properties,
                                    const std::string& between);

/// The materials of all shapes, and what happens between them.
struct MaterialTable {
  /// (k) materials, the first that of shapes without one; floors with properties of their own have
  /// rows of their own, so that a name may be there twice.
  std::vector<std::string> names = {""};
  std::vector<int> of_shape;                  ///< (shapes) index in names
  std::vector<ContactProperties> contact{1};  ///< (k * k) row by row, symmetric

  /// Of two shapes.
  const ContactProperties& between(int shape_a, int shape_b) const {
    return contact[static_cast<std::size_t>(of_shape[shape_a]) * names.size() +
                   static_cast<std::size_t>(of_shape[shape_b])];
  }
};

}  // namespace saltus
