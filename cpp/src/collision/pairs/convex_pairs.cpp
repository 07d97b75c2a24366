// The pairs that the general scheme serves.
#include "collision/pairs/convex_pairs.hpp"

#include "collision/convex/convex_gap.hpp"

namespace saltus {
namespace {

/// About b's origin in the world's axes: a's position is then of the size of the distance.
template <class A, class B>
Gap placed(const A& a, const Pose& X_WA, const B& b, const Pose& X_WB) {
  return convex_gap(solid_of(a, X_WA.R, X_WA.p - X_WB.p), solid_of(b, X_WB.R, Vec3::Zero()),
                    X_WB.p);
}

}  // namespace

Gap gap_between(const Capsule& a, const Pose& X_WA, const Box& b, const Pose& X_WB) {
  return placed(a, X_WA, b, X_WB);
}
Gap gap_between(const Capsule& a, const Pose& X_WA, const Cylinder& b, const Pose& X_WB) {
  return placed(a, X_WA, b, X_WB);
}
Gap gap_between(const Capsule& a, const Pose& X_WA, const Ellipsoid& b, const Pose& X_WB) {
  return placed(a, X_WA, b, X_WB);
}
Gap gap_between(const Capsule& a, const Pose& X_WA, const Convex& b, const Pose& X_WB) {
  return placed(a, X_WA, b, X_WB);
}
Gap gap_between(const Box& a, const Pose& X_WA, const Box& b, const Pose& X_WB) {
  return placed(a, X_WA, b, X_WB);
}
Gap gap_between(const Box& a, const Pose& X_WA, const Cylinder& b, const Pose& X_WB) {
  return placed(a, X_WA, b, X_WB);
}
Gap gap_between(const Box& a, const Pose& X_WA, const Ellipsoid& b, const Pose& X_WB) {
  return placed(a, X_WA, b, X_WB);
}
Gap gap_between(const Box& a, const Pose& X_WA, const Convex& b, const Pose& X_WB) {
  return placed(a, X_WA, b, X_WB);
}
Gap gap_between(const Cylinder& a, const Pose& X_WA, const Cylinder& b, const Pose& X_WB) {
  return placed(a, X_WA, b, X_WB);
}
Gap gap_between(const Cylinder& a, const Pose& X_WA, const Ellipsoid& b, const Pose& X_WB) {
  return placed(a, X_WA, b, X_WB);
}
Gap gap_between(const Cylinder& a, const Pose& X_WA, const Convex& b, const Pose& X_WB) {
  return placed(a, X_WA, b, X_WB);
}
Gap gap_between(const Ellipsoid& a, const Pose& X_WA, const Ellipsoid& b, const Pose& X_WB) {
  return placed(a, X_WA, b, X_WB);
}
Gap gap_between(const Ellipsoid& a, const Pose& X_WA, const Convex& b, const Pose& X_WB) {
  return placed(a, X_WA, b, X_WB);
}
Gap gap_between(const Convex& a, const Pose& X_WA, const Convex& b, const Pose& X_WB) {
  return placed(a, X_WA, b, X_WB);
}

}  // namespace saltus
