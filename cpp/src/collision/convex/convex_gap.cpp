// The gap of any two convex cores: the greatest separation
//
//   s(n) = min n.x - max n.y     over unit n, x in A, y in B
//
// A first n (gjk.cpp apart, epa.cpp overlapping) tells which features may face each other. Each two
// of them give an exact n: a face its normal, any others the place where they meet (meeting.cpp).
// Such a meeting is a stationary value of s if its witnesses lie within their features and the
// whole cores are not closer along n: s(n) = d. Apart, that is the greatest separation of all;
// overlapping, it is if it is not below that of the first n, which is searched for globally.
#include "collision/convex/convex_gap.hpp"

#include <cmath>

#include "collision/convex/gjk.hpp"
#include "collision/convex/meeting.hpp"

namespace saltus {
namespace {

struct Search {
  const Solid &A, &B;
  double rounding;  ///< [m]
  Meeting best;
  double least = 1e300;  ///< of s where bodies overlap: that of an n found among all
  bool found = false;    ///< best is the gap, or near the least way out
  bool done = false;     ///< nothing can be better

  void offer(Meeting x) {
    x.past = std::fmax(x.past, x.d - x.s);
    const bool sound = x.past <= rounding;
    const bool greatest = x.d > 0 || x.s >= least - rounding;
    // of equal separations the witnesses tell, which move by the root of what n moves s
    const bool better = x.s > best.s + rounding || (x.s > best.s - rounding && x.past < best.past);
    if (!better && (found || !sound || !greatest)) return;
    best = x;
    found = sound && greatest;
    done = found && x.d > 0;
  }
};

Meeting along(const Solid& A, const Solid& B, const Vec3& n) {
  Meeting out{.n = n, .a = vertex_at(support(A, -n)), .b = vertex_at(support(B, n))};
  out.s = out.d = n.dot(out.a.x - out.b.x);
  return out;
}

void offer_face(const Vec3& n, bool of_a, Search& search) {
  Meeting x = along(search.A, search.B, n);
  x.past = 1e300;  // the corner that is farthest need not be over the face: lay_flat finds one
  lay_flat(search.A, search.B, of_a, search.rounding, x);
  search.offer(x);
}

void offer_all(const Nearby& a, const Nearby& b, const Vec3& n, double turn, Search& search) {
  for (int k = 0; k < b.faces && !search.done; ++k) offer_face(b.normals[k], false, search);
  for (int k = 0; k < a.faces && !search.done; ++k) offer_face(-a.normals[k], true, search);
  for (int i = 0; i < a.count; ++i) {
    for (int j = 0; j < b.count && !search.done; ++j) {
      Meeting x{.n = n, .a = a.features[i], .b = b.features[j]};
      if (!meet(search.A, search.B, x.a, x.b, x.n, turn)) continue;
      const Vec3 w = x.a.x - x.b.x;
      x.s = x.n.dot(difference(search.A, search.B, x.n));
      x.d = x.n.dot(w);
      x.past = std::fmax(std::fmax(beyond(x.a), beyond(x.b)), (w - x.d * x.n).norm());
      search.offer(x);
    }
  }
}

/// @param turn [rad] of `first`, within which the gap's n is expected, and sought before anywhere
void search_from(const Vec3& first, double turn, Search& search) {
  Meeting start = along(search.A, search.B, first);
  start.past = (start.a.x - start.b.x - start.d * start.n).norm();
  if (search.best.n.isZero(0) || start.s > search.best.s) search.best = start;
  Nearby a, b;
  const bool curved = search.A.curved || search.B.curved;
  double width = curved ? 0.02 : 1e-3;
  for (int round = 0; round < 5 && !search.found; ++round) {
    const Vec3 n = search.best.n;
    find_nearby(search.A, -n, width, a);
    find_nearby(search.B, n, width, b);
    offer_all(a, b, n, round == 0 ? turn : any_turn, search);
    width = std::fmin(1, 30 * width);  // corner over corner: n is anywhere in a cone
  }
}

}  // namespace

Gap convex_gap(const Solid& a, const Solid& b, const Vec3& origin) {
  Search search{a, b, 2e-15 * (a.length + b.length + (a.p - b.p).norm()), {}};
  search.best.n = Vec3::Zero();
  // polytopes are reached; curved ones only approached, and Newton goes on from there if it can
  const bool curved = a.curved || b.curved;
  for (const double tolerance : {1e-3, 1e-7, 1e-14}) {
    if (search.found) break;
    if (!curved && tolerance > 1e-14) continue;
    const auto apart = direction_apart(a, b, tolerance);
    if (!apart) break;
    // n is nearer than the root of the tolerance, by what GJK ends at; Newton's steps may stray
    search_from(*apart, curved ? 4 * std::sqrt(tolerance) : any_turn, search);
  }
  if (!search.found) {
    const Vec3 n = direction_through(a, b);
    search.least = n.dot(difference(a, b, n));
    constexpr double near = 0.3;  // n is good to the root of 1e-6
    search_from(n, near, search);
  }
  const Meeting& x = search.best;
  return {.phi = x.d - a.radius - b.radius,
          .n_W = x.n,
          .p_WA = origin + (x.a.x - a.radius * x.n),
          .p_WB = origin + (x.b.x + b.radius * x.n),
          .center_W = origin + x.a.x,
          .d = x.d,
          .a = patch_of(a, x.a, x.n),
          .b = patch_of(b, x.b, x.n)};
}

}  // namespace saltus
