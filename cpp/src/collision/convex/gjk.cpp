// The direction between two cores that are apart.
//
// Reference: E. Gilbert, D. Johnson, S. Keerthi, A fast procedure for computing the distance
// between complex objects in three-dimensional space, IEEE J. Robotics and Automation 4 (1988).
//
// Over z in D = {x - y}: v is the point of a simplex in D nearest to the origin, z the point of D
// least along v; v.v - v.z bounds how far v is from the nearest. Of a simplex every part that holds
// the newest point is tried: there are few, and it is safe in any position.
#include "collision/convex/gjk.hpp"

#include <cmath>

namespace saltus {
namespace {

struct Simplex {
  Vec3 z[4];
  int count = 0;
};

struct Part {
  Vec3 v;
  double square = -1;  ///< below 0: none
  int mask = 0;
};

/// Nearest point of the affine hull, if strictly within the part.
bool nearest_of_segment(const Vec3& a, const Vec3& b, Vec3& v) {
  const Vec3 e = b - a;
  const double square = e.squaredNorm(), t = -a.dot(e);
  if (!(t > 0 && t < square)) return false;
  v = a + (t / square) * e;
  return true;
}

bool nearest_of_triangle(const Vec3& a, const Vec3& b, const Vec3& c, Vec3& v) {
  const Vec3 N = (b - a).cross(c - a);
  const double square = N.squaredNorm();
  if (!(square > 0)) return false;
  if (!(N.dot(b.cross(c)) > 0 && N.dot(c.cross(a)) > 0 && N.dot(a.cross(b)) > 0)) return false;
  v = (N.dot(a) / square) * N;
  return true;
}

bool holds_origin(const Simplex& s) {
  const Vec3 *a = &s.z[0], *b = &s.z[1], *c = &s.z[2], *d = &s.z[3];
  const auto volume = [](const Vec3& x, const Vec3& y, const Vec3& z) { return x.dot(y.cross(z)); };
  // the origin in place of each corner in turn: all of one sign if inside
  const double va = volume(*b, *c, *d), vb = -volume(*a, *c, *d), vc = volume(*a, *b, *d),
               vd = -volume(*a, *b, *c);
  return (va >= 0 && vb >= 0 && vc >= 0 && vd >= 0) || (va <= 0 && vb <= 0 && vc <= 0 && vd <= 0);
}

Part nearest_part(const Simplex& s) {
  Part best;
  const int newest = 1 << (s.count - 1);
  for (int mask = newest; mask < 2 * newest; ++mask) {
    const Vec3* x[4] = {};
    int count = 0;
    for (int k = 0; k < s.count; ++k) {
      if ((mask >> k & 1) == 1) x[count++] = &s.z[k];
    }
    Vec3 v = *x[0];
    if (count == 2 && !nearest_of_segment(*x[0], *x[1], v)) continue;
    if (count == 3 && !nearest_of_triangle(*x[0], *x[1], *x[2], v)) continue;
    if (count == 4) continue;
    const double square = v.squaredNorm();
    if (best.square < 0 || square < best.square) best = {v, square, mask};
  }
  return best;
}

void keep(int mask, Simplex& s) {
  int count = 0;
  for (int k = 0; k < s.count; ++k) {
    if ((mask >> k & 1) == 1) s.z[count++] = s.z[k];
  }
  s.count = count;
}

}  // namespace

std::optional<Vec3> direction_apart(const Solid& a, const Solid& b, double tolerance) {
  const double least = 1e-15 * (a.length + b.length);
  Simplex simplex;
  Vec3 v = a.p - b.p;
  if (v.norm() <= least) v = Vec3::UnitX();
  double square = -1;
  for (int k = 0; k < 128; ++k) {
    const Vec3 z = difference(a, b, v);
    if (square >= 0 && square - v.dot(z) <= tolerance * square) break;
    simplex.z[simplex.count++] = z;
    if (simplex.count == 4 && holds_origin(simplex)) return {};
    const Part part = nearest_part(simplex);
    if (square >= 0 && part.square >= square) break;  // rounding: no nearer
    v = part.v;
    square = part.square;
    if (square <= least * least) return {};
    keep(part.mask, simplex);
  }
  return v.normalized();
}

}  // namespace saltus
