#include "variational/node/equalities.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saltus/tree/coordinates.hpp"
#include "variational/node/node.hpp"

namespace saltus {

NodeEqualities::NodeEqualities(const ModelData& model)
    : some(model.equalities.rows > 0), values(model.tree.n_v, model.equalities.rows) {
  if (!some) return;
  solver = EqualitySolver(model.tree.n_v, model.equalities);
  for (VecX* each : {&rate, &kick, &impulse}) each->setZero(model.equalities.rows);
}

/// Joints with dry friction that the loops hold: a row of theirs would be the rounding of nothing.
void note_still_joints(const Scene& scene, Node& node) {
  node.loops.still.assign(node.dry.size(), 0);
  for (std::size_t k = 0; k < node.dry.size(); ++k) {
    node.loops.still[k] = is_held_by_loops(scene, node.dry[k].n, node);
  }
}

bool is_held_by_loops(const Scene& scene, const ContactVector& row, Node& node) {
  constexpr double rounding = 1e-9;  // less is no motion, but the rounding of a solve
  node.column.setZero();
  add(scene.trees, 1, row, node.column);
  solve(scene.model.tree, scene.model.packed, node.M, node.column);
  const double free = dot(scene.trees, row, node.column);
  node.loops.solver.hold(node.column);
  return !(dot(scene.trees, row, node.column) > rounding * free);
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
  solver.meet(loops.values.drive, node.v);
  node.p.noalias() += A * solver.mu;
  loops.impulse = solver.mu;
  for (Eigen::Index k = 0; k < A.cols(); ++k) {
    const double own = std::abs(solver.C.col(k).dot(solver.Y.col(k)));
    loops.rate[k] = std::abs(solver.mu[k]) * own;
    loops.kick[k] = std::abs(solver.mu[k]) * std::sqrt(own);
  }
  note_still_joints(scene, node);
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
