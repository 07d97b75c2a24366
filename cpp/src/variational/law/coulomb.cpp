#include "variational/law/coulomb.hpp"

#include <algorithm>
#include <cmath>

namespace saltus {
namespace {

/// A = Q diag(a) Q^T; the identity where A is diagonal, so that planar motion stays planar.
struct Axes {
  Mat2 Q = Mat2::Identity();
  Vec2 a;
};

Axes axes_of(const Mat2& A) {
  Axes out;
  if (A(0, 1) != 0) {
    const double angle = std::atan2(2 * A(0, 1), A(0, 0) - A(1, 1)) / 2;
    const double c = std::cos(angle), s = std::sin(angle);
    out.Q << c, -s, s, c;
  }
  out.a = (out.Q.transpose() * A * out.Q).diagonal();
  // directions in which nothing gives way, but for rounding
  for (double& each : out.a) {
    if (!(each > 1e-12 * A.trace())) each = 0;
  }
  return out;
}

double over(double x, double a) { return a > 0 ? x / a : 0; }

/// The same in the axes of A.
Vec2 least_along_axes(const Vec2& a, const Vec2& c, double radius) {
  Vec2 b(-over(c[0], a[0]), -over(c[1], a[1]));
  if (b.norm() <= radius) return b;
  // |b(s)| = radius with b = -(A + s)^-1 c: Newton on 1/|b| is monotone from below the root
  const Vec2 active(a[0] > 0 ? c[0] : 0, a[1] > 0 ? c[1] : 0);
  double s = std::max(0.0, active.norm() / radius - a.maxCoeff());
  for (int k = 0; k < 60; ++k) {  // 3 to 6 are usual
    b = -Vec2(over(active[0], a[0] + s), over(active[1], a[1] + s));
    const double size = b.norm(), excess = (size - radius) / radius;
    if (excess <= 4e-16) break;
    const double slope = b[0] * over(b[0], a[0] + s) + b[1] * over(b[1], a[1] + s);
    s += size * size / slope * excess;
  }
  return b * (radius / b.norm());
}

/// Of the two tangents, given the normal impulse.
Vec2 tangential(const Mat3& W, const Axes& axes, const Vec3& u, double lambda, double radius) {
  if (!(radius > 0)) return Vec2::Zero();
  const Vec2 c = u.tail<2>() + lambda * W.block<2, 1>(1, 0);
  return axes.Q * least_along_axes(axes.a, axes.Q.transpose() * c, radius);
}

/// Sticks: u+ = 0 in all directions. @return lambda < 0 where it cannot
Vec3 stick(const Mat3& W, const Axes& axes, const Vec3& u) {
  const auto rest = [&](const Vec2& x) {
    const Vec2 y = axes.Q.transpose() * x;
    return Vec2(axes.Q * Vec2(over(y[0], axes.a[0]), over(y[1], axes.a[1])));
  };
  const Vec2 W_tn = W.block<2, 1>(1, 0), u_t = u.tail<2>();
  const double stiffness = W(0, 0) - W_tn.dot(rest(W_tn));
  if (!(stiffness > 1e-12 * W(0, 0))) return Vec3(-1, 0, 0);
  const double lambda = -(u[0] - W_tn.dot(rest(u_t))) / stiffness;
  const Vec2 beta = -rest(u_t + lambda * W_tn);
  return Vec3(lambda, beta[0], beta[1]);
}

/// Where W is singular, along n = (1, n_t) with W n = 0 inside of the cone: friction can be held
/// against any approach, p = (0, beta) + lambda n stops it for every lambda, and the least lambda
/// is taken whose p is in the cone. @return lambda < 0 where n is not inside
Vec3 jam(const Mat3& W, const Axes& axes, const Vec3& u, double friction) {
  const auto over_W = [&](const Vec2& x) {
    const Vec2 y = axes.Q.transpose() * x;
    return Vec2(axes.Q * Vec2(over(y[0], axes.a[0]), over(y[1], axes.a[1])));
  };
  const Vec2 beta = -over_W(u.tail<2>()), n_t = -over_W(W.block<2, 1>(1, 0));
  const double room = friction * friction - n_t.squaredNorm(), half = beta.dot(n_t);
  if (!(room > 1e-12 * friction * friction)) return Vec3(-1, 0, 0);
  const double lambda = (half + std::sqrt(half * half + room * beta.squaredNorm())) / room;
  const Vec2 held = beta + lambda * n_t;
  return Vec3(lambda, held[0], held[1]);
}

}  // namespace

Vec2 least_in_disc(const Mat2& A, const Vec2& c, double radius) {
  if (!(radius > 0)) return Vec2::Zero();
  const Axes axes = axes_of(A);
  return axes.Q * least_along_axes(axes.a, axes.Q.transpose() * c, radius);
}

Vec3 stop_contact(const Mat3& W, const Vec3& u, double friction) {
  if (!(u[0] < 0)) return Vec3::Zero();
  const Vec3 smooth(-u[0] / W(0, 0), 0, 0);
  if (!(friction > 0)) return smooth;
  const Axes axes = axes_of(W.bottomRightCorner<2, 2>());
  const Vec3 sticks = stick(W, axes, u);
  if (sticks[0] >= 0 && sticks.tail<2>().norm() <= friction * sticks[0]) return sticks;

  Vec3 p = smooth;
  const Vec2 W_tn = W.block<2, 1>(1, 0);
  const auto rate = [&](double lambda) {
    p[0] = lambda;
    p.tail<2>() = tangential(W, axes, u, lambda, friction * lambda);
    return u[0] + W(0, 0) * lambda + W_tn.dot(p.tail<2>());
  };
  const auto is_rounding = [&](double h) {
    return std::abs(h) <= 4e-16 * (W(0, 0) * p[0] + std::abs(W_tn.dot(p.tail<2>())));
  };
  double hi = smooth[0], h_hi = rate(hi);
  if (is_rounding(h_hi)) return p;
  double lo = 0, h_lo = u[0];
  for (int k = 0; h_hi < 0; ++k) {
    if (k == 60) {
      const Vec3 held = jam(W, axes, u, friction);
      return held[0] >= 0 ? held : smooth;  // not inside: u is not in the range of W
    }
    lo = hi, h_lo = h_hi;
    h_hi = rate(hi *= 2);
  }
  // regula falsi, halved (Illinois) where one end stays; as safe as bisection within a factor 2
  for (int k = 0, side = 0; k < 100; ++k) {
    const double next = k % 10 == 9 ? (lo + hi) / 2 : (lo * h_hi - hi * h_lo) / (h_hi - h_lo);
    const double h = rate(next);
    if (is_rounding(h) || hi - lo <= 2e-16 * hi) break;
    if (h < 0) {
      lo = next, h_lo = h;
      if (side == -1) h_hi /= 2;
      side = -1;
    } else {
      hi = next, h_hi = h;
      if (side == 1) h_lo /= 2;
      side = 1;
    }
  }
  return p;
}

Vec3 collide_contact(const Mat3& W, const Vec3& u, double friction, double restitution) {
  if (!(friction > 0)) return Vec3(-(1 + restitution) * u[0] / W(0, 0), 0, 0);
  Vec3 p = stop_contact(W, u, friction);
  if (!(restitution > 0)) return p;
  const double more = restitution * p[0];
  const Vec3 between = u + W * p;
  const Vec2 beta =
      tangential(W, axes_of(W.bottomRightCorner<2, 2>()), between, more, friction * more);
  return p + Vec3(more, beta[0], beta[1]);
}

}  // namespace saltus
