#include "variational/law/contact_qp.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

#include "saltus/error.hpp"
#include "variational/law/contact_problem.hpp"
#include "variational/law/pile.hpp"

namespace saltus {
namespace {

using Mat = Eigen::MatrixXd;
using Indices = std::vector<Eigen::Index>;

constexpr double accuracy = 1e-10;        ///< of complementarity, what is promised
constexpr double rounding = 1e-14;        ///< no better can be had
constexpr double rank_tolerance = 1e-11;  ///< what redundant contacts leave is 1e-16 of W
constexpr double no_interior = 1e-7;      ///< d^2 is known to a few 1e-16

struct Scaled {
  VecX root;  ///< (m) 1 / sqrt(G_ii)
  Mat G;      ///< (m, m) with ones on its diagonal
};

Scaled scaled(const Eigen::Ref<const MatX>& G) {
  Scaled out;
  out.root = G.diagonal().array().rsqrt();
  const Mat product = out.root.asDiagonal() * G * out.root.asDiagonal();
  out.G = 0.5 * (product + product.transpose());
  return out;
}

/// min over lambda >= 0 of  lambda . G lambda / 2 + u . lambda: contacts without friction that
/// rest. Where G is 0 nothing can be done.
VecX solve_nonnegative(const Mat& G, const VecX& u) {
  constexpr double nothing = 1e-20;
  Indices some;
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    if (G(i, i) > nothing) some.push_back(i);
  }
  const auto m = static_cast<Eigen::Index>(some.size());
  MatX W = MatX::Zero(3 * m, 3 * m);
  std::vector<Vec3> rate, impulse(some.size(), Vec3::Zero());
  for (Eigen::Index i = 0; i < m; ++i) {
    for (Eigen::Index j = 0; j < m; ++j) W(3 * i, 3 * j) = G(some[i], some[j]);
    rate.emplace_back(u[some[i]], 0, 0);
  }
  PileScratch scratch;
  settle_for_sure(contact_blocks(W), scratch, rate, impulse);
  VecX lambda = VecX::Zero(u.size());
  for (std::size_t i = 0; i < some.size(); ++i) lambda[some[i]] = std::max(impulse[i][0], 0.0);
  return lambda;
}

/// How far lambda >= 0 is from 0 <= u + G lambda and complementarity.
double miss(const Mat& G, const VecX& u, const VecX& lambda) {
  const VecX s = u + G * lambda;
  double worst = 0;
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    worst = std::max(worst, lambda[i] > 0 ? std::abs(s[i]) : -s[i]);
  }
  return worst;
}

/// The shortest x of A x = b, one step refined.
VecX shortest_solution(const Mat& A, const VecX& b, Eigen::Index& rank) {
  Eigen::CompleteOrthogonalDecomposition<Mat> Q(A.rows(), A.cols());
  Q.setThreshold(rank_tolerance);
  Q.compute(A);
  rank = Q.rank();
  const VecX x = Q.solve(b);
  return x + VecX(Q.solve(b - A * x));
}

/// G lambda = -u, lambda >= 0, as short as can be; some other lambda >= 0 where there is none.
VecX shortest(const Mat& G, const VecX& u) {
  const auto m = u.size();
  Eigen::Index rank = 0;
  VecX lambda = shortest_solution(G, -u, rank);
  const double size = lambda.cwiseAbs().maxCoeff();
  if (rank == m || lambda.minCoeff() >= -1e-12 * size) return lambda.cwiseMax(0.0);
  // Of all solutions the shortest has negative parts. That without them has zeros instead; which,
  // the shortest y with lambda + Z y >= 0 tells, Z what G does not see (m, m - rank). Its dual is a
  // problem of this kind: y = Z^T mu.
  const Mat Z = Eigen::SelfAdjointEigenSolver<Mat>(G).eigenvectors().leftCols(m - rank);
  const Mat ZZ = Z * Z.transpose();
  lambda += size * ZZ * solve_nonnegative(ZZ, VecX(lambda / size));
  Indices some;
  for (Eigen::Index i = 0; i < m; ++i) {
    if (lambda[i] > 1e-8 * size) some.push_back(i);
  }
  const VecX positive = lambda;
  lambda.setZero();
  if (!some.empty()) lambda(some) = shortest_solution(Mat(G(Eigen::all, some)), -u, rank);
  return lambda.minCoeff() >= -1e-12 * size ? lambda.cwiseMax(0.0) : positive.cwiseMax(0.0);
}

/// lambda if just these contacts stay closed, 0 for all others.
VecX closed_by(const Mat& G, const VecX& u, const Indices& stay) {
  VecX lambda = VecX::Zero(u.size());
  if (!stay.empty()) lambda(stay) = shortest(Mat(G(stay, stay)), VecX(u(stay)));
  // what rounding leaves of none
  return (lambda.array() > 1e-14 * lambda.maxCoeff()).select(lambda, 0.0);
}

/// The best lambda so far, and how far it is from its conditions.
struct Best {
  VecX lambda;
  double miss;

