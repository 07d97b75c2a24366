// A face on a face, an edge or a point: the corners of what they share, seen along n.
//
// Those are corners of one within the other, and crossings of their outlines. Each is a pair of
// features that do not share a straight direction, which M of curvature.cpp needs. A disc has its
// circle as outline.
#include <algorithm>
#include <cmath>

#include "collision/convex/meeting.hpp"
#include "collision/shapes/point_distance.hpp"

namespace saltus {
namespace {

/// [m] how far x is out of the flat, seen along n; not above 0 within.
double outside(const Flat& f, const Vec3& x, const Vec3& n) {
  const auto seen = [&](const Vec3& v) { return Vec3(v - n.dot(v) * n); };
  if (f.is_disc()) return seen(x - f.center).norm() - f.radius;
  if (f.corners == 1) return seen(x - f.at(0)).norm();
  double out = -1e300;
  for (int k = 0; k < f.corners; ++k) {
    const Vec3 from = f.at(k), to = f.at((k + 1) % f.corners), e = (to - from).normalized();
    if (f.corners == 2) {
      const double along = e.dot(x - from);
      const double off = (seen(x - from) - along * e).norm();
      return std::max({off, -along, along - (to - from).norm()});
    }
    Vec3 away = e.cross(n);
    if (away.dot(f.at((k + 2) % f.corners) - from) > 0) away = -away;
    out = std::max(out, away.dot(x - from));
  }
  return out;
}

/// The shared corners, and of them the one to keep.
struct Shared {
  const Solid &A, &B;
  double tolerance;
  Meeting& best;
  double score = -1;
  bool within = false;

  void offer(const Feature& a, const Feature& b, double past) {
    const Vec3 x = 0.5 * (a.x + b.x);
    const double far = (x - A.p).norm() + (x - B.p).norm();
    const bool fits = past <= tolerance;
    const bool better = fits ? !within || far > score * (1 + 1e-9) : !within && past < best.past;
    if (!better) return;
    within = within || fits;
    score = far;
    best.a = a;
    best.b = b;
    best.past = past;
  }
};

/// Corners of f on g, at distance `d` along n from f to g. `turned`: f is b's.
void offer_corners(const Flat& f, const Flat& g, const Vec3& n, bool turned, Shared& shared) {
  const double d = n.dot((g.is_disc() ? g.center : g.at(0)) - f.at(0));
  for (int k = 0; k < f.corners; ++k) {
    const Vec3 x = f.at(k), y = x + d * n;
    const Feature at_f = corner_feature(f, x, n), at_g = flat_feature(g, y, n);
    const double past = outside(g, y, n);
    turned ? shared.offer(at_g, at_f, past) : shared.offer(at_f, at_g, past);
  }
}

/// Edges of f, outlines of g.
void offer_crossings(const Flat& f, const Flat& g, const Vec3& n, bool turned, Shared& shared) {
  const auto offer = [&](const Feature& at_f, const Feature& at_g, double past) {
    turned ? shared.offer(at_g, at_f, past) : shared.offer(at_f, at_g, past);
  };
  for (int i = 0; i < f.corners; ++i) {
    const Vec3 from = f.at(i), to = f.at((i + 1) % f.corners);
    const double long_f = (to - from).norm();
    const Vec3 e = (to - from) / long_f;
    if (f.corners < 2 || (f.corners == 2 && i == 1)) return;
    if (g.is_disc()) {  // |from + s e - center| = radius
      const Vec3 c = from - g.center;
      const Vec3 off = c - n.dot(c) * n - e.dot(c) * e;
      const double square = g.radius * g.radius - off.squaredNorm();
      for (const double sign : {-1.0, 1.0}) {
        const double s = -e.dot(c) + sign * std::sqrt(std::max(square, 0.0));
        const Vec3 x = from + s * e, y = x - n.dot(c) * n;
        const double past = std::max({-s, s - long_f, square > 0 ? 0.0 : g.radius});
        if (past > shared.tolerance) continue;
        offer(outline_feature(f, from, to, x), rim_at(*g.solid, y), past);
      }
      continue;
    }
    for (int j = 0; j < g.corners; ++j) {
      if (g.corners < 2 || (g.corners == 2 && j == 1)) break;
      const Vec3 at = g.at(j), end = g.at((j + 1) % g.corners);
      const double long_g = (end - at).norm();
      const Vec3 k = (end - at) / long_g;
      const double sine = e.cross(k).dot(n);
      if (std::abs(sine) < 1e-6) continue;  // their corners serve
      const double s = (at - from).cross(k).dot(n) / sine;
      const double t = (at - from).cross(e).dot(n) / sine;
      const double past = std::max({-s, s - long_f, -t, t - long_g});
      if (past > shared.tolerance) continue;
      const Vec3 x = from + s * e, y = at + t * k;
      offer(outline_feature(f, from, to, x), outline_feature(g, at, end, y), past);
    }
  }
}

void offer_circles(const Flat& f, const Flat& g, const Vec3& n, Shared& shared) {
  const Vec3 apart = g.center - f.center, line = apart - n.dot(apart) * n;
  const double c = line.norm();
  if (c < no_length) return;
  const double along = (c * c + f.radius * f.radius - g.radius * g.radius) / (2 * c);
  const double square = f.radius * f.radius - along * along;
  if (!(square > 0)) return;
  const Vec3 u = line / c, v = n.cross(u);
  for (const double sign : {1.0, -1.0}) {
    const Vec3 x = f.center + along * u + sign * std::sqrt(square) * v;
    shared.offer(rim_at(*f.solid, x), rim_at(*g.solid, x + n.dot(apart) * n), 0);
  }
}

}  // namespace

void lay_flat(const Solid& A, const Solid& B, bool of_a, double tolerance, Meeting& out) {
  // the one whose normal n is knows its face by it; what tilts the other by more than rounding is
  // no flat
  constexpr double own = 1e-12, other = 3e-15;
  const Flat f = flat_along(A, -out.n, of_a ? own : other);
  const Flat g = flat_along(B, out.n, of_a ? other : own);
  const bool extended = f.corners > 1 && g.corners > 1;
  if (!extended && out.past <= tolerance) return;
  Meeting flat = out;
  flat.past = 1e300;
  Shared shared{A, B, tolerance, flat};
  offer_corners(f, g, out.n, false, shared);
  offer_corners(g, f, out.n, true, shared);
  if (f.is_disc() && g.is_disc()) offer_circles(f, g, out.n, shared);
  if (!f.is_disc()) offer_crossings(f, g, out.n, false, shared);
  if (f.is_disc() && !g.is_disc()) offer_crossings(g, f, out.n, true, shared);
  if (flat.past > tolerance && flat.past >= out.past) return;
  flat.d = flat.n.dot(flat.a.x - flat.b.x);
  out = flat;
}

}  // namespace saltus
