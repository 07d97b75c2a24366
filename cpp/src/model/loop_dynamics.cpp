#include "saltus/model/loop_dynamics.hpp"

#include <cmath>
#include <sstream>

#include "model/assembly.hpp"
#include "saltus/model/close_loops.hpp"

namespace saltus {
namespace {

/// Of a state that was written with 8 digits, as a step takes it.
constexpr double rounding = 1e-7;

[[noreturn]] void refuse(const ModelData& model, int row, const std::string& what, double value,
                         const std::string& advice) {
  const std::string& name = equality_of(model, row).name;
  std::ostringstream text;
  text << "loop " << quoted(name) << " " << what << value << advice;
  throw ModelError(text.str(), "loop", name);
}

/// Checks that A^T x is `wanted`, to rounding.
void check_rates(const ModelData& model, const VecRef& x, const VecX& wanted, const char* what,
                 const std::string& advice, LoopDynamics& loops) {
  constexpr double tiny = 1e-12;  // [1/s | 1/s^2] the rounding of nothing
  const double most = x.size() > 0 ? x.cwiseAbs().maxCoeff() : 0;
  for (int k = 0; k < model.equalities.rows; ++k) {
    const auto row = loops.values.A.col(k);
    const double off = std::abs(row.dot(x) - wanted[k]);
    const double size = most * row.cwiseAbs().sum() + std::abs(wanted[k]);
    if (!(off <= rounding * size + tiny)) refuse(model, k, what, off, advice);
  }
}

}  // namespace

LoopDynamics::LoopDynamics(const ModelData& model)
    : kin(model.tree),
      values(model.tree.n_v, model.equalities.rows),
      solver(model.tree.n_v, model.equalities) {
  for (VecX* each : {&needed, &rates}) each->setZero(model.equalities.rows);
  column.setZero(model.tree.n_v);
}

void set_loops(const ModelData& model, const VecRef& q, const VecRef& v, double t,
               LoopDynamics& loops) {
  set_configuration(model.tree, q, loops.kin);
  set_velocity(model.tree, v, loops.kin);
  set_equalities(model.tree, model.equalities, loops.kin, q, t, loops.values);
  const std::string advice =
      "; close_loops(model, q, v, t=t) finds the nearest configuration and velocities that keep it "
      "closed";
  for (int k = 0; k < model.equalities.rows; ++k) {
    const double open = std::abs(loops.values.h[k]);
    if (!(open <= rounding * loops.values.size[k])) refuse(model, k, "is open by ", open, advice);
  }
  check_rates(model, v, loops.values.drive, "opens at a rate of ", " a second" + advice, loops);
  set_needed_accelerations(model.tree, model.equalities, loops.kin, v, t, loops.needed);
  for (const Equality& e : model.equalities.all) {
    if (e.type != LoopType::prescribed || std::isfinite(loops.needed[e.first])) continue;
    throw ModelError("the prescribed motion of " + quoted(e.name) +
                         " returns displacement and rate alone; accelerations take the third "
                         "number, that of the motion",
                     "loop", e.name);
  }
}

void check_accelerations(const ModelData& model, const VecRef& a, LoopDynamics& loops) {
  check_rates(model, a, loops.needed, "would open, its accelerations are off by ",
              " a second squared; those of accelerations() keep it closed", loops);
}

void factorize_loops(const ModelData& model, double t, PackedMatrix& M, LoopDynamics& loops) {
  loops.solver.C = loops.values.A;
  for (Eigen::Index k = 0; k < loops.solver.C.cols(); ++k) {
    loops.column = loops.values.A.col(k);
    solve(model.tree, model.packed, M, loops.column);
    loops.solver.Y.col(k) = loops.column;
  }
  if (loops.solver.factorize()) return;
  const int weak = std::max(0, loops.solver.weak_row);
  throw StepError("two motions branch at this configuration, loop " +
                      quoted(equality_of(model, weak).name) + " holds no single one",
                  t, 0, 0);
}

void hold_accelerations(LoopDynamics& loops, VecX& a) { loops.solver.meet(loops.needed, a); }

// forces = M w with A^T w = 0, so that M^-1 forces, and with it what loops push, are as without.
void take_out_loops(const ModelData& model, PackedMatrix& M, LoopDynamics& loops, VecX& forces) {
  loops.column = forces;
  solve(model.tree, model.packed, M, loops.column);
  loops.solver.hold(loops.column);
  forces.noalias() += loops.values.A * loops.solver.mu;
  for (const Equality& e : model.equalities.all) {
    if (e.type == LoopType::prescribed) forces[model.tree.drive[e.a.joint].velocity] = 0;
  }
}

}  // namespace saltus
