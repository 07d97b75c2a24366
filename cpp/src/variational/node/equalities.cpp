#include "variational/node/equalities.hpp"

#include <algorithm>
#include <limits>

#include "saltus/tree/coordinates.hpp"
#include "variational/node/node.hpp"

namespace saltus {

NodeEqualities::NodeEqualities(const ModelData& model)
    : some(model.equalities.rows > 0),
      values(model.tree.n_v, model.equalities.rows),
      joints(joints_read(model.tree, model.equalities)) {
  if (!some) return;
  solver = EqualitySolver(model.tree.n_v, model.equalities.rows);
  set_locks(model, solver);
  for (VecX* each : {&rate, &rate_size, &impulse}) each->setZero(model.equalities.rows);
}

/// An inertia as large as those there are.
double lock_of(const ModelData& model) {
  double most = 0;
  for (const Link& link : model.links) {
    most = std::max({most, link.mass, link.inertia.I_J.cwiseAbs().maxCoeff()});
  }
  return most > 0 ? most : 1;
}

VecX locks_of(const ModelData& model) {
  VecX out;
  for (const Equality& e : model.equalities.all) {
    if (e.type != LoopType::prescribed) continue;
    if (out.size() == 0) out.setZero(model.tree.n_v);
    const Drive& drive = model.tree.drive[e.a.joint];
    out[drive.velocity] += drive.multiplier * drive.multiplier * lock_of(model);
  }
  return out;
}

void set_locks(const ModelData& model, EqualitySolver& solver) {
  for (const Equality& e : model.equalities.all) {
    if (e.type == LoopType::prescribed) solver.lock[e.first] = lock_of(model);
  }
}

bool hold_loops(const Scene& scene, Node& node) {
  const ModelData& model = scene.model;
  NodeEqualities& loops = node.loops;
  set_equalities(model.tree, model.equalities, node.kin, node.q, node.t, loops.values);
  const Columns& A = loops.values.A;
  EqualitySolver& solver = loops.solver;
  solver.C = A;
  for (Eigen::Index k = 0; k < A.cols(); ++k) {
    node.column = A.col(k);
    solve(model.tree, model.packed, node.M, node.column);
    solver.Y.col(k) = node.column;
  }
  if (!solver.factorize()) return false;
  loops.rate = -loops.values.drive;
  loops.rate.noalias() += A.transpose() * node.v;
  loops.rate_size = loops.values.drive.cwiseAbs();
  loops.rate_size.noalias() += A.cwiseAbs().transpose() * node.v.cwiseAbs();
  solver.meet(loops.values.drive, node.v);
  node.p.noalias() += A * solver.mu;
  loops.impulse = solver.mu;
  return true;
}

void hold_velocity(Node& node) {
  NodeEqualities& loops = node.loops;
  loops.solver.meet(loops.values.drive, node.v);
  node.p.noalias() += loops.values.A * loops.solver.mu;
  loops.impulse += loops.solver.mu;
}

void take_momentum(const Scene& scene, Node& node) {
  node.v = node.p;
  solve(scene.model.tree, scene.model.packed, node.M, node.v);
  hold_velocity(node);
}

bool close_near(const Scene& scene, const Node& node, double t, VecX& q, Node& scratch) {
  const ModelData& model = scene.model;
  constexpr int most_iterations = 20;
  EqualityValues& values = scratch.loops.values;
  EqualitySolver& solver = scratch.loops.solver;
  solver.Y = node.loops.solver.Y;
  VecX dq = VecX::Zero(model.tree.n_v);
  double before = std::numeric_limits<double>::infinity();
  for (int k = 0; k < most_iterations; ++k) {
    set_configuration(model.tree, q, scratch.kin);
    set_equalities(model.tree, model.equalities, scratch.kin, q, t, values);
    const double open = (values.h.array().abs() / values.size.array().max(1e-300)).maxCoeff();
    constexpr double rounding = 1e-15;
    if (open <= rounding || (open <= 1e-12 && open > before / 4)) return true;
    if (!(open < before)) return false;
    before = open;
    solver.C = values.A;
    if (!solver.factorize()) return false;
    dq.setZero();
    values.h = -values.h;
    solver.meet(values.h, dq);
    integrate(model.tree, q, 1, dq, q);
  }
  return false;
}

}  // namespace saltus
