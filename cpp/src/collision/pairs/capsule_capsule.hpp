#pragma once

#include "saltus/collision/gap.hpp"

namespace saltus {

/// Of parallel segments that lie abreast, an end counts that has the other abreast of it: a's +
/// end, a's - end, b's + end, b's - end, the first. Segments that cut each other part along their
/// common normal, in line with each other across them.
Gap gap_between(const Capsule& a, const Pose& X_WA, const Capsule& b, const Pose& X_WB);

}  // namespace saltus
