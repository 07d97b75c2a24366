#include "derivatives/kick_derivative.hpp"

#include <Eigen/QR>

#include "derivatives/loop_rows.hpp"

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

/// Those of contacts that are given, and of friction: where the next one of each goes.
struct Extra {
  Eigen::Index given = 0, friction = 0;
};

/// N r + N W dP + K dP = X extra.
struct System {
  MatX W, N, K, X;
};

/// Tangential equations of one contact, whose first row is `at`.
void add_tangents(KickContact& contact, const Eigen::Vector2d& u_t, Eigen::Index at, Extra& extra,
                  KickDerivative& out, System& to) {
  const bool slides = contact.mode == Mode::slides;
  const Eigen::Matrix2d W = to.W.block<2, 2>(at + 1, at + 1);
  if (is_at_edge(contact.friction, contact.P, slides, u_t, W)) {
    contact.mode = Mode::sticks;
    out.is_at_edge = true;
  }
  if (contact.mode == Mode::sticks) {
    to.N(at + 1, at + 1) = to.N(at + 2, at + 2) = 1;
  } else {
    VecX F;
    add_sliding(contact.friction, contact.P[0], u_t, at, to.N, to.K, F);
    to.X.col(extra.friction) = F;
  }
  if (slides) ++extra.friction;
}

/// Friction along a direction that comes with the arc.
void add_along(const KickContact& contact, const FrameDerivative& frame, Extra& extra,
               KickDerivative& out) {
  for (int i = 1; i < 3; ++i) {
    out.direct.col(extra.given++) = contact.friction * contact.P[0] * frame.row[i];
    out.direct.col(extra.friction) += contact.P[i] / contact.friction * frame.row[i];
  }
  ++extra.friction;
}

void add_equations(Eigen::Index at, Extra& extra, KickDerivative& out, System& to) {
  const auto k = static_cast<std::size_t>(out.contact_of[static_cast<std::size_t>(at)]);
  KickContact& contact = out.contacts[k];
  const FrameDerivative& frame = out.frames[k];
  if (contact.is_given) {
    to.K(at, at) = 1;
    to.X(at, extra.given++) = 1;
  } else {
    to.N(at, at) = 1;
  }
  if (contact.mode == Mode::along) add_along(contact, frame, extra, out);
  if (rates_of(contact) == 1) return;
  const Eigen::Vector2d u_t(frame.row[1].dot(out.v), frame.row[2].dot(out.v));
  add_tangents(contact, u_t, at, extra, out, to);
}

/// @return numbers that are given
Eigen::Index list_extras(KickDerivative& out) {
  Eigen::Index given = 0;
  out.rubs.clear();
  for (const KickContact& each : out.contacts) {
    given += each.is_given + 2 * (each.mode == Mode::along);
    if (each.mode == Mode::slides || each.mode == Mode::along) out.rubs.push_back(each.number);
  }
  return given;
}

void set_system(const ModelData& model, KickDerivative& out) {
  const Eigen::Index N = out.size(), given = list_extras(out);
  const Eigen::Index n_extra = given + static_cast<Eigen::Index>(out.rubs.size());
  System system{out.of_p.transpose() * out.C, MatX::Zero(N, N), MatX::Zero(N, N),
                MatX::Zero(N, n_extra)};
  out.direct.setZero(model.tree.n_v, n_extra);
  Extra extra{0, given};
  for (Eigen::Index c = 0; c < N; ++c) {
    if (out.row_of[static_cast<std::size_t>(c)] == 0) add_equations(c, extra, out, system);
  }
  Eigen::CompleteOrthogonalDecomposition<MatX> factors;
  factors.setThreshold(1e-11);
  factors.compute(system.N * system.W + system.K);
  const MatX S = factors.pseudoInverse();
  out.S_X = S * system.X;
  out.S_N = S * system.N;
}

/// What is given, then what friction changes by.
VecX all_extra(const KickDerivative& kick, const VecX& given, const Rubbing& friction) {
  const bool has_friction = friction.value.size() > 0 && !kick.rubs.empty();
  if (given.size() == 0 && !has_friction) return {};
  VecX out = VecX::Zero(kick.extra());
  out.head(given.size()) = given;
  for (std::size_t k = 0; k < kick.rubs.size(); ++k) {
    out[kick.given() + static_cast<Eigen::Index>(k)] = friction.of(kick.rubs[k]);
  }
  return out;
}

}  // namespace

KickContact::Mode mode_of(const Vec3& P, double friction) {
  if (!(friction > 0)) return Mode::frictionless;
  return P.tail<2>().norm() < friction * P[0] * (1 - 1e-9) ? Mode::sticks : Mode::slides;
}

bool is_at_edge(double friction, const Vec3& P, bool slides, const Eigen::Vector2d& g_t,
                const Eigen::Matrix2d& W) {
  constexpr double small = 1e-6;
  const Eigen::Vector2d P_t = P.tail<2>();
  if (slides) return g_t.norm() <= small * (W * P_t).norm();
  return P_t.norm() >= (1 - small) * friction * P[0];
}

void add_sliding(double friction, double P_n, const Eigen::Vector2d& g_t, Eigen::Index at, MatX& N,
                 MatX& K, VecX& F) {
  const double speed = g_t.norm();
  const Eigen::Vector2d d = g_t / speed;
  const Eigen::Matrix2d across = Eigen::Matrix2d::Identity() - d * d.transpose();
  K.block<2, 2>(at + 1, at + 1).setIdentity();
  K.block<2, 1>(at + 1, at) = friction * d;
  N.block<2, 2>(at + 1, at + 1) = friction * P_n / speed * across;
  F.setZero(N.rows());
  F.segment<2>(at + 1) = -P_n * d;
}

void set_kick(const ModelData& model, const VecX& q, ArcDerivative& motion, KickDerivative& out) {
  out.v = motion.v;
  out.is_at_edge = false;
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
    } else if (contact.loop >= 0) {
      set_loop_row(model, kin, contact.loop, out.frames[k]);
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

VecX push_kick(const KickDerivative& kick, const VecX& given, const Rubbing& friction, Tangent& z) {
  if (kick.size() == 0) return {};
  const VecX extra = all_extra(kick, given, friction);
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
               VecX& residual, Rubbing& friction) {
  residual.resize(0);
  extra.resize(0);
  if (kick.size() == 0) return;
  VecX of_P = kick.C.transpose() * z.p;
  if (P_hat.size() > 0) of_P += P_hat;
  residual = kick.S_N.transpose() * of_P;
  z.q -= kick.of_q * residual;
  z.p -= kick.of_p * residual;
  if (kick.extra() > 0) extra = kick.S_X.transpose() * of_P + kick.direct.transpose() * z.p;
  for (std::size_t k = 0; k < kick.rubs.size(); ++k) {
    friction.add(kick.rubs[k], extra[kick.given() + static_cast<Eigen::Index>(k)]);
  }
  for (Eigen::Index c = 0; c < kick.size(); ++c) {
    for_each_row(kick, c, [&](const FrameDerivative& frame, int i, double weight) {
      add_row_covector(frame, i, z.p, weight * kick.P[c], z.q);
    });
  }
}

}  // namespace saltus
