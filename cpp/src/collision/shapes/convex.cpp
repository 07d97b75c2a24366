#include <algorithm>
#include <cmath>
#include <limits>

#include "collision/shapes/facts.hpp"
#include "saltus/tree/tree.hpp"

namespace saltus {
namespace {

/// Integrals over a polytope, about a point inside it.
struct Moments {
  double volume = 0;           ///< of 1
  Vec3 first = Vec3::Zero();   ///< of x
  Mat3 second = Mat3::Zero();  ///< of x x'
};

/// By tetrahedra from the point to the triangles of the faces; all have positive volume, so that
/// nothing cancels.
Moments moments_about_center(const Hull& hull) {
  Moments sum;
  for (const Hull::Face& face : hull.faces) {
    const auto corner = [&](std::size_t i) {
      return Vec3(hull.vertices[face.corners[i]] - hull.center);
    };
    for (std::size_t i = 2; i < face.corners.size(); ++i) {
      const Vec3 a = corner(0), b = corner(i - 1), c = corner(i), s = a + b + c;
      const double V = a.dot(b.cross(c)) / 6;
      sum.volume += V;
      sum.first += V / 4 * s;
      sum.second +=
          V / 20 * (s * s.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
    }
  }
  return sum;
}

/// Calls visit(vertex) for each at the other end of an edge.
template <class Visit>
void for_each_neighbour(const Hull& hull, int vertex, const Visit& visit) {
  for (int i = hull.first_neighbour[vertex]; i < hull.first_neighbour[vertex + 1]; ++i) {
    visit(hull.neighbour[i]);
  }
}

bool is_over(const Vec3& c, const Hull& hull, const Hull::Face& face) {
  const std::size_t count = face.corners.size();
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3& from = hull.vertices[face.corners[k]];
    const Vec3& to = hull.vertices[face.corners[(k + 1) % count]];
    if ((to - from).cross(c - from).dot(face.normal) < 0) return false;
  }
  return true;
}

PointDistance distance_from_face(const Hull::Face& face, double e) {
  const Vec3 t = face.normal.unitOrthogonal();
  return {e, face.normal, {.dim = 2, .t0 = t, .t1 = face.normal.cross(t)}};
}

/// The nearest edge, or the vertex at its end.
PointDistance distance_from_edges(const Vec3& c, const Hull& hull, const Hull::Face& highest) {
  double least = -1;
  Vec3 v = Vec3::Zero(), t = Vec3::Zero();
  for (const Hull::Edge& edge : hull.edges) {
    const Vec3 &from = hull.vertices[edge.from], &to = hull.vertices[edge.to];
    const Vec3 e = to - from;
    const double along = e.dot(c - from), length = e.squaredNorm();
    const bool inner = along > 0 && along < length;
    Vec3 w = along > 0 ? c - to : c - from;
    if (inner) w = (c - from) - (along / length) * e;
    const double square = w.squaredNorm();
    if (least >= 0 && square >= least) continue;
    least = square;
    v = w;
    t = inner ? e : Vec3::Zero();
  }
  if (!t.isZero(0)) t.normalize();
  PointDistance out = distance_from_point(v, highest.normal);
  if (t.isZero(0) || out.d <= 0) return out;
  out.n = (out.n - t.dot(out.n) * t).normalized();  // v lost digits where it is short
  out.patch = {.dim = 1, .t0 = t, .t1 = Vec3::Zero()};
  return out;
}

}  // namespace

double ball_of(const Convex& s) {
  double square = 0;
  for (const Vec3& v : s.hull->vertices) square = std::fmax(square, v.squaredNorm());
  return std::sqrt(square);
}

/// The least distance from the middle to a face.
double size_of(const Convex& s) {
  double size = std::numeric_limits<double>::infinity();
  for (const Hull::Face& f : s.hull->faces) {
    size = std::fmin(size, f.offset - f.normal.dot(s.hull->center));
  }
  return size;
}

std::string flaw_of(const Convex& s) {
  if (s.hull == nullptr) return "without a hull; convex_hull(points) makes one";
  const std::string what = flaw_of_hull(*s.hull);
  return what.empty() ? "" : "with a bad hull: " + what + "; convex_hull(points) makes good ones";
}

Homogeneous homogeneous_of(const Convex& s, double mass) {
  const Moments sum = moments_about_center(*s.hull);
  const Vec3 off = sum.first / sum.volume;
  const Mat3 spread = mass * (sum.second / sum.volume - off * off.transpose());
  return {sum.volume, s.hull->center + off, spread.trace() * Mat3::Identity() - spread};
}

/// Any vertex tells the length: they are within a diameter of each other.
Core core_of(const Convex& s) {
  double length = 0;
  for (int k = 0; k < 4; ++k) length = std::fmax(length, s.hull->vertices[k].norm());
  return {.length = length};
}

Vec3 farthest_of(const Convex& s, const Vec3& d) {
  const std::vector<Vec3>& v = s.hull->vertices;
  std::size_t best = 0;
  for (std::size_t k = 1; k < v.size(); ++k) {
    if (v[k].dot(d) > v[best].dot(d)) best = k;
  }
  return v[best];
}

/// Climbs from neighbour to neighbour: a vertex without a farther neighbour is the farthest.
Vec3 farthest_near(const Convex& s, const Vec3& d, int& hint) {
  const std::vector<Vec3>& v = s.hull->vertices;
  double height = v[hint].dot(d);
  for (std::size_t step = 0; step < v.size(); ++step) {
    const int from = hint;
    for_each_neighbour(*s.hull, from, [&](int k) {
      const double here = v[k].dot(d);
      if (here <= height) return;
      hint = k;
      height = here;
    });
    if (hint == from) break;
  }
  return v[hint];
}

void nearby_of(const Convex& c, const Solid& s, const Vec3& d, double width, Nearby& out) {
  const Hull& hull = *c.hull;
  const double cosine = 1 - 0.5 * width * width;
  const Vec3 nearest = farthest_near(c, d, s.hint), from = s.p + s.R * nearest;
  out.add(vertex_at(from));
  for_each_neighbour(hull, s.hint, [&](int k) {
    const Vec3 &v = hull.vertices[k], e = v - nearest;
    if (std::abs(e.dot(d)) > width * e.norm()) return;
    out.add(edge_between(from, s.p + s.R * v));
    out.add(vertex_at(s.p + s.R * v));
  });
  for (const Hull::Face& face : hull.faces) {
    if (face.normal.dot(d) <= cosine) continue;
    out.add_face(s.R * face.normal);
    const std::size_t count = face.corners.size();
    for (std::size_t k = 0; k < count; ++k) {  // its edges away from that vertex
      const int i = face.corners[k], j = face.corners[(k + 1) % count];
      if (i == s.hint || j == s.hint) continue;
      const Vec3 x = s.p + s.R * hull.vertices[i];
      out.add(edge_between(x, s.p + s.R * hull.vertices[j]));
      if (count > 3) out.add(vertex_at(x));
    }
  }
}

void flat_of(const Convex& c, const Solid& s, const Vec3& d, double level, Flat& out) {
  out.hull = c.hull.get();
  for (const Hull::Face& face : c.hull->faces) {
    if ((face.normal - d).norm() > level) continue;
    out.face = &face;
    out.corners = static_cast<int>(face.corners.size());
    return;
  }
  const Vec3 nearest = farthest_near(c, d, s.hint);
  out.corners = 1;
  out.corner[0] = s.p + s.R * nearest;
  for_each_neighbour(*c.hull, s.hint, [&](int k) {
    const Vec3 &v = c.hull->vertices[k], e = v - nearest;
    if (std::abs(e.dot(d)) > level * e.norm()) return;
    out.corners = 2;
    out.corner[1] = s.p + s.R * v;
  });
}

PartCounts parts_of(const Convex& s) {
  const auto count = [](const auto& list) { return static_cast<int>(list.size()); };
  return {.corners = count(s.hull->vertices),
          .edges = count(s.hull->edges),
          .faces = count(s.hull->faces)};
}

PartOfShape corner_of(const Convex& s, int k) {
  const std::vector<Vec3>& v = s.hull->vertices;
  PartOfShape out = point(std::string("v").append(std::to_string(k)), 0, v[k]);
  for_each_neighbour(*s.hull, k,
                     [&](int other) { out.inward.push_back((v[other] - v[k]).normalized()); });
  return out;
}

PartOfShape edge_of(const Convex& s, int k) {
  const Hull& hull = *s.hull;
  const Hull::Edge& edge = hull.edges[k];
  const Vec3 &from = hull.vertices[edge.from], &to = hull.vertices[edge.to];
  const Vec3 out = between(hull.faces[edge.left].normal, hull.faces[edge.right].normal);
  const Pose X_GP{rotation_z_to((to - from).normalized()), (from + to) / 2};
  return {std::string("e").append(std::to_string(k)), Capsule{0, (to - from).norm() / 2}, X_GP,
          X_GP.R.transpose() * out};
}

SeenFace face_of(const Convex& s, const Vec3& c, int k) {
  const Hull::Face& f = s.hull->faces[k];
  return {f.normal.dot(c) - f.offset, f.normal};
}

/// e_f = n_f.c - offset_f is the height over face f.
///
///   no e_f > 0           inside: the face with the greatest e_f, d = e_f, F = 0
///   over one face        (within the planes across its edges): d = e_f, F = 0
///   else                 the nearest edge or vertex; distance from a line or a point
///
/// Over a face is decided for the highest faces only by trying: at most one holds. Of equally near
/// faces the first listed counts, also on the surface.
PointDistance distance_of(const Convex& s, const Vec3& c) {
  const Hull& hull = *s.hull;
  const Hull::Face* highest = nullptr;
  double height = 0;
  for (const Hull::Face& face : hull.faces) {
    const double e = face.normal.dot(c) - face.offset;
    if (e > 0 && is_over(c, hull, face)) return distance_from_face(face, e);
    if (highest != nullptr && e <= height) continue;
    highest = &face;
    height = e;
  }
  if (height <= 0) return distance_from_face(*highest, height);
  return distance_from_edges(c, hull, *highest);
}

/// Of equally low vertices the one listed first.
Lowest lowest_of(const Convex& s, const Vec3& m) {
  const std::vector<Vec3>& v = s.hull->vertices;
  std::size_t lowest = 0;
  double depth = v[0].dot(m);
  for (std::size_t k = 1; k < v.size(); ++k) {
    const double here = v[k].dot(m);
    if (here <= depth + level_sine * (std::abs(here) + std::abs(depth))) continue;
    lowest = k;
    depth = here;
  }
  return {v[lowest], {}};
}

}  // namespace saltus
