// Dispatch: the one place that knows which pairs have a gap.
//
// A pair with a closed form is an overload of gap_between: of a sphere and of a half-space with
// what a shape tells of itself (facts.hpp), of two others in its own file. That file's header must
// be included here, above the templates: an overload declared after them would be silently
// invisible. Any other two cores are served by convex_gap.
#include "saltus/collision/gap.hpp"

#include <array>
#include <cassert>
#include <limits>
#include <type_traits>
#include <utility>

#include "collision/convex/convex_gap.hpp"
#include "collision/gap/sphere_gap.hpp"
#include "collision/pairs/capsule_capsule.hpp"
#include "collision/shapes/facts.hpp"

namespace saltus {
namespace {

/// Inside b the nearest part of its surface counts.
template <HasDistance B>
Gap gap_between(const Sphere& a, const Pose& X_WA, const B& b, const Pose& X_WB) {
  return sphere_gap(a, X_WA, X_WB, distance_of(b, in_frame(X_WB, X_WA.p)));
}

/// The lowest point x of the core:
///
///   phi = n.(x - p_B) - radius,   m = -R_A^T n  (down, in a's axes),   x farthest along m
///
/// A direction counts as level where it rises by no more than a rounding error. Of equally low
/// points the one counts that is on the + side of the body's own axes, so that a body lying flat
/// touches at a corner, at an end or, upright cylinder, at the rim on its x axis. The plane bends
/// nowhere; a point, or a curve bent away from it, is all that M of curvature.cpp needs to be
/// regular.
Gap gap_over_plane(const Shape& a, const Pose& X_WA, const Pose& X_WB) {
  const Vec3 n = X_WB.R.col(2);
  const Lowest low = lowest(a, -(X_WA.R.transpose() * n));
  const Vec3 x_W = X_WA.R * low.x, center = X_WA.p + x_W;
  const double d = n.dot((X_WA.p - X_WB.p) + x_W), radius = core_radius(a);
  return {.phi = d - radius,
          .n_W = n,
          .p_WA = center - radius * n,
          .p_WB = center - d * n,
          .center_W = center,
          .d = d,
          .a = in_world(X_WA.R, low.patch),
          .b = in_world(X_WB.R, face_across(2))};
}

/// About b's origin in the world's axes: a's position is then of the size of the distance. Where a
/// face lies on a face or an edge, the witness is the corner of what they share that is farthest
/// from both bodies' origins; of parallel edges, sides or segments, an end.
Gap gap_of_cores(const Shape& a, const Pose& X_WA, const Shape& b, const Pose& X_WB) {
  return convex_gap(solid_of(a, X_WA.R, X_WA.p - X_WB.p), solid_of(b, X_WB.R, Vec3::Zero()),
                    X_WB.p);
}

template <class A, class B>
concept ClosedForm = requires(const A& a, const B& b, const Pose& X) { gap_between(a, X, b, X); };

template <class S, std::size_t I = 0>
constexpr std::size_t index_of() {
  if constexpr (std::is_same_v<S, std::variant_alternative_t<I, Shape>>) {
    return I;
  } else {
    return index_of<S, I + 1>();
  }
}

template <class A, class B>
constexpr bool over_plane = HasCore<A> && std::is_same_v<B, HalfSpace>;

/// In this order: of two cores the one listed first in Shape is a.
template <class A, class B>
constexpr bool serves =
    ClosedForm<A, B> || over_plane<A, B> ||
    (!ClosedForm<B, A> && HasCore<A> && HasCore<B> && index_of<A>() <= index_of<B>());

Gap exchanged(Gap g) {
  std::swap(g.p_WA, g.p_WB);
  // P is the point of the other core, d beyond; bends are measured along n
  g.center_W -= g.d * g.n_W;
  g.n_W = -g.n_W;
  std::swap(g.a, g.b);
  for (Patch* patch : {&g.a, &g.b}) {
    patch->k00 = -patch->k00;
    patch->k01 = -patch->k01;
    patch->k11 = -patch->k11;
  }
  return g;
}

Gap no_gap() {
  assert(!"gap() of a pair without a gap function");
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const Vec3 none = Vec3::Constant(nan);
  return {nan, none, none, none, none, nan, {}, {}};
}

/// One shape of each kind, of no particular size.
template <std::size_t... I>
std::array<Shape, sizeof...(I)> one_of_each(std::index_sequence<I...>) {
  return {Shape(std::in_place_index<I>)...};
}

}  // namespace

bool has_gap(const Shape& a, const Shape& b) {
  return std::visit(
      []<class A, class B>(const A&, const B&) { return serves<A, B> || serves<B, A>; }, a, b);
}

Gap gap(const Shape& a, const Pose& X_WA, const Shape& b, const Pose& X_WB) {
  return std::visit(
      [&]<class A, class B>(const A& shape_a, const B& shape_b) {
        if constexpr (ClosedForm<A, B>) {
          return gap_between(shape_a, X_WA, shape_b, X_WB);
        } else if constexpr (over_plane<A, B>) {
          return gap_over_plane(a, X_WA, X_WB);
        } else if constexpr (serves<A, B>) {
          return gap_of_cores(a, X_WA, b, X_WB);
        } else if constexpr (serves<B, A>) {
          return exchanged(gap(b, X_WB, a, X_WA));
        } else {
          return no_gap();
        }
      },
      a, b);
}

std::vector<std::pair<std::string, std::string>> gap_table() {
  std::vector<std::pair<std::string, std::string>> table;
  const auto shapes = one_of_each(std::make_index_sequence<std::variant_size_v<Shape>>());
  for (const Shape& a : shapes) {
    for (const Shape& b : shapes) {
      const bool row =
          std::visit([]<class A, class B>(const A&, const B&) { return serves<A, B>; }, a, b);
      if (row) table.emplace_back(shape_name(a), shape_name(b));
    }
  }
  return table;
}

}  // namespace saltus
