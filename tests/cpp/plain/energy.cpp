#include "plain/energy.hpp"

namespace saltus::plain {

double potential_energy(const Tree& tree, const MassModel& mass, const Kinematics& kin) {
  double V = 0;
  for (int i = 0; i < tree.joints(); ++i) {
    const BodyInertia& body = mass.body[i];
    if (body.mass == 0) continue;
    const JointMotion& m = kin.joint[i];
    const Vec3 c_W = m.p + m.R * body.c_J + kin.origin[tree.root[i]];
    V -= body.mass * mass.gravity.dot(c_W);
  }
  return V;
}

// Row i of a symmetric-by-branch product collects its subtree through the sums of (U, F, G) x and
// its ancestors through the sums of (S, W) x:
//   (L_vv x)_i = S_i.sum U_j x_j                      + U_i.up S_k x_k
//   (L_vq x)_i = S_i.sum F_j x_j                      + U_i.up W_k x_k
//   (L_qv x)_i = W_i.sum U_j x_j                      + F_i.up S_k x_k
//   (L_qq x)_i = W_i.sum F_j x_j + S_i.sum G_j x_j    + F_i.up W_k x_k + G_i.up S_k x_k
void multiply_second_partials(const Tree& tree, const Kinematics& kin, const Composite& comp,
                              const VecRef& x, SecondPartialsTimes& out) {
  const int n = tree.joints();
  out.L_vv_x.resize(n);
  out.L_vq_x.resize(n);
  out.L_qv_x.resize(n);
  out.L_qq_x.resize(n);
  out.below.resize(n);
  out.above.resize(n);
  for (auto& sum : out.below) sum = {Vec6::Zero(), Vec6::Zero(), Vec3::Zero()};
  for (int i = n - 1; i >= 0; --i) {
    const JointMotion& m = kin.joint[i];
    const JointComposite& c = comp.joint[i];
    auto& sum = out.below[i];
    sum.U += c.U * x[i];
    sum.F += c.F * x[i];
    sum.G += c.G * x[i];
    out.L_vv_x[i] = m.S.dot(sum.U);
    out.L_vq_x[i] = m.S.dot(sum.F);
    out.L_qv_x[i] = m.W.dot(sum.U);
    out.L_qq_x[i] = m.W.dot(sum.F) + angular(m.S).dot(sum.G);
    if (tree.parent[i] < 0) continue;
    auto& up = out.below[tree.parent[i]];
    up.U += sum.U;
    up.F += sum.F;
    up.G += sum.G;
  }
  for (int i = 0; i < n; ++i) {
    const JointMotion& m = kin.joint[i];
    const JointComposite& c = comp.joint[i];
    auto& sum = out.above[i];
    sum = {m.S * x[i], m.W * x[i]};
    if (tree.parent[i] < 0) continue;
    const auto& up = out.above[tree.parent[i]];
    out.L_vv_x[i] += c.U.dot(up.S);
    out.L_vq_x[i] += c.U.dot(up.W);
    out.L_qv_x[i] += c.F.dot(up.S);
    out.L_qq_x[i] += c.F.dot(up.W) + c.G.dot(angular(up.S));
    sum.S += up.S;
    sum.W += up.W;
  }
}

}  // namespace saltus::plain
