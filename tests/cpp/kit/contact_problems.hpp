// Contacts at one instant that tests share: lines of balls, discs in the plane, Coxeter diagrams.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "saltus/variational/cascade.hpp"

namespace saltus {

inline VecX vec(std::initializer_list<double> values) {
  VecX x(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), x.data());
  return x;
}

inline void expect_near(const VecX& actual, const VecX& expected, double tolerance) {
  ASSERT_EQ(actual.size(), expected.size());
  EXPECT_LE((actual - expected).cwiseAbs().maxCoeff(), tolerance)
      << "actual " << actual.transpose() << "\nexpected " << expected.transpose();
}

/// Contacts between neighbours in a line: phi_i = x_{i+1} - x_i - 2r.
inline MatX line(int balls) {
  MatX N = MatX::Zero(balls - 1, balls);
  for (int i = 0; i + 1 < balls; ++i) {
    N(i, i) = -1;
    N(i, i + 1) = 1;
  }
  return N;
}

/// Discs in the plane, coordinates x_0, y_0, x_1, ...: a contact where two touch to 1e-9.
inline MatX touching_discs(const std::vector<std::array<double, 2>>& centre, double radius) {
  std::vector<VecX> rows;
  const auto n = static_cast<Eigen::Index>(2 * centre.size());
  for (std::size_t i = 0; i < centre.size(); ++i) {
    for (std::size_t j = i + 1; j < centre.size(); ++j) {
      const double dx = centre[j][0] - centre[i][0], dy = centre[j][1] - centre[i][1];
      const double distance = std::hypot(dx, dy);
      if (distance > 2 * radius + 1e-9) continue;
      VecX row = VecX::Zero(n);
      const auto a = static_cast<Eigen::Index>(2 * i), b = static_cast<Eigen::Index>(2 * j);
      row.segment<2>(a) << -dx / distance, -dy / distance;
      row.segment<2>(b) << dx / distance, dy / distance;
      rows.push_back(row);
    }
  }
  MatX N(static_cast<Eigen::Index>(rows.size()), n);
  for (std::size_t i = 0; i < rows.size(); ++i) N.row(static_cast<Eigen::Index>(i)) = rows[i];
  return N;
}

/// Bernoulli's problem: the cue comes along x and touches two discs that touch each other, r = 1/2.
inline MatX bernoulli() {
  const double c = std::sqrt(3.) / 2;
  MatX N = MatX::Zero(2, 6);
  N.row(0) << -c, .5, c, -.5, 0, 0;  // cue, lower target
  N.row(1) << -c, -.5, 0, 0, c, .5;  // cue, upper target
  return N;
}

/// A Coxeter diagram: contacts i and j meet at pi/m for every edge {i, j, m}, else at pi/2.
struct Diagram {
  std::string type;
  int rank;
  std::vector<std::array<int, 3>> edges;
  int impulses;  ///< its positive roots
};

/// Those of finite groups, as in theory, section 8, and the exceptional ones up to E6.
inline std::vector<Diagram> finite_diagrams() {
  return {{"A3", 3, {{0, 1, 3}, {1, 2, 3}}, 6},
          {"B3", 3, {{0, 1, 3}, {1, 2, 4}}, 9},
          {"H3", 3, {{0, 1, 5}, {1, 2, 3}}, 15},
          {"A4", 4, {{0, 1, 3}, {1, 2, 3}, {2, 3, 3}}, 10},
          {"B4", 4, {{0, 1, 3}, {1, 2, 3}, {2, 3, 4}}, 16},
          {"D4", 4, {{0, 1, 3}, {1, 2, 3}, {1, 3, 3}}, 12},
          {"F4", 4, {{0, 1, 3}, {1, 2, 4}, {2, 3, 3}}, 24},
          {"H4", 4, {{0, 1, 3}, {1, 2, 3}, {2, 3, 5}}, 60},
          {"D5", 5, {{0, 1, 3}, {1, 2, 3}, {2, 3, 3}, {2, 4, 3}}, 20},
          {"E6", 6, {{0, 1, 3}, {1, 2, 3}, {2, 3, 3}, {3, 4, 3}, {2, 5, 3}}, 36},
          {"E7", 7, {{0, 1, 3}, {1, 2, 3}, {2, 3, 3}, {3, 4, 3}, {4, 5, 3}, {2, 6, 3}}, 63},
          {"E8",
           8,
           {{0, 1, 3}, {1, 2, 3}, {2, 3, 3}, {3, 4, 3}, {4, 5, 3}, {5, 6, 3}, {2, 7, 3}},
           120}};
}

inline MatX gram(const Diagram& diagram) {
  MatX G = MatX::Identity(diagram.rank, diagram.rank);
  for (const auto& [i, j, m] : diagram.edges) G(i, j) = G(j, i) = -std::cos(std::numbers::pi / m);
  return G;
}

/// Normals with this Gram matrix.
inline MatX normals(const MatX& G) { return Eigen::LLT<Eigen::MatrixXd>(G).matrixL(); }

/// Two contacts that meet at this angle.
inline MatX wedge(double theta) {
  return (MatX(2, 2) << 1, 0, -std::cos(theta), std::sin(theta)).finished();
}

inline MatX random_matrix(int rows, int columns, std::mt19937& random) {
  std::normal_distribution<double> normal;
  MatX A(rows, columns);
  for (double& x : A.reshaped()) x = normal(random);
  return A;
}

inline VecX random_vector(int n, std::mt19937& random) {
  return random_matrix(n, 1, random).reshaped();
}

inline double kinetic_norm(const MatX& M, const VecX& v) { return std::sqrt(v.dot(M * v)); }

}  // namespace saltus
