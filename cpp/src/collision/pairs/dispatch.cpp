// Dispatch: the one place that knows which pairs have a gap.
//
// A pair with a closed form is an overload of gap_between in its own file. Its header must be
// included here, above the templates: an overload declared after them would be silently invisible.
// Any other two shapes with a core (solid.hpp) are served by convex_gap.
#include "saltus/collision/gap.hpp"

#include <array>
#include <cassert>
#include <limits>
#include <type_traits>
#include <utility>

#include "collision/convex/convex_gap.hpp"
#include "collision/pairs/capsule_capsule.hpp"
#include "collision/pairs/half_space_pairs.hpp"
#include "collision/pairs/sphere_box.hpp"
#include "collision/pairs/sphere_capsule.hpp"
#include "collision/pairs/sphere_convex.hpp"
#include "collision/pairs/sphere_cylinder.hpp"
#include "collision/pairs/sphere_ellipsoid.hpp"
#include "collision/pairs/sphere_half_space.hpp"
#include "collision/pairs/sphere_sphere.hpp"

namespace saltus {
namespace {

template <class A, class B>
concept ClosedForm = requires(const A& a, const B& b, const Pose& X) { gap_between(a, X, b, X); };

template <class S>
concept HasCore = requires(const S& s, const Pose& X) { solid_of(s, X.R, X.p); };

template <class S, std::size_t I = 0>
constexpr std::size_t index_of() {
  if constexpr (std::is_same_v<S, std::variant_alternative_t<I, Shape>>) {
    return I;
  } else {
    return index_of<S, I + 1>();
  }
}

/// In this order: of two without a closed form the one listed first in Shape is a.
template <class A, class B>
constexpr bool serves = ClosedForm<A, B> || (!ClosedForm<B, A> && HasCore<A> && HasCore<B> &&
                                             index_of<A>() <= index_of<B>());

/// About b's origin in the world's axes: a's position is then of the size of the distance.
template <class A, class B>
Gap gap_of_cores(const A& a, const Pose& X_WA, const B& b, const Pose& X_WB) {
  return convex_gap(solid_of(a, X_WA.R, X_WA.p - X_WB.p), solid_of(b, X_WB.R, Vec3::Zero()),
                    X_WB.p);
}

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
        } else if constexpr (serves<A, B>) {
          return gap_of_cores(shape_a, X_WA, shape_b, X_WB);
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
