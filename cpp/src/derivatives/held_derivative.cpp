#include "derivatives/held_derivative.hpp"

#include <Eigen/QR>

namespace saltus {
namespace {

void start_rows(const std::vector<TapeRow>& told, int n, HeldRows& out) {
  out.gaps.resize(static_cast<std::size_t>(n));
  out.lambda.resize(n);
  for (int k = 0; k < n; ++k) out.lambda[k] = told[static_cast<std::size_t>(k)].lambda;
}

void set_gap_of(const ModelData& model, const Kinematics& kin, const TapeRow& row,
                GapDerivative& out) {
  if (row.is_frozen) {
    set_gap_derivative(model, kin, row.frozen, out);
  } else {
    set_gap_derivative(model, kin, row.pair, out);
  }
}

/// z.p += lambda dN.
void add_turned(const HeldRows& rows, Tangent& z) {
  for (Eigen::Index k = 0; k < rows.size(); ++k) {
    add_gradient_change(rows.gaps[static_cast<std::size_t>(k)], z.q, rows.lambda[k], z.p);
  }
}
void pull_turned(const HeldRows& rows, Tangent& z) {
  for (Eigen::Index k = 0; k < rows.size(); ++k) {
    add_gradient_covector(rows.gaps[static_cast<std::size_t>(k)], z.p, rows.lambda[k], z.q);
  }
}

/// Redundant contacts share what they do together.
void factor(const MatX& W, HeldRows& out) {
  Eigen::CompleteOrthogonalDecomposition<MatX> factors;
  factors.setThreshold(1e-11);
  factors.compute(W);
  out.W_inverse = factors.pseudoInverse();
}

void set_held_arc(const ModelData& model, const TapeArc& told, FlownArc& out) {
  HeldArc& held = out.held;
  start_rows(told.held, told.n_held, held.rows);
  const Eigen::Index m = held.rows.size();
  if (m == 0) return;
  const Eigen::Index n = model.tree.n_v;
  for (MatX* each : {&held.E, &held.R_q, &held.R_p}) each->resize(n, m);
  Kinematics kin(model.tree);
  set_configuration(model.tree, told.q_end, kin);
  GapDerivative end;
  for (Eigen::Index k = 0; k < m; ++k) {
    set_gap_of(model, kin, told.held[static_cast<std::size_t>(k)], end);
    held.E.col(k) = end.n;
  }
  set_configuration(model.tree, told.q, kin);
  const VecX none = VecX::Zero(n);
  for (Eigen::Index k = 0; k < m; ++k) {
    GapDerivative& gap = held.rows.gaps[static_cast<std::size_t>(k)];
    set_gap_of(model, kin, told.held[static_cast<std::size_t>(k)], gap);
    Tangent z{none, gap.n};
    push_forward(model, out.arc, none, 0, z);
    held.R_q.col(k) = z.q;
    held.R_p.col(k) = z.p;
  }
  factor(held.E.transpose() * held.R_q, held.rows);
}

}  // namespace

void set_flown_arc(const ModelData& model, const Tape& tape, const TapeArc& told, FlownArc& out) {
  set_arc_derivative(model, tape, told, out.arc);
  set_held_arc(model, told, out);
  out.kick.rows.lambda.resize(0);
  if (told.n_kick == 0) return;
  if (!out.node) out.node = std::make_unique<NodeDerivative>(model);
  out.node->t = told.t + told.tau;
  out.node->q = told.q_end;
  set_node_derivative(model, tape, out.node->t, told.q_end, told.v, out.node->motion);
  set_kick(model, tape, told.kick, told.n_kick, told.p_end, *out.node, out.kick);
}

void set_kick(const ModelData& model, const Tape& tape, const std::vector<TapeRow>& told,
              int n_rows, const VecX& p, NodeDerivative& node, KickDerivative& out) {
  start_rows(told, n_rows, out.rows);
  const Eigen::Index m = out.rows.size();
  if (m == 0) return;
  const Eigen::Index n = model.tree.n_v;
  out.of_q.resize(n, m);
  out.of_p.resize(n, m);
  set_configuration(model.tree, node.q, node.kin);
  Tangent motion;
  set_flow(model, tape, p, node, motion);
  MatX N(n, m);
  for (Eigen::Index k = 0; k < m; ++k) {
    GapDerivative& gap = out.rows.gaps[static_cast<std::size_t>(k)];
    set_gap_of(model, node.kin, told[static_cast<std::size_t>(k)], gap);
    N.col(k) = gap.n;
    VecX w = gap.n;
    solve_scaled(model.tree, model.packed, node.motion.s.J, w);
    multiply_by_transposed(model.tree, model.packed, node.motion.s.w, node.zero, w, node.product);
    VecX of_q = -node.product.by_q;
    add_gradient_covector(gap, motion.q, 1, of_q);
    out.of_q.col(k) = of_q;
    out.of_p.col(k) = w;
  }
  factor(N.transpose() * out.of_p, out.rows);
}

void push_flown(const ModelData& model, FlownArc& flown, const VecX& dQ, double dtau, Tangent& z) {
  const HeldArc& held = flown.held;
  add_turned(held.rows, z);
  push_forward(model, flown.arc, dQ, dtau, z);
  if (held.rows.size() > 0) {
    const VecX dlambda = -(held.rows.W_inverse * (held.E.transpose() * z.q));
    z.q += held.R_q * dlambda;
    z.p += held.R_p * dlambda;
  }
  push_kick(flown.kick, z);
}

double pull_flown(const ModelData& model, FlownArc& flown, VecX& Q, Tangent& z,
                  ParameterGradient* to) {
  const HeldArc& held = flown.held;
  const VecX residual = pull_kick(flown.kick, z);
  if (to != nullptr && residual.size() > 0) {
    add_kick_gradient(model, flown.kick, residual, flown.node->motion, *to);
  }
  if (held.rows.size() > 0) {
    const VecX of_lambda = held.R_q.transpose() * z.q + held.R_p.transpose() * z.p;
    z.q -= held.E * (held.rows.W_inverse.transpose() * of_lambda);
  }
  Q.setZero();
  const double of_tau = pull_back(model, flown.arc, Q, z);
  if (to != nullptr) add_arc_gradient(model, flown.arc, Q, *to);
  pull_turned(held.rows, z);
  return of_tau;
}

void push_kick(const KickDerivative& kick, Tangent& z) {
  if (kick.rows.size() == 0) return;
  add_turned(kick.rows, z);
  const VecX dlambda =
      -(kick.rows.W_inverse * (kick.of_q.transpose() * z.q + kick.of_p.transpose() * z.p));
  for (Eigen::Index k = 0; k < kick.rows.size(); ++k) {
    z.p += dlambda[k] * kick.rows.gaps[static_cast<std::size_t>(k)].n;
  }
}

VecX pull_kick(const KickDerivative& kick, Tangent& z) {
  if (kick.rows.size() == 0) return {};
  VecX of_lambda(kick.rows.size());
  for (Eigen::Index k = 0; k < kick.rows.size(); ++k) {
    of_lambda[k] = kick.rows.gaps[static_cast<std::size_t>(k)].n.dot(z.p);
  }
  const VecX residual = kick.rows.W_inverse.transpose() * of_lambda;
  z.q -= kick.of_q * residual;
  z.p -= kick.of_p * residual;
  pull_turned(kick.rows, z);
  return residual;
}

void add_kick_gradient(const ModelData& model, const KickDerivative& kick, const VecX& residual,
                       const ArcDerivative& motion, ParameterGradient& to) {
  const VecX none = VecX::Zero(model.tree.n_v), y = kick.of_p * residual;
  add_gradient(model, motion.s.w, none, y, 1, to);
}

}  // namespace saltus
