// Elimination from the leaves to the root, without fill.
//
// With rows of joint j over its ancestors i: lower[i] = J_ji, upper[i] = J_ij, D = J_jj, for every
// pair of ancestors b at or above a:
//
//   J_ab -= upper[a] lower[b] / D      J_ba -= lower[a] upper[b] / D
//
//   solve, leaves to root:  x_a -= upper[a] x_j / D
//   root to leaves:         x_j = (x_j - sum lower[a] x_a) / D
#include "lagrangian/packed/ball.hpp"
#include "lagrangian/packed/matrix.hpp"

namespace saltus::packed {
namespace {

/// lower[j] and upper[j] of the levels in one block.
template <bool symmetric>
SALTUS_INLINE void multiply(const double* s_t, const V6& u, const V3& u3, const V6& w, const V3& w3,
                            double* lower, double* upper) {
  SALTUS_LANES
  for (int l = 0; l < lanes; ++l) {
    if constexpr (symmetric) {
      lower[l] = dot(load6(s_t + l, 0), u);
    } else {
      lower[l] = dot(load6(s_t + l, 0), u) + dot(load3(s_t + l, 6), u3);
      upper[l] = dot(load6(s_t + l, 9), w) + dot(load3(s_t + l, 15), w3);
    }
  }
}

template <bool symmetric>
SALTUS_INLINE void multiply_one_tree(const PackedGroup& g, PackedMatrix& J) {
  for (int k = 0; k < g.positions; ++k) {
    const Block<18>* path = path_to(g, J.s_t, k, J.path);
    const double* u_w = at(J.u_w, g.slot(k));
    const V6 u = load6(u_w, 0), w = load6(u_w, 9);
    const V3 u3 = load3(u_w, 6), w3 = load3(u_w, 15);
    for (int b = 0; b * lanes <= g.level[k]; ++b) {
      multiply<symmetric>(path[b].x[0], u, u3, w, w3, J.lower[g.row[k] + b].x[0],
                          J.upper[g.row[k] + b].x[0]);
    }
  }
}

template <bool symmetric>
SALTUS_INLINE void multiply_equal_trees(const PackedGroup& g, PackedMatrix& J) {
  const int blocks = g.width / lanes;
  for (int k = 0; k < g.positions; ++k) {
    for (int i = k; i >= 0; i = g.parent[i]) {
      for (int b = 0; b < blocks; ++b) {
        const double* s_t = J.s_t[g.slot(i) / lanes + b].x[0];
        const double* u_w = J.u_w[g.slot(k) / lanes + b].x[0];
        double* lower = J.lower[g.row[k] + g.level[i] * blocks + b].x[0];
        double* upper = J.upper[g.row[k] + g.level[i] * blocks + b].x[0];
        SALTUS_LANES
        for (int l = 0; l < lanes; ++l) {
          lower[l] = dot(load6(s_t + l, 0), load6(u_w + l, 0));
          if constexpr (symmetric) continue;
          lower[l] += dot(load3(s_t + l, 6), load3(u_w + l, 6));
          upper[l] = dot(load6(s_t + l, 9), load6(u_w + l, 9)) +
                     dot(load3(s_t + l, 15), load3(u_w + l, 15));
        }
      }
    }
  }
}

/// to -= factor * from over the levels of one row.
SALTUS_INLINE void subtract(double factor, const Block<1>* from, int levels, Block<1>* to) {
  for (int b = 0; b * lanes < levels; ++b) {
    SALTUS_LANES
    for (int l = 0; l < lanes; ++l) to[b].x[0][l] -= factor * from[b].x[0][l];
  }
}

template <bool symmetric>
SALTUS_INLINE bool eliminate_one_tree(const PackedGroup& g, PackedMatrix& J) {
  for (int j = g.positions - 1; j >= 0; --j) {
    const Block<1>*lower = &J.lower[g.row[j]], *upper = &(symmetric ? J.lower : J.upper)[g.row[j]];
    const int level = g.level[j];
    const double D = lower[level / lanes].x[0][level % lanes];
    const double inverse = *at(J.inverse, g.slot(j)) = 1 / D;
    if (!is_pivot(D)) return false;
    int i = g.parent[j];
    for (int a = level - 1; a >= 0; --a, i = g.branched ? g.parent[i] : i - 1) {
      subtract(upper[a / lanes].x[0][a % lanes] * inverse, lower, a + 1, &J.lower[g.row[i]]);
      if constexpr (symmetric) continue;
      subtract(lower[a / lanes].x[0][a % lanes] * inverse, upper, a + 1, &J.upper[g.row[i]]);
    }
  }
  return true;
}

template <bool symmetric>
SALTUS_INLINE bool eliminate_equal_trees(const PackedGroup& g, PackedMatrix& J) {
  const int blocks = g.width / lanes;
  PackedRows& upper_rows = symmetric ? J.lower : J.upper;
  bool good = true;
  for (int j = g.positions - 1; j >= 0; --j) {
    for (int block = 0; block < blocks; ++block) {
      const Block<1>* lower = &J.lower[g.row[j] + block];
      const Block<1>* upper = &upper_rows[g.row[j] + block];
      const double* D = lower[g.level[j] * blocks].x[0];
      double* inverse = J.inverse[g.slot(j) / lanes + block].x[0];
      for (int l = 0; l < lanes; ++l) inverse[l] = 1 / D[l];
      for (int l = 0; l < lanes && block * lanes + l < g.trees; ++l) {
        good = good && is_pivot(D[l]);
      }
      int i = g.parent[j];
      for (int a = g.level[j] - 1; a >= 0; --a, i = g.parent[i]) {
        const double *lower_a = lower[a * blocks].x[0], *upper_a = upper[a * blocks].x[0];
        for (int b = 0; b <= a; ++b) {
          const double *lower_b = lower[b * blocks].x[0], *upper_b = upper[b * blocks].x[0];
          double* to_lower = J.lower[g.row[i] + b * blocks + block].x[0];
          double* to_upper = upper_rows[g.row[i] + b * blocks + block].x[0];
          SALTUS_LANES
          for (int l = 0; l < lanes; ++l) {
            to_lower[l] -= upper_a[l] * lower_b[l] * inverse[l];
            if constexpr (symmetric) continue;
            to_upper[l] -= lower_a[l] * upper_b[l] * inverse[l];
          }
        }
      }
    }
  }
  return good;
}

template <bool symmetric>
SALTUS_INLINE void solve_one_tree(const PackedGroup& g, PackedMatrix& J) {
  double* x = J.x[g.first / lanes].x[0];
  const auto above = [&g](int i) { return g.branched ? g.parent[i] : i - 1; };
  for (int j = g.positions - 1; j >= 0; --j) {
    const double* upper = (symmetric ? J.lower : J.upper)[g.row[j]].x[0];
    const double each = x[j] * *at(J.inverse, g.slot(j));
    int i = g.parent[j];
    for (int a = g.level[j] - 1; a >= 0; --a, i = above(i)) x[i] -= upper[a] * each;
  }
  for (int j = 0; j < g.positions; ++j) {
    const double* lower = J.lower[g.row[j]].x[0];
    double sum = x[j];
    int i = g.parent[j];
    for (int a = g.level[j] - 1; a >= 0; --a, i = above(i)) sum -= lower[a] * x[i];
    x[j] = sum * *at(J.inverse, g.slot(j));
  }
}

template <bool symmetric>
SALTUS_INLINE void solve_equal_trees(const PackedGroup& g, PackedMatrix& J) {
  const int blocks = g.width / lanes;
  Block<1>* x = &J.x[g.first / lanes];
  for (int j = g.positions - 1; j >= 0; --j) {
    int i = g.parent[j];
    for (int a = g.level[j] - 1; a >= 0; --a, i = g.parent[i]) {
      for (int b = 0; b < blocks; ++b) {
        const double* upper = (symmetric ? J.lower : J.upper)[g.row[j] + a * blocks + b].x[0];
        const double* inverse = J.inverse[g.slot(j) / lanes + b].x[0];
        const double* from = x[j * blocks + b].x[0];
        double* to = x[i * blocks + b].x[0];
        SALTUS_LANES
        for (int l = 0; l < lanes; ++l) to[l] -= upper[l] * inverse[l] * from[l];
      }
    }
  }
  for (int j = 0; j < g.positions; ++j) {
    for (int b = 0; b < blocks; ++b) {
      double* to = x[j * blocks + b].x[0];
      int i = g.parent[j];
      for (int a = g.level[j] - 1; a >= 0; --a, i = g.parent[i]) {
        const double* lower = J.lower[g.row[j] + a * blocks + b].x[0];
        const double* from = x[i * blocks + b].x[0];
        SALTUS_LANES
        for (int l = 0; l < lanes; ++l) to[l] -= lower[l] * from[l];
      }
      const double* inverse = J.inverse[g.slot(j) / lanes + b].x[0];
      SALTUS_LANES
      for (int l = 0; l < lanes; ++l) to[l] *= inverse[l];
    }
  }
}

}  // namespace

SALTUS_CLONES void multiply_lu(const PackedGroup& g, PackedMatrix& J) {
  if (g.width == 1) {
    J.symmetric ? multiply_one_tree<true>(g, J) : multiply_one_tree<false>(g, J);
  } else {
    J.symmetric ? multiply_equal_trees<true>(g, J) : multiply_equal_trees<false>(g, J);
  }
  if (!J.symmetric) set_ball_entries(g, J);
}

SALTUS_CLONES bool eliminate_lu(const PackedGroup& g, PackedMatrix& J) {
  if (g.width == 1) {
    return J.symmetric ? eliminate_one_tree<true>(g, J) : eliminate_one_tree<false>(g, J);
  }
  return J.symmetric ? eliminate_equal_trees<true>(g, J) : eliminate_equal_trees<false>(g, J);
}

SALTUS_CLONES void solve_lu(const PackedGroup& g, PackedMatrix& J) {
  if (g.width == 1) {
    J.symmetric ? solve_one_tree<true>(g, J) : solve_one_tree<false>(g, J);
  } else {
    J.symmetric ? solve_equal_trees<true>(g, J) : solve_equal_trees<false>(g, J);
  }
}

void solve_lane(const PackedGroup& g, int lane, PackedMatrix& J, double* x) {
  const PackedRows& upper = J.symmetric ? J.lower : J.upper;
  const auto entry = [&](int j, int level) { return g.row[j] * lanes + level * g.width + lane; };
  for (int j = g.positions - 1; j >= 0; --j) {
    const double each = x[j] * *at(J.inverse, g.slot(j) + lane);
    for (int i = g.parent[j]; i >= 0; i = g.parent[i]) {
      x[i] -= number(upper, entry(j, g.level[i])) * each;
    }
  }
  for (int j = 0; j < g.positions; ++j) {
    double sum = x[j];
    for (int i = g.parent[j]; i >= 0; i = g.parent[i]) {
      sum -= number(J.lower, entry(j, g.level[i])) * x[i];
    }
    x[j] = sum * *at(J.inverse, g.slot(j) + lane);
  }
}

}  // namespace saltus::packed
