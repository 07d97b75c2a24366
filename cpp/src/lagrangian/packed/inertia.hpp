// The inertia of one body in the world.
#pragma once

#include "lagrangian/packed/lane.hpp"

namespace saltus::packed {

/// R I R^T, I symmetric.
SALTUS_INLINE S3 rotate(const M3& R, const S3& I) {
  // columns of R I, then its rows against those of R
  const V3 x = I.xx * R.x + I.xy * R.y + I.xz * R.z;
  const V3 y = I.xy * R.x + I.yy * R.y + I.yz * R.z;
  const V3 z = I.xz * R.x + I.yz * R.y + I.zz * R.z;
  return {x.x * R.x.x + y.x * R.y.x + z.x * R.z.x, x.x * R.x.y + y.x * R.y.y + z.x * R.z.y,
          x.x * R.x.z + y.x * R.y.z + z.x * R.z.z, x.y * R.x.y + y.y * R.y.y + z.y * R.z.y,
          x.y * R.x.z + y.y * R.y.z + z.y * R.z.z, x.z * R.x.z + y.z * R.y.z + z.z * R.z.z};
}

/// About O: mass, first moment and rotational inertia.
struct BodyInWorld {
  double m;
  V3 h;
  S3 I;

  SALTUS_INLINE V6 operator*(V6 twist) const { return momentum(m, h, I, twist); }
};

/// From the constants of the body and the pose of its joint, all of one lane.
SALTUS_INLINE BodyInWorld inertia_in_world(const double* body, const double* R, const double* p) {
  const M3 frame = load9(R, 0);
  const double m = body[0];
  const V3 c = load3(p, 0) + frame * load3(body, 1), h = m * c;
  const S3 I = rotate(frame, load_symmetric(body, 4));
  const double hx = h.x * c.x, hy = h.y * c.y, hz = h.z * c.z;
  return {m, h,
          S3{I.xx + hy + hz, I.xy - h.x * c.y, I.xz - h.x * c.z, I.yy + hx + hz, I.yz - h.y * c.z,
             I.zz + hx + hy}};
}

}  // namespace saltus::packed
