#include "saltus/lagrangian/partials.hpp"

#include "saltus/lagrangian/arc_matrix.hpp"
#include "saltus/lagrangian/energy.hpp"

namespace saltus {
namespace {

/// Adds the four products of every pair of joints on a branch, i at or above j.
void add_pairs(const Tree& tree, const Kinematics& kin, const Composite& comp,
               LagrangianPartials& L) {
  for (int j = 0; j < tree.joints(); ++j) {
    const JointComposite& c = comp.joint[j];
    const int cj = tree.drive[j].coordinate;
    for (int i = j; i >= 0; i = tree.parent[i]) {
      const JointMotion& m = kin.joint[i];
      const int ci = tree.drive[i].coordinate;
      const double scale = tree.drive[i].multiplier * tree.drive[j].multiplier;
      const double vv = scale * m.S.dot(c.U);
      const double qq = scale * (m.W.dot(c.F) + angular(m.S).dot(c.G));
      L.L_vv(ci, cj) += vv;
      L.L_qq(ci, cj) += qq;
      L.L_vq(ci, cj) += scale * m.S.dot(c.F);
      if (i == j) continue;
      L.L_vv(cj, ci) += vv;
      L.L_qq(cj, ci) += qq;
      L.L_vq(cj, ci) += scale * m.W.dot(c.U);
    }
  }
}

}  // namespace

LagrangianPartials lagrangian(const Tree& tree, const MassModel& mass, const VecRef& q,
                              const VecRef& v) {
  Kinematics kin(tree);
  Composite comp(tree);
  set_configuration(tree, q, kin);
  set_velocity(tree, v, kin);
  first_pass(tree, mass, kin, comp);
  second_pass(tree, mass, kin, comp);

  const int n = tree.coordinates;
  LagrangianPartials L{0, VecX(n), VecX(n), MatX::Zero(n, n), MatX::Zero(n, n), MatX::Zero(n, n)};
  to_coordinates(tree, comp.L_q, L.L_q);
  to_coordinates(tree, comp.L_v, L.L_v);
  add_pairs(tree, kin, comp, L);
  L.value = 0.5 * v.dot(L.L_v) - potential_energy(tree, mass, kin);
  return L;
}

MatX mass_matrix(const Tree& tree, const MassModel& mass, const VecRef& q) {
  Kinematics kin(tree);
  Composite comp(tree);
  set_configuration(tree, q, kin);
  mass_pass(tree, mass, kin, comp);
  MatX M = MatX::Zero(tree.coordinates, tree.coordinates);
  add_dense(tree, kin, comp, 0, M);
  return M;
}

}  // namespace saltus
