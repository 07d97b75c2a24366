#include "variational/impact/custom_law.hpp"

#include <Eigen/QR>
#include <sstream>

#include "saltus/lagrangian/partials.hpp"

namespace saltus {
namespace {

/// The impact as the user's law sees it. Dense, and allocated each time: laws in use are few.
ImpactProblem problem_of(const Scene& scene, const Node& node) {
  const ModelData& model = scene.model;
  const int m = node.touching;
  ImpactProblem out;
  out.t = node.t;
  out.q = node.q;
  out.p = node.p;
  out.v = node.v;
  out.M = mass_matrix(model.tree, model.packed, node.q);
  out.N.resize(m, model.tree.n_v);
  out.u.resize(m);
  out.restitution.resize(m);
  out.friction.resize(m);
  VecX row(model.tree.n_v);
  for (int i = 0; i < m; ++i) {
    const Contact& c = node.contacts[i];
    row.setZero();
    add(scene.trees, 1, c.n, row);
    out.N.row(i) = row;
    out.u[i] = c.u;
    out.restitution[i] = c.restitution;
    out.friction[i] = c.friction;
    out.pairs.push_back(node.pool.number(c.slot));
  }
  return out;
}

void check_answer(const ModelData& model, const Node& node, const ImpactProblem& problem,
                  const VecX& p) {
  std::ostringstream text;
  if (p.size() != problem.p.size()) {
    text << "returned " << p.size() << (p.size() == 1 ? " momentum" : " momenta")
         << "; the model has " << counted(problem.p.size(), "velocity");
  } else if (!p.allFinite()) {
    text << "returned a momentum that is not finite";
  } else {
    const VecX u = problem.N * problem.M.llt().solve(p);
    int worst = 0;
    // 1e-6 of the approach: a law in double precision comes to rest no better
    if (u.minCoeff(&worst) >= -1e-6 * problem.u.cwiseAbs().maxCoeff()) return;
    text << "leaves " << pair_name(model.shapes, node.pool[node.contacts[worst].slot])
         << " approaching with " << u[worst] << " m/s";
  }
  throw StepError(
      "the custom law at the impact at t = " + std::to_string(problem.t) + " s " + text.str(),
      problem.t, 0, 0);
}

}  // namespace

void obey_custom_law(const Scene& scene, Node& node, std::vector<Impulse>& impulses) {
  const ImpactProblem problem = problem_of(scene, node);
  const VecX p = scene.options.custom(problem);
  check_answer(scene.model, node, problem, p);
  // What of the jump lies along the normals is reported as impulses, the shortest there are.
  const MatX along = problem.N.transpose();
  const VecX lambda = along.completeOrthogonalDecomposition().solve(p - problem.p);
  for (int i = 0; i < node.touching; ++i) {
    if (std::abs(lambda[i]) > 1e-12 * lambda.norm()) impulses.push_back({i, lambda[i]});
  }
  node.p = p;
}

}  // namespace saltus
