#include "variational/arc/arc_loops.hpp"

#include "saltus/tree/coordinates.hpp"
#include "variational/arc/arc.hpp"

namespace saltus {
namespace {

/// C, Y and S. Needs the factors of J, and h's gradients at the end. @return false as factorize
bool set_solver(const ModelData& model, double tau, ArcScratch& s) {
  ArcLoops& loops = *s.loops;
  EqualitySolver& solver = loops.solver;
  for (Eigen::Index k = 0; k < solver.C.cols(); ++k) {
    s.x = loops.end.A.col(k);
    if (tau > 0) pull_back_end(model.packed, s.J, s.x);
    solver.C.col(k) = s.x;
    s.x = loops.A->col(k);
    solve(model.tree, model.packed, s.J, s.x);
    solver.Y.col(k) = s.x;
  }
  return solver.factorize();
}

}  // namespace

ArcLoops::ArcLoops(const ModelData& model)
    : end(model.tree.n_v, model.equalities.rows),
      solver(model.tree.n_v, model.equalities),
      joints(joints_read(model.tree, model.equalities)) {
  for (VecX* x : {&mu, &dmu, &rate}) x->setZero(model.equalities.rows);
  for (VecX* x : {&push, &size}) x->setZero(model.tree.n_v);
}

void add_push(const ArcProblem& a, ArcScratch& s, bool keep_scale) {
  ArcLoops& loops = *a.loops;
  loops.push.noalias() = *loops.A * loops.mu;
  s.r += loops.push;
  if (keep_scale) return;
  loops.size.setZero();
  for (Eigen::Index k = 0; k < loops.mu.size(); ++k) {
    loops.size += std::abs(loops.mu[k]) * loops.A->col(k).cwiseAbs();
  }
  s.scale += loops.size;
}

double loop_residual(const ModelData& model, const ArcProblem& a, const VecX& v, ArcScratch& s) {
  ArcLoops& loops = *a.loops;
  integrate(model.tree, a.q, a.tau, v, s.q);
  place_end(model, s.q, s);
  for (const int joint : loops.joints) {
    copy_pose(model.tree, model.packed, s.w_end, joint, s.kin_end);
  }
  set_equalities(model.tree, model.equalities, s.kin_end, s.q, a.t + a.tau, loops.end);
  constexpr double tiny = 1e-300;
  if (a.tau > 0) {
    loops.rate = -loops.end.h / a.tau;
    return (loops.end.h.array().abs() / (loops.end.size.array() + tiny)).maxCoeff();
  }
  loops.rate = loops.end.drive;
  loops.rate.noalias() -= loops.end.A.transpose() * v;
  const double size = v.norm() * loops.end.A.norm() + tiny;
  return loops.rate.cwiseAbs().maxCoeff() / size;
}

bool take_out_loops(const ModelData& model, const ArcProblem& a, ArcScratch& s) {
  ArcLoops& loops = *a.loops;
  if (!set_solver(model, a.tau, s)) return false;
  // J dv = r + A dmu; the lock is on J, and meets the change of the rates alone
  loops.solver.meet(loops.rate, s.dv);
  loops.dmu = loops.solver.mu;
  loops.mu += loops.dmu;
  return true;
}

void halve_step(ArcScratch& s) {
  s.dv /= 2;
  if (!s.loops) return;
  s.loops->dmu /= 2;
  s.loops->mu -= s.loops->dmu;
}

void hold_rate(const ModelData& model, const Arc& arc, ArcScratch& s, VecX& rate) {
  ArcLoops& loops = *s.loops;
  if (!set_solver(model, arc.tau, s)) return;
  if (!(arc.tau > 0)) return;
  loops.rate = loops.end.drive;
  loops.rate.noalias() -= loops.solver.C.transpose() * arc.v;
  loops.rate /= arc.tau;
  loops.solver.meet(loops.rate, rate);
}

}  // namespace saltus
