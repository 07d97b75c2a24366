// Where something is attached to a link.
#pragma once

#include <string>

#include "saltus/spatial/spatial.hpp"

namespace saltus {

/// A frame on a link: what acts at a point there is attached to its origin.
struct At {
  std::string link;  ///< by name
  Pose X_LA = {};    ///< in the link's frame
};

/// A frame there that is turned as the link is; p_L [m] in the link's frame.
inline At point_on(const std::string& link, const Vec3& p_L) {
  return {link, {Mat3::Identity(), p_L}};
}

}  // namespace saltus
