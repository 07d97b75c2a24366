// How a contact moves with the bodies: its normal and its witnesses.
#pragma once

#include "saltus/collision/gap.hpp"

namespace saltus {

/// How the normal and the witnesses move in the world where a moves by t = [w; u] and b does not:
/// n' = n t, p_WA' = p_WA t, p_WB' = p_WB t.
struct GapMotion {
  Eigen::Matrix<double, 3, 6> n, p_WA, p_WB;
};
SALTUS_EXPORT GapMotion gap_motion(const Gap& gap);

}  // namespace saltus
