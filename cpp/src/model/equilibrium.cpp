#include "saltus/model/equilibrium.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>
#include <sstream>

#include "saltus/model/check_derivatives.hpp"
#include "saltus/model/close_loops.hpp"
#include "saltus/tree/coordinates.hpp"

namespace saltus {
namespace {

constexpr int most_iterations = 300, most_halvings = 30;
constexpr double longest_step = 0.3;  ///< [rad | m] of a coordinate
constexpr double rounding = 1e-12;    ///< [rad | m] a step that is none

/// Generalized forces at rest, and minus their slopes.
struct Pull {
  VecX F;  ///< (n_v)
  MatX K;  ///< (n_v, n_v)
};

Pull pull_at(const Model& model, const VecX& q, const VecX& control) {
  const VecX still = VecX::Zero(model.n_v());
  const LagrangianPartials L = model.lagrangian(q, still);
  ForceValues forces(model->forces, model.n_v());
  ForceInput input;
  input.control = control;
  set_forces(model->forces, q, still, input, forces);
  add_functions(model->forces, {0, q, still}, forces);
  Pull out{L.L_q + forces.Q, -L.L_qq};
  out.K.diagonal() -= forces.Q_q;
  for (Eigen::Index r = 0; r < forces.coupled.cols(); ++r) {
    const VecX gears = forces.coupled.col(r);
    out.K -= forces.slope[2 * r] * gears * gears.transpose();
  }
  out.K = (0.5 * (out.K + out.K.transpose())).eval();
  return out;
}

/// What the loops' forces A mu add to the slopes: by differences, as h has no second partials here.
void add_curvature_of_loops(const Model& model, const VecX& q, const MatX& A, Pull& pull) {
  if (A.cols() == 0) return;
  const VecX mu = A.completeOrthogonalDecomposition().solve(-pull.F);
  constexpr double step = 1e-6;
  MatX bend(model.n_v(), model.n_v());
  for (int c = 0; c < model.n_v(); ++c) {
    const VecX unit = VecX::Unit(model.n_v(), c);
    const MatX more = loop_values(*model, model.integrate(q, step * unit)).A;
    const MatX less = loop_values(*model, model.integrate(q, -step * unit)).A;
    bend.col(c) = (more - less) * mu / (2 * step);
  }
  pull.F += A * mu;  // what the loops leave
  pull.K -= 0.5 * (bend + bend.transpose());
}

/// Velocities at a limit that the forces push beyond.
std::vector<int> pressed(const Model& model, const VecX& q, const VecX& F) {
  std::vector<int> out;
  for (const JointLimit& limit : model->limits) {
    const int c = model->tree.drive[static_cast<std::size_t>(limit.joint)].velocity;
    const double phi = limit.stop.side * (q[limit.coordinate] - limit.stop.bound);
    if (phi <= 1e-9 && limit.stop.side * F[c] < 0) out.push_back(c);
  }
  return out;
}

/// Newton's step in the directions that loops, limits and what is kept leave free.
struct FreeStep {
  VecX dq;
  double least = 0, most = 0;  ///< curvature along the direction where it is least; the greatest
  VecX softest;                ///< (n_v) that direction
};

FreeStep free_step(const Model& model, const VecX& q, const Pull& pull, const MatX& A,
                   const std::vector<int>& held) {
  const Eigen::LLT<MatX> llt(model.mass_matrix(q));
  const MatX U = llt.matrixU();
  MatX C(A.cols() + static_cast<Eigen::Index>(held.size()), A.rows());
  C.topRows(A.cols()) = A.transpose();
  for (std::size_t k = 0; k < held.size(); ++k) {
    C.row(A.cols() + static_cast<Eigen::Index>(k)) = VecX::Unit(A.rows(), held[k]);
  }
  // dq = U^-1 Z y, Z the null space of C U^-1: the metric of M, in which all kinds count alike
  MatX Z = MatX::Identity(A.rows(), A.rows());
  if (C.rows() > 0) {
    Eigen::ColPivHouseholderQR<MatX> qr(C.cols(), C.rows());
    qr.setThreshold(1e-10);
    qr.compute(U.transpose().triangularView<Eigen::Lower>().solve(C.transpose()));
    const MatX all = qr.householderQ() * Z;
    Z = all.rightCols(A.rows() - qr.rank());
  }
  const MatX T = U.triangularView<Eigen::Upper>().solve(Z);
  FreeStep out{VecX::Zero(A.rows()), 0, 0, VecX::Zero(A.rows())};
  if (T.cols() == 0) return out;
  const Eigen::SelfAdjointEigenSolver<MatX> curvature(T.transpose() * pull.K * T);
  const VecX& w = curvature.eigenvalues();
  out.least = w[0];
  out.most = w.cwiseAbs().maxCoeff();
  out.softest = T * curvature.eigenvectors().col(0);
  VecX y = curvature.eigenvectors().transpose() * (T.transpose() * pull.F);
  for (Eigen::Index k = 0; k < y.size(); ++k) {
    y[k] /= std::max(std::abs(w[k]), 1e-9 * out.most + 1e-300);
  }
  out.dq = T * (curvature.eigenvectors() * y);
  const double size = out.dq.cwiseAbs().maxCoeff();
  if (size > longest_step) out.dq *= longest_step / size;
  return out;
}

/// The part of the step that no limit ends, and the velocity that ends it, or -1.
struct Room {
  double part = 1;
  int stopped = -1;
};

Room room(const Model& model, const VecX& q, const VecX& dq) {
  Room out;
  for (const JointLimit& limit : model->limits) {
    const int c = model->tree.drive[static_cast<std::size_t>(limit.joint)].velocity;
    const double phi = limit.stop.side * (q[limit.coordinate] - limit.stop.bound);
    const double rate = limit.stop.side * dq[c];
    if (!(rate < -rounding && phi + rate < -rounding && -phi / rate < out.part)) continue;
    out = {std::max(0.0, -phi / rate), c};
  }
  return out;
}

[[noreturn]] void fail_falling(const Model& model, const VecX& softest) {
  Eigen::Index worst = 0;
  softest.cwiseAbs().maxCoeff(&worst);
  throw ModelError(
      "this equilibrium is no minimum: " + model->velocity_names[static_cast<std::size_t>(worst)] +
      " would fall away from it; start beside it");
}

}  // namespace

VecX equilibrium(const Model& model, const VecRef& start, const VecX& control,
                 const std::vector<int>& keep) {
  if (control.size() > 0) check_vector(control, model->forces.n_u(), "control", "actuators");
  VecX q = close_loops(model, start, keep);
  check_derivatives_once(model, q, 0);
  for (int k = 0; k < most_iterations; ++k) {
    const MatX A = loop_values(*model, q).A;
    Pull pull = pull_at(model, q, control);
    add_curvature_of_loops(model, q, A, pull);
    std::vector<int> held = pressed(model, q, pull.F);
    held.insert(held.end(), keep.begin(), keep.end());
    FreeStep step = free_step(model, q, pull, A, held);
    // what stands at its stop, and would be taken beyond by what the others do, stays for now
    for (int round = 0; round < model.n_v(); ++round) {
      const Room ahead = room(model, q, step.dq);
      if (ahead.stopped < 0 || ahead.part > 1e-9) break;
      held.push_back(ahead.stopped);
      step = free_step(model, q, pull, A, held);
    }
    if (step.dq.cwiseAbs().maxCoeff() <= rounding) {
      if (step.least < -1e-9 * step.most) fail_falling(model, step.softest);
      return q;
    }
    VecX dq = room(model, q, step.dq).part * step.dq;
    const double slope = pull.F.dot(dq);
    VecX q_new;
    for (int halving = 0; halving < most_halvings; ++halving, dq /= 2) {
      q_new = model.integrate(q, dq);
      if (A.cols() > 0) q_new = close_loops(model, q_new, keep);
      // downhill until the end, or not far up the other side
      if (pull_at(model, q_new, control).F.dot(dq) >= -0.5 * slope) break;
    }
    q = q_new;
  }
  throw ModelError("no equilibrium was found in " + std::to_string(most_iterations) +
                   " steps: something that moves may have nothing that holds it (neither spring, "
                   "servo, limit nor a lowest place)");
}

}  // namespace saltus
