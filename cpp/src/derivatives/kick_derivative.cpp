#include "derivatives/kick_derivative.hpp"

#include <Eigen/QR>

namespace saltus {
namespace {

using Mode = KickContact::Mode;

int rates_of(const KickContact& c) {
  return c.mode == Mode::sticks || c.mode == Mode::slides ? 3 : 1;
}

/// Rows of one contact; along a direction they are one, n + mu d.
void add_rows(const KickContact& contact, int index, KickDerivative& out, std::vector<double>& P) {
  for (int i = 0; i < rates_of(contact); ++i) {
    out.contact_of.push_back(index);
    out.row_of.push_back(i);
    P.push_back(contact.P[i]);
  }
}

bool is_along(const KickDerivative& kick, Eigen::Index c) {
  return kick.contacts[static_cast<std::size_t>(kick.contact_of[c])].mode == Mode::along;
}

/// Calls f(frame, row, weight) for the rows that column c is made of.
template <class F>
void for_each_row(const KickDerivative& kick, Eigen::Index c, const F& f) {
  const auto k = static_cast<std::size_t>(kick.contact_of[static_cast<std::size_t>(c)]);
  const KickContact& contact = kick.contacts[k];
  f(kick.frames[k], kick.row_of[static_cast<std::size_t>(c)], 1.0);
  if (!is_along(kick, c)) return;
  for (int i = 1; i < 3; ++i) f(kick.frames[k], i, contact.P[i] / contact.P[0]);
}

void set_columns(const ModelData& model, ArcDerivative& motion, KickDerivative& out) {
  const Eigen::Index n = model.tree.n_v, N = out.size();
  for (MatX* each : {&out.C, &out.of_q, &out.of_p}) each->setZero(n, N);
  for (Eigen::Index c = 0; c < N; ++c) {
    VecX column = VecX::Zero(n);
    for_each_row(out, c, [&](const FrameDerivative& frame, int i, double weight) {
      column += weight * frame.row[i];
    });
    out.C.col(c) = column;
    // the rate that a column meets is that of its row: n, where it pushes along a direction
    const auto k = static_cast<std::size_t>(out.contact_of[static_cast<std::size_t>(c)]);
    VecX w = out.frames[k].row[out.row_of[static_cast<std::size_t>(c)]];
    solve_scaled(model.tree, model.packed, motion.s.J, w);
    out.of_p.col(c) = w;
    multiply_by_transposed(model.tree, model.packed, motion.s.w, VecX::Zero(n), w, motion.product);
    VecX q = -motion.product.by_q;
    add_row_covector(out.frames[k], out.row_of[static_cast<std::size_t>(c)], motion.v, 1, q);
    out.of_q.col(c) = q;
  }
}

/// Equations of one contact, whose first row is `at`.
void add_equations(const KickContact& contact, Eigen::Index at, const Vec3& u, Eigen::Index& extra,
                   MatX& N, MatX& K, MatX& X) {
  if (contact.is_given) {
    K(at, at) = 1;
    X(at, extra++) = 1;
  } else {
    N(at, at) = 1;
  }
  if (contact.mode == Mode::along) extra += 2;
  if (rates_of(contact) == 1) return;
  if (contact.mode == Mode::sticks) {
    N(at + 1, at + 1) = N(at + 2, at + 2) = 1;
    return;
  }
  add_sliding(contact.friction, contact.P[0], u.tail<2>(), at, N, K);
}

Eigen::Index extras_of(const std::vector<KickContact>& contacts) {
  Eigen::Index extra = 0;
  for (const KickContact& each : contacts) extra += each.is_given + 2 * (each.mode == Mode::along);
  return extra;
}

void set_system(const ModelData& model, KickDerivative& out) {
  const Eigen::Index N = out.size(), n_extra = extras_of(out.contacts);
  MatX by_u = MatX::Zero(N, N), by_P = by_u, X = MatX::Zero(N, n_extra);
  out.direct.setZero(model.tree.n_v, n_extra);
  Eigen::Index extra = 0;
  for (Eigen::Index c = 0; c < N; ++c) {
    if (out.row_of[static_cast<std::size_t>(c)] != 0) continue;
    const auto k = static_cast<std::size_t>(out.contact_of[static_cast<std::size_t>(c)]);
    const KickContact& contact = out.contacts[k];
    const Eigen::Index first = extra + contact.is_given;
    Vec3 u;
    for (int i = 0; i < 3; ++i) u[i] = out.frames[k].row[i].dot(out.v);
    add_equations(contact, c, u, extra, by_u, by_P, X);
    if (contact.mode != Mode::along) continue;
    for (int i = 0; i < 2; ++i) {
      out.direct.col(first + i) = contact.friction * contact.P[0] * out.frames[k].row[i + 1];
    }
  }
  const MatX W = out.of_p.transpose() * out.C;
  Eigen::CompleteOrthogonalDecomposition<MatX> factors;
  factors.setThreshold(1e-11);
  factors.compute(by_u * W + by_P);
  const MatX S = factors.pseudoInverse();
  out.S_X = S * X;
  out.S_N = S * by_u;
}

}  // namespace

KickContact::Mode mode_of(const Vec3& P, double friction) {
  if (!(friction > 0)) return Mode::frictionless;
  return P.tail<2>().norm() < friction * P[0] * (1 - 1e-9) ? Mode::sticks : Mode::slides;
}

void add_sliding(double friction, double P_n, const Eigen::Vector2d& g_t, Eigen::Index at, MatX& N,
                 MatX& K) {
  const double speed = g_t.norm();
  const Eigen::Vector2d d = g_t / speed;
  const Eigen::Matrix2d across = Eigen::Matrix2d::Identity() - d * d.transpose();
  K.block<2, 2>(at + 1, at + 1).setIdentity();
  K.block<2, 1>(at + 1, at) = friction * d;
  N.block<2, 2>(at + 1, at + 1) = friction * P_n / speed * across;
}

void set_kick(const ModelData& model, const VecX& q, ArcDerivative& motion, KickDerivative& out) {
  out.v = motion.v;
  out.contact_of.clear();
  out.row_of.clear();
  out.frames.resize(out.contacts.size());
  Kinematics kin(model.tree);
  set_configuration(model.tree, q, kin);
  std::vector<double> P;
  for (std::size_t k = 0; k < out.contacts.size(); ++k) {
    const KickContact& contact = out.contacts[k];
    if (contact.joint >= 0) {
      set_joint_frame(model, contact.joint, out.frames[k]);
    } else {
      set_frame(model, kin, contact.pair, contact.frame, out.frames[k]);
    }
    add_rows(out.contacts[k], static_cast<int>(k), out, P);
  }
  out.P = Eigen::Map<const VecX>(P.data(), static_cast<Eigen::Index>(P.size()));
  if (out.size() == 0) return;
  set_columns(model, motion, out);
  set_system(model, out);
}

VecX push_kick(const KickDerivative& kick, const VecX& extra, Tangent& z) {
  if (kick.size() == 0) return {};
  for (Eigen::Index c = 0; c < kick.size(); ++c) {
    for_each_row(kick, c, [&](const FrameDerivative& frame, int i, double weight) {
      add_row_change(frame, i, z.q, weight * kick.P[c], z.p);
    });
  }
  if (extra.size() > 0) z.p += kick.direct * extra;
  VecX dP = -(kick.S_N * (kick.of_q.transpose() * z.q + kick.of_p.transpose() * z.p));
  if (extra.size() > 0) dP += kick.S_X * extra;
  z.p += kick.C * dP;
  return dP;
}

void pull_kick(const KickDerivative& kick, const VecX& P_hat, Tangent& z, VecX& extra,
               VecX& residual) {
  residual.resize(0);
  extra.resize(0);
  if (kick.size() == 0) return;
  VecX of_P = kick.C.transpose() * z.p;
  if (P_hat.size() > 0) of_P += P_hat;
  residual = kick.S_N.transpose() * of_P;
  z.q -= kick.of_q * residual;
  z.p -= kick.of_p * residual;
  if (kick.extra() > 0) extra = kick.S_X.transpose() * of_P + kick.direct.transpose() * z.p;
  for (Eigen::Index c = 0; c < kick.size(); ++c) {
    for_each_row(kick, c, [&](const FrameDerivative& frame, int i, double weight) {
      add_row_covector(frame, i, z.p, weight * kick.P[c], z.q);
    });
  }
}

}  // namespace saltus
