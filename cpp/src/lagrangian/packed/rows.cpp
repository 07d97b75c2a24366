// Theory, section 2: the Hessian of T in (v, q) is X_i^T Y_j, X = [S W], Y = [U F], for i above j.
#include "saltus/lagrangian/packed_rows.hpp"

#include "lagrangian/packed/ball.hpp"
#include "lagrangian/packed/path.hpp"

namespace saltus {
namespace packed {
namespace {

struct Row {
  double *vv, *qq, *vq, *qv;
};

SALTUS_INLINE Row row_of(SecondPartials& out, long block) {
  return {out.L_vv[block].x[0], out.L_qq[block].x[0], out.L_vq[block].x[0], out.L_qv[block].x[0]};
}

SALTUS_INLINE void multiply(V6 S, V6 W, V6 U, V6 F, V3 G, const Row& row, int l) {
  row.vv[l] = dot(S, U);
  row.qq[l] = dot(W, F) + dot(S.w, G);
  row.vq[l] = dot(S, F);
  row.qv[l] = dot(W, U);
}

SALTUS_INLINE void multiply_one_tree(const PackedGroup& g, const Packed& w, SecondPartials& out) {
  for (int k = 0; k < g.positions; ++k) {
    const Block<12>* path = path_to(g, w.S_W, k, out.path);
    const double* Y = at(w.U_F_G, g.slot(k));
    const V6 U = load6(Y, 0), F = load6(Y, 6);
    const V3 G = load3(Y, 12);
    for (int b = 0; b * lanes <= g.level[k]; ++b) {
      const double* X = path[b].x[0];
      const Row row = row_of(out, g.row[k] + b);
      SALTUS_LANES
      for (int l = 0; l < lanes; ++l) {
        multiply(load6(X + l, 0), load6(X + l, 6), U, F, G, row, l);
      }
    }
  }
}

SALTUS_INLINE void multiply_equal_trees(const PackedGroup& g, const Packed& w,
                                        SecondPartials& out) {
  for (int k = 0; k < g.positions; ++k) {
    for (int i = k; i >= 0; i = g.parent[i]) {
      for (int b = 0; b < g.width / lanes; ++b) {
        const double* X = w.S_W[g.slot(i) / lanes + b].x[0];
        const double* Y = w.U_F_G[g.slot(k) / lanes + b].x[0];
        const Row row = row_of(out, g.row[k] + g.level[i] * (g.width / lanes) + b);
        SALTUS_LANES
        for (int l = 0; l < lanes; ++l) {
          multiply(load6(X + l, 0), load6(X + l, 6), load6(Y + l, 0), load6(Y + l, 6),
                   load3(Y + l, 12), row, l);
        }
      }
    }
  }
}

SALTUS_CLONES void multiply_all(const PackedTree& t, const Packed& w, SecondPartials& out) {
  for (const PackedGroup& g : t.groups) {
    if (g.width == 1) {
      multiply_one_tree(g, w, out);
    } else {
      multiply_equal_trees(g, w, out);
    }
  }
}

/// What is below the diagonal within balls: there a joint is above those that the rows have above.
void set_ball_pairs(const PackedGroup& g, const Packed& w, SecondPartials& out) {
  for (const int k : g.balls) {
    for (int lane = 0; lane < g.trees; ++lane) {
      double* qq = at(out.L_qq_lower, g.slot(k + 2) + lane);
      int next = 0;
      for (int j = 1; j < 3; ++j) {
        const double* X = at(w.S_W, g.slot(k + j) + lane);
        for (int i = 0; i < j; ++i) {
          const double* Y = at(w.U_F_G, g.slot(k + i) + lane);
          const V6 S = load6(X, 0), W = load6(X, 6), F = load6(Y, 6);
          const long entry = g.row[k + j] * lanes + g.level[k + i] * g.width + lane;
          out.L_qv[entry / lanes].x[0][entry % lanes] = dot(S, F);
          qq[lanes * next++] = dot(W, F) + dot(S.w, load3(Y, 12));
        }
      }
    }
  }
}

}  // namespace
}  // namespace packed

SecondPartials::SecondPartials(const PackedTree& tree) : path(packed::make_path<12>(tree)) {
  for (PackedRows* rows : {&L_vv, &L_qq, &L_vq, &L_qv}) {
    rows->resize(static_cast<std::size_t>(tree.row_blocks));
  }
  if (!tree.balls.empty()) L_qq_lower.resize(static_cast<std::size_t>(tree.slots / lanes));
}

void multiply_pairs(const PackedTree& t, const Packed& w, SecondPartials& out) {
  packed::multiply_all(t, w, out);
  for (const PackedGroup& g : t.groups) packed::set_ball_pairs(g, w, out);
}

}  // namespace saltus
