#include "lagrangian/packed/matrix.hpp"

#include <utility>

#include "lagrangian/packed/ball.hpp"
#include "lagrangian/packed/own_terms.hpp"

namespace saltus {
namespace packed {
namespace {

/// s, t, u, w of the header.
SALTUS_CLONES void set_generators(const PackedTree& t, const Packed& w, double tau,
                                  PackedMatrix& J) {
  const double half = tau / 2, quarter = -tau * tau / 4;
  for (int b = 0; b < t.slots / lanes; ++b) {
    const double *S_W = w.S_W[b].x[0], *U_F_G = w.U_F_G[b].x[0];
    double *s_t = J.s_t[b].x[0], *u_w = J.u_w[b].x[0];
    SALTUS_LANES
    for (int l = 0; l < lanes; ++l) {
      const V6 S = load6(S_W + l, 0), W = half * load6(S_W + l, 6);
      store(s_t + l, 0, S + W);
      store(s_t + l, 6, S.w);
      store(s_t + l, 9, S - W);
      store(s_t + l, 15, quarter * S.w);
    }
    SALTUS_LANES
    for (int l = 0; l < lanes; ++l) {
      const V6 U = load6(U_F_G + l, 0), F = half * load6(U_F_G + l, 6);
      const V3 G = load3(U_F_G + l, 12);
      store(u_w + l, 0, U - F);
      store(u_w + l, 6, quarter * G);
      store(u_w + l, 9, U + F);
      store(u_w + l, 15, G);
    }
  }
}

/// The same at tau = 0, from S and U alone: mass_pass leaves the rest as it was.
SALTUS_CLONES void set_mass_generators(const PackedTree& t, const Packed& w, PackedMatrix& J) {
  for (int b = 0; b < t.slots / lanes; ++b) {
    const double *S = w.S_W[b].x[0], *U = w.U_F_G[b].x[0];
    double *s_t = J.s_t[b].x[0], *u_w = J.u_w[b].x[0];
    const V3 zero{0, 0, 0};
    SALTUS_LANES
    for (int l = 0; l < lanes; ++l) {
      store(s_t + l, 0, load6(S + l, 0));
      store(s_t + l, 6, zero);
      store(s_t + l, 9, load6(S + l, 0));
      store(s_t + l, 15, zero);
      store(u_w + l, 0, load6(U + l, 0));
      store(u_w + l, 6, zero);
      store(u_w + l, 9, load6(U + l, 0));
      store(u_w + l, 15, zero);
    }
  }
}

}  // namespace
}  // namespace packed

namespace {

bool has_sweep(const PackedTree& t) {
  for (const PackedGroup& g : t.groups) {
    if (g.sweep) return true;
  }
  return false;
}

void prepare_sweep(const PackedTree& t, PackedMatrix& J) {
  const std::size_t n = static_cast<std::size_t>(t.slots);
  for (auto* rows : {&J.s, &J.t, &J.gain, &J.row, &J.c, &J.a}) rows->resize(n);
  if (!t.balls.empty()) J.pivot.resize(n / lanes);
  J.branch_of.assign(n, -1);
  int branches = 0;
  for (const PackedGroup& g : t.groups) {
    for (int k = 1; k < g.positions && g.sweep; ++k) {
      if (g.parent[k] == k - 1) continue;
      int& branch = J.branch_of[g.slot(g.parent[k])];
      if (branch < 0) branch = branches++;
    }
  }
  J.branch.resize(static_cast<std::size_t>(branches));
}

/// C^T J C from the rows of J.
void set_dense(const Tree& tree, const PackedTree& t, PackedMatrix& J) {
  J.dense.setZero();
  for (const PackedGroup& g : t.groups) {
    packed::multiply_lu(g, J);
    packed::add_to_diagonal(g, J);
  }
  for_each_pair(t, [&](int j, int i, long entry) {
    const Drive &dj = tree.drive[j], &di = tree.drive[i];
    const double scale = di.multiplier * dj.multiplier;
    const double lower = number(J.lower, entry);
    const double upper = J.symmetric ? lower : number(J.upper, entry);
    J.dense(di.velocity, dj.velocity) += scale * upper;
    if (i != j) J.dense(dj.velocity, di.velocity) += scale * lower;
  });
}

bool factorize_dense(const Tree& tree, const PackedTree& t, const Packed& w, double tau,
                     PackedMatrix& J) {
  set_dense(tree, t, J);
  if (packed::set_coupled(t, w, tau, J)) packed::add_coupled(J);
  J.lu.compute(J.dense);
  const auto pivots = J.lu.matrixLU().diagonal().array();
  return pivots.isFinite().all() && (pivots.abs() > 0).all();
}

}  // namespace

PackedMatrix::PackedMatrix(const Tree& tree, const PackedTree& packed)
    : path(saltus::packed::make_path<18>(packed)) {
  const std::size_t n = static_cast<std::size_t>(packed.slots / lanes);
  s_t.resize(n);
  u_w.resize(n);
  inverse.resize(n);
  x.resize(n);
  added.reserve(n);
  const bool may_be_dense = !packed.one_to_one || packed.dense_arcs;
  const std::size_t rows =
      static_cast<std::size_t>(may_be_dense ? packed.row_blocks : packed.lu_row_blocks);
  lower.resize(rows);
  upper.resize(rows);
  if (!packed.balls.empty()) {
    ball.resize(n);
    ball_k.resize(n);
  }
  if (has_sweep(packed)) prepare_sweep(packed, *this);
  if (!may_be_dense) return;
  dense.setIdentity(tree.n_v, tree.n_v);
  solution.setZero(tree.n_v);
  lu.compute(dense);  // allocates here, so that factorize does not
}

bool factorize(const Tree& tree, const PackedTree& t, const Packed& w, double tau,
               PackedMatrix& J) {
  J.symmetric = tau == 0;
  if (J.symmetric) {
    packed::set_mass_generators(t, w, J);
  } else {
    packed::set_generators(t, w, tau, J);
    packed::set_ball_generators(t, w, tau, J);
  }
  packed::set_own_pivots(t, w, tau, J);
  J.is_coupled = false;
  J.is_dense = !t.one_to_one || (t.dense_arcs && tau > 0);
  if (J.is_dense) return factorize_dense(tree, t, w, tau, J);
  for (const PackedGroup& g : t.groups) {
    if (!g.sweep) {
      packed::multiply_lu(g, J);
      packed::add_to_diagonal(g, J);
    }
    if (!(g.sweep ? packed::factorize_sweep(g, J) : packed::eliminate_lu(g, J))) return false;
  }
  return packed::factorize_coupled(tree, t, w, tau, J);
}

namespace {

/// K x of one ball.
Vec3 times_K(const PackedMatrix& J, const PackedBall& ball, const Vec3& x) {
  return Eigen::Map<const Mat3, 0, Eigen::Stride<3 * lanes, lanes>>(at(J.ball, ball.slot[2])) * x;
}

/// x <- A^T x at balls, A from number `first` of J.ball.
void pull_back(const PackedTree& t, const PackedMatrix& J, int first, VecX& x) {
  if (J.symmetric) return;
  for (const PackedBall& ball : t.balls) {
    const double* A = at(J.ball, ball.slot[2]) + first * lanes;
    const Eigen::Map<const Mat3, 0, Eigen::Stride<3 * lanes, lanes>> map(A);
    x.segment<3>(ball.velocity) = (map.transpose() * x.segment<3>(ball.velocity)).eval();
  }
}

}  // namespace

void solve_scaled(const Tree& tree, const PackedTree& t, PackedMatrix& J, VecX& x) {
  if (J.is_dense) {
    J.solution = J.lu.solve(x);
    x = J.solution;
    return;
  }
  for (int i = 0; i < tree.joints(); ++i) *at(J.x, t.slot[i]) = x[i];
  for (const PackedGroup& g : t.groups) {
    g.sweep ? packed::solve_sweep(g, J) : packed::solve_lu(g, J);
  }
  for (int i = 0; i < tree.joints(); ++i) x[i] = *at(J.x, t.slot[i]);
  packed::solve_coupled(J, x);
}

void solve(const Tree& tree, const PackedTree& t, PackedMatrix& J, VecX& x) {
  for (const PackedBall& ball : t.balls) {
    if (J.symmetric) break;
    x.segment<3>(ball.velocity) = times_K(J, ball, x.segment<3>(ball.velocity));
  }
  solve_scaled(tree, t, J, x);
}

// J^T has the generators s and t in each other's place, and so gains and rows, lower and upper.
void solve_transposed(const Tree& tree, const PackedTree& t, PackedMatrix& J, VecX& x) {
  if (J.is_dense) {
    J.solution = J.lu.transpose().solve(x);
    x = J.solution;
    return;
  }
  packed::solve_coupled_transposed(J, x);
  const auto exchange = [&J] {
    std::swap(J.s, J.t);
    std::swap(J.gain, J.row);
    if (!J.symmetric) std::swap(J.lower, J.upper);
  };
  for (int i = 0; i < tree.joints(); ++i) *at(J.x, t.slot[i]) = x[i];
  exchange();
  for (const PackedGroup& g : t.groups) {
    g.sweep ? packed::solve_sweep(g, J, true) : packed::solve_lu(g, J);
  }
  exchange();
  for (int i = 0; i < tree.joints(); ++i) x[i] = *at(J.x, t.slot[i]);
}

void pull_back_end(const PackedTree& t, const PackedMatrix& J, VecX& x) { pull_back(t, J, 0, x); }

void pull_back_end_tree(const PackedTree& t, int tree, const PackedMatrix& J, double* x) {
  if (J.symmetric) return;
  const PackedPlace& place = t.trees[tree];
  const PackedGroup& g = t.groups[place.group];
  for (const int k : g.balls) {
    const double* K = at(J.ball, g.slot(k + 2) + place.lane);
    const Eigen::Map<const Mat3, 0, Eigen::Stride<3 * lanes, lanes>> map(K);
    const Vec3 pulled = map.transpose() * Eigen::Map<const Vec3>(x + k);
    Eigen::Map<Vec3>(x + k) = pulled;
  }
}

void pull_back_middle(const PackedTree& t, const PackedMatrix& J, VecX& x) {
  pull_back(t, J, 9, x);
}

void solve_tree(const PackedTree& t, int tree, PackedMatrix& J, double* x) {
  const PackedPlace& place = t.trees[tree];
  const PackedGroup& g = t.groups[place.group];
  for (const int k : g.balls) {
    if (J.symmetric) break;
    const PackedBall ball{{0, 0, g.slot(k + 2) + place.lane}, 0, 0};
    const Vec3 scaled = times_K(J, ball, Eigen::Map<const Vec3>(x + k));
    Eigen::Map<Vec3>(x + k) = scaled;
  }
  if (!g.sweep) {
    packed::solve_lane(g, place.lane, J, x);
    return;
  }
  for (int k = 0; k < g.positions; ++k) *at(J.x, g.slot(k)) = x[k];
  packed::solve_sweep(g, J);
  for (int k = 0; k < g.positions; ++k) x[k] = *at(J.x, g.slot(k));
}

}  // namespace saltus
