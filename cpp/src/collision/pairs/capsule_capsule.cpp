// Two capsules: the distance of their segments, less both radii.
//
// Lines x = p + s a and y = t b (b's frame, unit a and b, k = a x b): the common perpendicular has
//   s = (b x p).k/|k|^2,   t = b.x(s)
// If s and t are within the segments, n = k/|k|; else the nearest is an end of one, over the
// other's inside (n across it) or over its end. n comes from w = x - y only where no line tells it.
// Near parallel, s is uncertain by rounding/|k|, but t follows it: x - y stays across both.
#include "collision/pairs/capsule_capsule.hpp"

#include <algorithm>
#include <cmath>

#include "collision/shapes/point_distance.hpp"

namespace saltus {
namespace {

struct Segment {
  Vec3 p, t;  ///< middle and direction
  double h;   ///< half of its length
};

struct Nearest {
  Vec3 x, y, n;
  double d;
  bool along_a, along_b;  ///< may the witness slide along its segment
};

Vec3 across(const Vec3& v, const Vec3& t) { return v - t.dot(v) * t; }

/// Any direction across both lines, or across the one where they are parallel.
Vec3 across_both(const Segment& a, const Segment& b) {
  Vec3 n = a.t.cross(b.t);
  if (n.norm() < no_length) return a.t.unitOrthogonal();
  n = across(n.normalized(), a.t).normalized();
  return n;
}

/// Both witnesses inside; false where there is no such place.
bool crossing(const Segment& a, const Segment& b, Nearest& out) {
  const Vec3 k = a.t.cross(b.t);
  const double square = k.squaredNorm();
  if (square < 1e-30) return false;  // k is all rounding: parallel
  const double s = b.t.cross(a.p - b.p).dot(k) / square;
  out.x = a.p + s * a.t;
  const double t = b.t.dot(out.x - b.p);
  out.y = b.p + t * b.t;
  const Vec3 w = out.x - out.y;
  out.n = across_both(a, b);
  out.d = out.n.dot(w);
  if (out.d < 0) {
    out.d = -out.d;
    out.n = -out.n;
  }
  out.along_a = out.along_b = true;
  return std::abs(s) < a.h && std::abs(t) < b.h;
}

/// An end x of one segment over the other; n from the other to x.
Nearest end_over(const Vec3& x, const Segment& b, const Vec3& fallback) {
  Nearest out{.x = x, .y = b.p, .n = fallback, .d = 0, .along_a = false, .along_b = false};
  const double t = b.t.dot(x - b.p);
  out.along_b = std::abs(t) < b.h;
  out.y = b.p + std::clamp(t, -b.h, b.h) * b.t;
  Vec3 w = x - out.y;
  if (out.along_b) w = across(w, b.t);
  out.d = w.norm();
  if (out.d < no_length) return out;
  out.n = w / out.d;
  if (out.along_b) out.n = across(out.n, b.t).normalized();
  return out;
}

Nearest nearest(const Segment& a, const Segment& b) {
  Nearest best{};
  if (crossing(a, b, best)) return best;
  const Vec3 fallback = across_both(a, b);
  best = end_over(a.p + a.h * a.t, b, fallback);
  // not by less than rounding: the order stands where segments are parallel
  const double rounding = 4e-16 * (a.p.norm() + a.h + b.h);
  const auto better = [&](const Nearest& x) {
    const bool inner = (x.along_a || x.along_b) && !best.along_a && !best.along_b;
    return x.d < best.d - (inner ? -rounding : rounding);
  };
  const Nearest a_minus = end_over(a.p - a.h * a.t, b, fallback);
  if (better(a_minus)) best = a_minus;
  for (const double end : {b.h, -b.h}) {
    Nearest turned = end_over(b.p + end * b.t, a, -fallback);
    std::swap(turned.x, turned.y);
    std::swap(turned.along_a, turned.along_b);
    turned.n = -turned.n;
    if (better(turned)) best = turned;
  }
  return best;
}

Patch line(bool along, const Vec3& t) {
  return along ? Patch{.dim = 1, .t0 = t, .t1 = Vec3::Zero()} : Patch{};
}

}  // namespace

Gap gap_between(const Capsule& a, const Pose& X_WA, const Capsule& b, const Pose& X_WB) {
  // in the world's axes about b's middle: a's position is then of the size of the distance
  const Segment A{X_WA.p - X_WB.p, X_WA.R.col(2), a.half_length};
  const Segment B{Vec3::Zero(), X_WB.R.col(2), b.half_length};
  const Nearest g = nearest(A, B);
  return {.phi = g.d - a.radius - b.radius,
          .n_W = g.n,
          .p_WA = X_WB.p + (g.x - a.radius * g.n),
          .p_WB = X_WB.p + (g.y + b.radius * g.n),
          .center_W = X_WB.p + g.x,
          .d = g.d,
          .a = line(g.along_a, A.t),
          .b = line(g.along_b, B.t)};
}

}  // namespace saltus
