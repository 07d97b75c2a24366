#include "saltus/collision/slip.hpp"

#include <cmath>

namespace saltus {

int tangent_axis(const Vec3& n_W) {
  constexpr double equal = 1e-6;  // rounding of a normal along an axis must not turn its tangents
  int axis = 1;                   // y: scenes in the plane are most often in x and z
  for (const int k : {2, 0}) {
    if (std::abs(n_W[k]) < std::abs(n_W[axis]) - equal) axis = k;
  }
  return axis;
}

Tangents tangents(const Vec3& n_W, int axis) {
  const Vec3 e = Vec3::Unit(axis);
  const Vec3 t1 = (e - n_W[axis] * n_W).normalized();
  return {t1.cross(n_W), t1};
}

void add_motion_gradient(const Tree& tree, const Kinematics& kin, const Pair& pair, const Vec3& P_W,
                         const Vec3& d_W, Eigen::Ref<VecX> row) {
  for (const ChainJoint& k : pair.chain) {
    const Drive& drive = tree.drive[k.joint];
    const Vec6& S = kin.joint[k.joint].S;
    const Vec3 P = P_W - kin.origin[tree.root[k.joint]];
    const Vec3 velocity = k.sign * (angular(S).cross(P) + linear(S));
    row[drive.velocity] += drive.multiplier * d_W.dot(velocity);
  }
}

}  // namespace saltus
