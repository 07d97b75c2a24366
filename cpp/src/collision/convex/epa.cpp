// The direction in which two overlapping cores come apart by the least way.
//
// Reference: G. van den Bergen, Proximity queries and penetration depth computation on 3D game
// objects, GDC (2001): expanding polytope. In D = {x - y} the least distance from the origin to the
// boundary: a polytope within D, its face nearest to the origin is pushed out to D's boundary until
// the two meet. Offsets are signed here and the origin may just as well be outside.
//
// The start is any tetrahedron in D. Whatever rounding does to the polytope, the answer is the best
// of directions whose supports were seen.
#include <cmath>

#include "collision/convex/gjk.hpp"

namespace saltus {
namespace {

constexpr int most_corners = 100, most_faces = 4 * most_corners;

struct Face {
  int corner[3];
  Vec3 n;         ///< outward
  double offset;  ///< n.z on it; below 0 where the origin is outside
};

struct Polytope {
  Vec3 z[most_corners];
  Face face[most_faces];
  int corners = 0, faces = 0;
  Vec3 inside;  ///< tells outward

  void add_face(int i, int j, int k) {
    if (faces == most_faces) return;
    const Vec3 N = (z[j] - z[i]).cross(z[k] - z[i]);
    const double norm = N.norm();
    if (!(norm > 0)) return;
    Face f{{i, j, k}, N / norm, 0};
    if (f.n.dot(z[i] - inside) < 0) f = {{i, k, j}, -f.n, 0};
    f.offset = f.n.dot(z[i]);
    face[faces++] = f;
  }
};

/// Farthest from what is there: a line, then a triangle, then a tetrahedron.
bool start(const Solid& a, const Solid& b, Polytope& P) {
  const auto along = [&](const Vec3& m) { return difference(a, b, -m); };
  P.z[0] = along(Vec3::UnitX());
  P.z[1] = along(-Vec3::UnitX());
  const Vec3 line = (P.z[1] - P.z[0]).normalized();
  const Vec3 u = line.unitOrthogonal(), v = line.cross(u);
  double far = 0;
  for (const Vec3& m : {u, Vec3(-u), v, Vec3(-v)}) {
    const Vec3 z = along(m);
    const double off = line.cross(z - P.z[0]).norm();
    if (off <= far) continue;
    far = off;
    P.z[2] = z;
  }
  const Vec3 n = (P.z[1] - P.z[0]).cross(P.z[2] - P.z[0]).normalized();
  const Vec3 up = along(n), down = along(-n);
  P.z[3] = n.dot(up - P.z[0]) > n.dot(P.z[0] - down) ? up : down;
  P.corners = 4;
  P.inside = 0.25 * (P.z[0] + P.z[1] + P.z[2] + P.z[3]);
  P.add_face(0, 1, 2);
  P.add_face(0, 1, 3);
  P.add_face(0, 2, 3);
  P.add_face(1, 2, 3);
  return P.faces == 4;
}

/// Replaces the faces that see the newest corner by those from their common rim to it.
void expand(Polytope& P, double rounding) {
  const int newest = P.corners - 1;
  const Vec3 z = P.z[newest];
  int rim[3 * most_faces][2], edges = 0, kept = 0;
  for (int k = 0; k < P.faces; ++k) {
    const Face f = P.face[k];
    if (f.n.dot(z) <= f.offset + rounding) {
      P.face[kept++] = f;
      continue;
    }
    for (int i = 0; i < 3; ++i) {
      const int from = f.corner[i], to = f.corner[(i + 1) % 3];
      int twin = 0;
      while (twin < edges && (rim[twin][0] != to || rim[twin][1] != from)) ++twin;
      if (twin < edges) {
        --edges;
        rim[twin][0] = rim[edges][0];
        rim[twin][1] = rim[edges][1];
        continue;
      }
      rim[edges][0] = from;
      rim[edges++][1] = to;
    }
  }
  P.faces = kept;
  for (int e = 0; e < edges; ++e) P.add_face(rim[e][0], rim[e][1], newest);
}

}  // namespace

Vec3 direction_through(const Solid& a, const Solid& b) {
  Polytope P;
  if (!start(a, b, P)) return Vec3::UnitZ();
  const double length = a.length + b.length;
  // polytopes are met exactly; Newton goes on with curved ones
  const double tolerance = (a.curved || b.curved ? 1e-6 : 2e-15) * length;
  Vec3 best_n = Vec3::UnitZ();
  double best = 1e300;
  while (P.corners < most_corners && P.faces > 0) {
    int nearest = 0;
    for (int k = 1; k < P.faces; ++k) {
      if (P.face[k].offset < P.face[nearest].offset) nearest = k;
    }
    const Vec3 n = P.face[nearest].n;
    const Vec3 z = difference(a, b, -n);
    const double height = n.dot(z);
    if (height < best) {
      best = height;
      best_n = n;
    }
    if (best - P.face[nearest].offset <= tolerance) break;
    P.z[P.corners++] = z;
    expand(P, 1e-15 * length);
  }
  return -best_n;
}

}  // namespace saltus