  bool exact() const { return miss <= rounding * std::max(1.0, lambda.maxCoeff()); }

  void offer(const Mat& G, const VecX& u, const VecX& other) {
    const double missed = saltus::miss(G, u, other);
    if (missed < miss) *this = {other, missed};
  }
};

/// Block principal pivoting (J. Judice and F. Pires, Computers & Operations Research 21, 1994), for
/// masses so unlike that the guess is not near enough: all contacts that are wrong change
/// sides at once, and after a few rounds one at a time, which ends for certain if G is regular.
void pivot(const Mat& G, const VecX& u, Best& best) {
  const auto m = u.size();
  Eigen::Index rank = 0;
  VecX lambda = best.lambda, s = u + G * lambda;
  std::vector<char> closed(static_cast<std::size_t>(m));
  for (Eigen::Index i = 0; i < m; ++i) closed[i] = lambda[i] > s[i];
  const Eigen::Index blocks = 10, rounds = blocks + 20 * m;
  for (Eigen::Index round = 0; round < rounds && !best.exact(); ++round) {
    Indices stay;
    for (Eigen::Index i = 0; i < m; ++i) {
      if (closed[i]) stay.push_back(i);
    }
    lambda.setZero();
    if (!stay.empty()) lambda(stay) = shortest_solution(Mat(G(stay, stay)), -VecX(u(stay)), rank);
    best.offer(G, u, lambda.cwiseMax(0.0));
    s = u + G * lambda;
    for (Eigen::Index i = 0; i < m; ++i) {
      if (closed[i] ? lambda[i] >= 0 : s[i] >= 0) continue;
      closed[i] = !closed[i];
      if (round >= blocks) break;
    }
  }
}

}  // namespace

VecX contact_multipliers(const Eigen::Ref<const MatX>& G, const VecRef& u) {
  const auto m = u.size();
  if (m == 0 || u.minCoeff() >= 0) return VecX::Zero(m);
  if (m == 1) return -u / G(0, 0);
  const Scaled problem = scaled(G);
  VecX rate = problem.root.cwiseProduct(u);
  const double size = rate.cwiseAbs().maxCoeff();
  rate /= size;
  const VecX guess = solve_nonnegative(problem.G, rate);
  // however exact the guess, it is one of many where contacts are redundant, not the shortest
  Best best{guess, std::numeric_limits<double>::infinity()};
  // From loose to tight: a rate that is 0 is among those "at most 1e-4" however inexact the guess,
  // so that contacts alike are treated alike; one that is 1e-5 is told by the check.
  const VecX after = rate + problem.G * guess;
  for (double closed = 1e-4; closed > 1e-13 && !best.exact(); closed *= 0.1) {
    Indices stay;
    for (Eigen::Index i = 0; i < m; ++i) {
      if (after[i] <= closed) stay.push_back(i);
    }
    best.offer(problem.G, rate, closed_by(problem.G, rate, stay));
  }
  if (best.miss > accuracy) best.offer(problem.G, rate, guess);
  if (best.miss > accuracy) pivot(problem.G, rate, best);
  if (!(best.miss <= accuracy + 10 * rounding * best.lambda.maxCoeff())) {
    std::ostringstream text;
    text << "the projection of " << m << " contacts misses complementarity by " << best.miss
         << ", and 1e-10 is asked for; masses or normals are too unlike for double precision";
    throw StepError(text.str(), 0, best.miss, static_cast<int>(m));
  }
  return size * problem.root.cwiseProduct(best.lambda);
}

double cone_interior(const Eigen::Ref<const MatX>& G) {
  const auto m = G.rows();
  if (m == 1) return 1;
  const Mat H = scaled(G).G;
  // least lambda . H lambda + (1 - sum of lambda)^2 without the simplex: shorter, the same
  // direction
  VecX guess = solve_nonnegative(H + Mat::Ones(m, m), VecX::Constant(m, -1));
  guess /= guess.sum();
  // w = N^T lambda opens gap i at the rate (G lambda)_i / |w|: whatever lambda is, this is reached
  const auto reached = [&H](const VecX& lambda) {
    const VecX rate = H * lambda;
    const double square = lambda.dot(rate);
    return square > no_interior * no_interior * lambda.squaredNorm()
               ? rate.minCoeff() / std::sqrt(square)
               : 0.0;
  };
  double d = reached(guess);
  Indices some;
  for (Eigen::Index i = 0; i < m; ++i) {
    if (guess[i] > 1e-8) some.push_back(i);
  }
  // those that take part open at the same rate
  VecX lambda = VecX::Zero(m);
  const Mat part = H(some, some);
  const VecX ones = VecX::Ones(static_cast<Eigen::Index>(some.size()));
  lambda(some) = VecX(part.completeOrthogonalDecomposition().solve(ones));
  if (lambda.minCoeff() >= 0) d = std::max(d, reached(lambda));
  return d > no_interior ? d : 0;
}

}  // namespace saltus
