// Volumes and inertias of homogeneous solids, against sums over slices and closed forms.
#include "saltus/model/solids.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "kit/hulls.hpp"
#include "saltus/error.hpp"

namespace saltus {
namespace {

constexpr double pi = std::numbers::pi;

/// Half axes along x and y of the ellipse that a plane z = const cuts out.
using test::corners;
using test::hull_of;
using Slice = std::function<Eigen::Vector2d(double)>;

struct Sum {
  double volume = 0;
  Vec3 I = Vec3::Zero();  ///< of density 1, about the origin
};

/// Midpoint rule. The integrands are polynomials of degree 4 between the ends of a piece, so that
/// 2000 slices leave about (1/2000)^2 = 3e-7 of a piece's integral.
void add_slices(const Slice& slice, double from, double to, Sum& sum) {
  constexpr int n = 2000;
  const double dz = (to - from) / n;
  for (int i = 0; i < n; ++i) {
    const double z = from + (i + 0.5) * dz;
    const Eigen::Vector2d s = slice(z);
    const double V = pi * s[0] * s[1] * dz, x = s[0] * s[0] / 4, y = s[1] * s[1] / 4;
    sum.volume += V;
    sum.I += V * Vec3(y + z * z, x + z * z, x + y);
  }
}

Sum sum_of(const Capsule& c) {
  const auto ball = [&](double z) {
    return Eigen::Vector2d::Constant(std::sqrt(c.radius * c.radius - z * z)).eval();
  };
  Sum sum;
  const double l = c.half_length, r = c.radius;
  add_slices([&](double) { return Eigen::Vector2d::Constant(r).eval(); }, -l, l, sum);
  add_slices([&](double z) { return ball(z - l); }, l, l + r, sum);
  add_slices([&](double z) { return ball(z + l); }, -l - r, -l, sum);
  return sum;
}

Sum sum_of(const Cylinder& c) {
  Sum sum;
  add_slices([&](double) { return Eigen::Vector2d::Constant(c.radius).eval(); }, -c.half_length,
             c.half_length, sum);
  return sum;
}

Sum sum_of(const Ellipsoid& e) {
  Sum sum;
  const auto slice = [&](double z) {
    return Eigen::Vector2d(e.radii.head<2>() * std::sqrt(1 - std::pow(z / e.radii.z(), 2)));
  };
  add_slices(slice, -e.radii.z(), e.radii.z(), sum);
  return sum;
}

void expect_near(const BodyInertia& body, const BodyInertia& other, double relative) {
  EXPECT_NEAR(body.mass, other.mass, relative * other.mass);
  const double size = std::sqrt(other.I_J.norm() / other.mass);
  EXPECT_LT((body.c_J - other.c_J).norm(), relative * size);
  EXPECT_LT((body.I_J - other.I_J).norm(), relative * other.I_J.norm());
}

void expect_sum(const Shape& shape, const Sum& sum) {
  EXPECT_NEAR(volume(shape), sum.volume, 1e-6 * sum.volume);
  const Mat3 I = 3 / sum.volume * sum.I.asDiagonal().toDenseMatrix();
  expect_near(solid_inertia(3, shape), {3, Vec3::Zero(), I}, 1e-6);
}

TEST(Solids, AreTheSumsOfTheirSlices) {
  expect_sum(Capsule{0.2, 0.5}, sum_of(Capsule{0.2, 0.5}));
  expect_sum(Capsule{0.5, 0.1}, sum_of(Capsule{0.5, 0.1}));
  expect_sum(Cylinder{0.3, 0.7}, sum_of(Cylinder{0.3, 0.7}));
  expect_sum(Ellipsoid{{0.2, 0.3, 0.5}}, sum_of(Ellipsoid{{0.2, 0.3, 0.5}}));
  expect_sum(Sphere{0.4}, sum_of(Ellipsoid{Vec3::Constant(0.4)}));
}

TEST(Solids, OfOneShapeByTwoNamesAreTheSame) {
  const double eps = 1e-14;  // rounding of a few products
  expect_near(solid_inertia(2, Sphere{0.3}), solid_sphere(2, 0.3), eps);
  expect_near(solid_inertia(2, Ellipsoid{Vec3::Constant(0.3)}), solid_sphere(2, 0.3), eps);
  expect_near(solid_inertia(2, Capsule{0.3, 0}), solid_sphere(2, 0.3), eps);
  expect_near(solid_inertia(2, Box{{1, 2, 3}}), solid_box(2, {1, 2, 3}), eps);
  expect_near(solid_inertia(2, Cylinder{1, 2}), solid_cylinder(2, 1, 2), eps);
  expect_near(solid_inertia(2, hull_of(corners({1, 2, 3}))), solid_box(2, {1, 2, 3}), eps);
  EXPECT_DOUBLE_EQ(volume(Box{{1, 2, 3}}), 48);
  EXPECT_NEAR(volume(hull_of(corners({1, 2, 3}))), 48, 48 * eps);
}

// The mean of x^2 over the simplex is 1/10, that of xy 1/20, that of x 1/4.
TEST(Solids, ATetrahedronHasItsClosedForm) {
  const Convex corner = hull_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  Mat3 I = Mat3::Constant(1.0 / 80);
  I.diagonal().setConstant(6.0 / 80);
  expect_near(solid_inertia(5, corner), {5, Vec3::Constant(0.25), 5 * I}, 1e-14);
  EXPECT_NEAR(volume(corner), 1.0 / 6, 1e-15);
}

// A metre away from its frame's origin, which costs a hundred times the rounding.
TEST(Solids, AHullMovesWithItsPoints) {
  const Pose X{rotation_from_rpy(0.3, -0.7, 1.1), Vec3(0.5, -0.7, 0.6)};
  const Convex moved = hull_of(corners({0.1, 0.2, 0.05}, X));
  expect_near(solid_inertia(1, moved), transform(X, solid_box(1, {0.1, 0.2, 0.05})), 1e-12);
}

// An inscribed prism of n sides has moments (1 - O(1/n^2)) of the cylinder's: 2 pi^2 / 3 n^2 less
// volume, and per mass less than twice that.
TEST(Solids, APrismOfManySidesIsACylinder) {
  std::vector<Vec3> points;
  constexpr int n = 200;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * pi * i / n;
    for (const double z : {-0.5, 0.5}) points.emplace_back(std::cos(angle), std::sin(angle), z);
  }
  const Convex prism = hull_of(points);
  const double bound = 2 * 2 * pi * pi / 3 / (n * n);
  expect_near(solid_inertia(1, prism), solid_cylinder(1, 1, 0.5), bound);
  EXPECT_NEAR(volume(prism), volume(Cylinder{1, 0.5}), bound * pi);
}

TEST(Solids, WhatNoBodyCanBeIsRefused) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  EXPECT_THROW(solid_inertia(1, HalfSpace{}), ModelError);
  EXPECT_THROW(volume(HalfSpace{}), ModelError);
  EXPECT_THROW(solid_inertia(1, Convex{}), ModelError);
  EXPECT_THROW(volume(Convex{}), ModelError);
  for (const double bad : {0.0, -1.0, inf, std::nan("")}) {
    for (const Shape& shape :
         std::vector<Shape>{Sphere{bad}, Box{{1, bad, 1}}, Cylinder{bad, 1}, Cylinder{1, bad},
                            Capsule{bad, 1}, Capsule{bad, 0}, Ellipsoid{{1, 1, bad}}}) {
      EXPECT_THROW(solid_inertia(1, shape), ModelError) << shape_name(shape) << " " << bad;
      EXPECT_THROW(volume(shape), ModelError) << shape_name(shape) << " " << bad;
    }
    EXPECT_THROW(solid_inertia(bad, Sphere{1}), ModelError);
    EXPECT_THROW(solid_inertia(bad, Capsule{1, 1}), ModelError);
    EXPECT_THROW(solid_inertia(bad, hull_of(corners({1, 1, 1}))), ModelError);
  }
  EXPECT_THROW(solid_inertia(1, Capsule{1, -1}), ModelError);
}

}  // namespace
}  // namespace saltus
