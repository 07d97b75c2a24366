// What shapes are made of, and what happens where two of these meet.
//
// Restitution and friction belong to pairs of materials, not to bodies: steel on steel rebounds,
// steel on clay does not. A pair that nothing is said of has the default, an elastic contact
// without friction unless that is set too.
#pragma once

#include <string>
#include <vector>

namespace saltus {

struct ContactProperties {
  double restitution = 1;  ///< e in [0, 1]: the rebound's part of the gap rate, u+ = -e u-
  double friction = 0;     ///< mu >= 0 (Coulomb): tangential by normal force, at most

  bool operator==(const ContactProperties&) const = default;
};

struct MaterialTable {
  std::vector<std::string> names = {""};      ///< (k) the first is that of shapes without one
  std::vector<int> of_shape;                  ///< (shapes) index in names
  std::vector<ContactProperties> contact{1};  ///< (k * k) row by row, symmetric

  const ContactProperties& between(int shape_a, int shape_b) const {
    return contact[static_cast<std::size_t>(of_shape[shape_a]) * names.size() +
                   static_cast<std::size_t>(of_shape[shape_b])];
  }
};

}  // namespace saltus
