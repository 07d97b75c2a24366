#include "plain/arc_matrix.hpp"

#include <cmath>

namespace saltus::plain {
namespace {

Vec9 nine(const Vec6& a, const Vec3& b) {
  Vec9 x;
  x.head<6>() = a;
  x.tail<3>() = b;
  return x;
}

/// Adds a joint's P, less what its own row takes out, to its parent's. P of a leaf is zero and is
/// never touched: `loaded` tells.
template <int N>
void load_parent(const ArcMatrix::Row& r, const Mat9& P, ArcMatrix::Row& parent, Mat9& P_parent) {
  auto to = P_parent.topLeftCorner<N, N>();
  if (r.loaded && parent.loaded) {
    to += P.topLeftCorner<N, N>();
  } else if (r.loaded) {
    to = P.topLeftCorner<N, N>();
  } else if (!parent.loaded) {
    to.setZero();
  }
  const Eigen::Matrix<double, N, 1> row = r.row.head<N>() * r.inverse_D;
  to.noalias() -= r.gain.head<N>() * row.transpose();
  parent.loaded = true;
}

/// s, t, w, u of the header; gain and row begin as w and u.
void set_generators(const JointMotion& m, const JointComposite& c, double tau, ArcMatrix::Row& r) {
  const double half = tau / 2, quarter = -tau * tau / 4;
  r.s = nine(m.S + half * m.W, angular(m.S));
  r.t = nine(m.S - half * m.W, quarter * angular(m.S));
  r.gain = nine(c.U + half * c.F, c.G);
  r.row = nine(c.U - half * c.F, quarter * c.G);
}

/// The same at tau = 0, where the last three of t and u vanish and nothing reaches those of s and
/// w.
void set_generators(const JointMotion& m, const JointComposite& c, ArcMatrix::Row& r) {
  r.s = r.t = nine(m.S, Vec3::Zero());
  r.gain = r.row = nine(c.U, Vec3::Zero());
}

/// N = 9, or 6 for the mass matrix.
template <int N>
bool factorize_sweep(const Tree& tree, const Kinematics& kin, const Composite& comp, double tau,
                     ArcMatrix& J) {
  for (ArcMatrix::Row& r : J.joint) r.loaded = false;
  for (int i = tree.joints() - 1; i >= 0; --i) {
    ArcMatrix::Row& r = J.joint[i];
    const Mat9& P = J.P[i];
    if constexpr (N == 9) {
      set_generators(kin.joint[i], comp.joint[i], tau, r);
    } else {
      set_generators(kin.joint[i], comp.joint[i], r);
    }
    if (r.loaded) {
      const auto block = P.topLeftCorner<N, N>();
      r.gain.head<N>().noalias() += block * r.s.head<N>();
      r.row.head<N>().noalias() += block.transpose() * r.t.head<N>();
    }
    const double D = r.t.head<N>().dot(r.gain.head<N>());
    r.inverse_D = 1 / D;  // before the return: it tells which pivot failed
    if (!(std::abs(D) > 0) || !std::isfinite(D)) return false;
    if (tree.parent[i] < 0) continue;
    load_parent<N>(r, P, J.joint[tree.parent[i]], J.P[tree.parent[i]]);
  }
  return true;
}

void solve_sweep(const Tree& tree, ArcMatrix& J, Eigen::Ref<VecX> x) {
  for (Vec9& c : J.c) c.setZero();
  for (int i = tree.joints() - 1; i >= 0; --i) {
    const ArcMatrix::Row& r = J.joint[i];
    J.e[i] = x[i] - r.t.dot(J.c[i]);
    if (tree.parent[i] >= 0) {
      J.c[tree.parent[i]] += J.c[i] + r.gain * (J.e[i] * r.inverse_D);
    }
  }
  for (int i = 0; i < tree.joints(); ++i) {
    const ArcMatrix::Row& r = J.joint[i];
    const int parent = tree.parent[i];
    if (parent < 0) {
      x[i] = J.e[i] * r.inverse_D;
      J.a[i] = r.s * x[i];
    } else {
      x[i] = (J.e[i] - r.row.dot(J.a[parent])) * r.inverse_D;
      J.a[i] = J.a[parent] + r.s * x[i];
    }
  }
}

}  // namespace

ArcMatrix::ArcMatrix(const Tree& tree)
    : joint(tree.parent.size()),
      P(tree.parent.size()),
      c(tree.parent.size()),
      a(tree.parent.size()),
      e(tree.joints()) {
  if (tree.one_to_one) return;
  dense.setIdentity(tree.n_v, tree.n_v);
  lu.compute(dense);  // allocates here, so that factorize does not
}

bool factorize(const Tree& tree, const Kinematics& kin, const Composite& comp, double tau,
               ArcMatrix& J) {
  if (tree.one_to_one) {
    return tau == 0 ? factorize_sweep<6>(tree, kin, comp, tau, J)
                    : factorize_sweep<9>(tree, kin, comp, tau, J);
  }
  J.dense.setZero();
  add_dense(tree, kin, comp, tau, J.dense);
  J.lu.compute(J.dense);
  const auto pivots = J.lu.matrixLU().diagonal().array();
  return pivots.isFinite().all() && (pivots.abs() > 0).all();
}

void solve(const Tree& tree, ArcMatrix& J, Eigen::Ref<VecX> x) {
  if (tree.one_to_one) {
    solve_sweep(tree, J, x);
  } else {
    J.e.head(x.size()) = J.lu.solve(x);
    x = J.e.head(x.size());
  }
}

void add_dense(const Tree& tree, const Kinematics& kin, const Composite& comp, double tau,
               MatX& out) {
  const double half = tau / 2, quarter = tau * tau / 4;
  for (int j = 0; j < tree.joints(); ++j) {
    const JointComposite& c = comp.joint[j];
    const Drive& dj = tree.drive[j];
    const Vec6 plus = c.U + half * c.F, minus = c.U - half * c.F;
    for (int i = j; i >= 0; i = tree.parent[i]) {
      const JointMotion& m = kin.joint[i];
      const Drive& di = tree.drive[i];
      const double scale = di.multiplier * dj.multiplier;
      const double gravity = quarter * angular(m.S).dot(c.G);
      out(di.velocity, dj.velocity) += scale * ((m.S - half * m.W).dot(plus) - gravity);
      if (i != j) {
        out(dj.velocity, di.velocity) += scale * ((m.S + half * m.W).dot(minus) - gravity);
      }
    }
  }
}

}  // namespace saltus::plain
