#pragma once

#include "saltus/collision/gap.hpp"

namespace saltus {

// All by convex_gap.cpp. Where a face lies on a face or an edge, the witness is the corner of what
// they share that is farthest from both bodies' origins; of parallel edges, sides or segments, an
// end.
Gap gap_between(const Capsule& a, const Pose& X_WA, const Box& b, const Pose& X_WB);
Gap gap_between(const Capsule& a, const Pose& X_WA, const Cylinder& b, const Pose& X_WB);
Gap gap_between(const Capsule& a, const Pose& X_WA, const Ellipsoid& b, const Pose& X_WB);
Gap gap_between(const Capsule& a, const Pose& X_WA, const Convex& b, const Pose& X_WB);
Gap gap_between(const Box& a, const Pose& X_WA, const Box& b, const Pose& X_WB);
Gap gap_between(const Box& a, const Pose& X_WA, const Cylinder& b, const Pose& X_WB);
Gap gap_between(const Box& a, const Pose& X_WA, const Ellipsoid& b, const Pose& X_WB);
Gap gap_between(const Box& a, const Pose& X_WA, const Convex& b, const Pose& X_WB);
Gap gap_between(const Cylinder& a, const Pose& X_WA, const Cylinder& b, const Pose& X_WB);
Gap gap_between(const Cylinder& a, const Pose& X_WA, const Ellipsoid& b, const Pose& X_WB);
Gap gap_between(const Cylinder& a, const Pose& X_WA, const Convex& b, const Pose& X_WB);
Gap gap_between(const Ellipsoid& a, const Pose& X_WA, const Ellipsoid& b, const Pose& X_WB);
Gap gap_between(const Ellipsoid& a, const Pose& X_WA, const Convex& b, const Pose& X_WB);
Gap gap_between(const Convex& a, const Pose& X_WA, const Convex& b, const Pose& X_WB);

}  // namespace saltus
