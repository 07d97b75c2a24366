// Dispatch: what is asked of any shape is asked of the one that it is, by overload (facts.hpp).
#include "saltus/collision/shapes.hpp"

#include <sstream>
#include <type_traits>

#include "collision/shapes/facts.hpp"

namespace saltus {
namespace {

/// The answer of a shape that has one, else nothing: T().
template <class T, class Question>
T ask(const Shape& shape, const Question& question) {
  return std::visit(
      [&](const auto& s) -> T {
        if constexpr (std::is_invocable_v<Question, decltype(s)>) {
          return question(s);
        } else {
          return T();
        }
      },
      shape);
}

Core core(const Shape& shape) {
  return ask<Core>(shape, [](const auto& s) -> decltype(core_of(s)) { return core_of(s); });
}

}  // namespace

std::string shape_name(const Shape& shape) {
  return std::visit([](const auto& s) { return s.name; }, shape);
}

double bounding_radius(const Shape& shape) {
  return std::visit([](const auto& s) { return ball_of(s); }, shape);
}

double feature_size(const Shape& shape) {
  return std::visit([](const auto& s) { return size_of(s); }, shape);
}

std::string flaw(const Shape& shape) {
  return std::visit([](const auto& s) { return flaw_of(s); }, shape);
}

Homogeneous homogeneous(const Shape& shape, double mass) {
  return ask<Homogeneous>(shape, [&](const auto& s) -> decltype(homogeneous_of(s, mass)) {
    return homogeneous_of(s, mass);
  });
}

double core_radius(const Shape& shape) { return core(shape).radius; }

double core_extent(const Shape& shape) {
  const Core c = core(shape);
  return c.radius > 0 ? c.length : bounding_radius(shape);
}

Vec3 core_support(const Shape& shape, const Vec3& d) {
  return ask<Vec3>(shape,
                   [&](const auto& s) -> decltype(farthest_of(s, d)) { return farthest_of(s, d); });
}

PartCounts part_counts(const Shape& shape) {
  return std::visit([](const auto& s) { return parts_of(s); }, shape);
}

Capsule edge_capsule(const Shape& shape) {
  return std::visit([](const auto& s) { return axis_of(s); }, shape);
}

PartOfShape corner(const Shape& shape, int k) {
  return ask<PartOfShape>(
      shape, [&](const auto& s) -> decltype(corner_of(s, k)) { return corner_of(s, k); });
}

PartOfShape edge(const Shape& shape, int k) {
  return ask<PartOfShape>(shape,
                          [&](const auto& s) -> decltype(edge_of(s, k)) { return edge_of(s, k); });
}

PartOfShape rim(const Shape& shape, int k) {
  return ask<PartOfShape>(shape,
                          [&](const auto& s) -> decltype(rim_of(s, k)) { return rim_of(s, k); });
}

Lowest lowest(const Shape& shape, const Vec3& m) {
  return std::visit(
      [&](const auto& s) -> Lowest {
        if constexpr (requires { lowest_of(s, m); }) {
          return lowest_of(s, m);
        } else {
          const Solid solid = solid_of(shape, Mat3::Identity(), Vec3::Zero());
          const Flat flat = flat_along(solid, m, level_sine);
          const Feature at = corner_feature(flat, flat.at(0), m);
          return {at.x, patch_of(solid, at, -m)};
        }
      },
      shape);
}

Solid solid_of(const Shape& shape, const Mat3& R, const Vec3& p) {
  const Core c = core(shape);
  return {&shape, R, p, c.radius, c.length, c.curved};
}

Vec3 support(const Solid& solid, const Vec3& m) {
  const Vec3 d = solid.R.transpose() * m;
  const Vec3 x = std::visit(
      [&]<class S>(const S& s) -> Vec3 {
        if constexpr (requires { farthest_near(s, d, solid.hint); }) {
          return farthest_near(s, d, solid.hint);
        } else if constexpr (HasCore<S>) {
          return farthest_of(s, d);
        } else {
          return Vec3::Zero();
        }
      },
      *solid.shape);
  return solid.p + solid.R * x;
}

void find_nearby(const Solid& solid, const Vec3& m, double width, Nearby& out) {
  out.count = out.faces = 0;
  const Vec3 d = solid.R.transpose() * m;
  ask<void>(*solid.shape, [&](const auto& s) -> decltype(nearby_of(s, solid, d, width, out)) {
    nearby_of(s, solid, d, width, out);
  });
}

Flat flat_along(const Solid& solid, const Vec3& m, double level) {
  Flat out;
  out.solid = &solid;
  out.along = m;
  const Vec3 d = solid.R.transpose() * m;
  ask<void>(*solid.shape, [&](const auto& s) -> decltype(flat_of(s, solid, d, level, out)) {
    flat_of(s, solid, d, level, out);
  });
  return out;
}

Feature surface_at(const Solid& solid, const Vec3& m) {
  return ask<Feature>(*solid.shape, [&](const auto& s) -> decltype(surface_of(s, solid, m)) {
    return surface_of(s, solid, m);
  });
}

void slide_on_surface(const Solid& solid, const Vec3& step_W, Feature& f) {
  ask<void>(*solid.shape, [&](const auto& s) -> decltype(slide_on(s, solid, step_W, f)) {
    slide_on(s, solid, step_W, f);
  });
}

Patch patch_of_surface(const Solid& solid, const Feature& f, const Vec3& n) {
  return ask<Patch>(*solid.shape, [&](const auto& s) -> decltype(patch_on(s, solid, f, n)) {
    return patch_on(s, solid, f, n);
  });
}

PartOfShape point(const std::string& name, double radius, const Vec3& p) {
  return {name, Sphere{radius}, {Mat3::Identity(), p}};
}

Vec3 between(const Vec3& m, const Vec3& n) {
  const Vec3 sum = m + n;
  return 2 / sum.squaredNorm() * sum;
}

std::string flaw_of_size(const Vec3& size) {
  if (size.allFinite() && (size.array() > 0).all()) return "";
  std::ostringstream text;
  text << "of size (" << size[0] << " " << size[1] << " " << size[2]
       << "); sizes are finite and positive";
  return text.str();
}

}  // namespace saltus
