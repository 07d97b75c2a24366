#include "derivatives/applied_derivative.hpp"

#include "lagrangian/packed/potentials.hpp"

namespace saltus {
namespace {

Vec3 point_of(const ModelData& model, const Packed& w, const AppliedWrench& at_body) {
  const int slot = model.packed.slot[static_cast<std::size_t>(at_body.joint)];
  Mat3 R;
  for (int c = 0; c < 3; ++c) R.col(c) = three(at(w.R, slot) + 3 * c * lanes);
  return three(at(w.p, slot)) + R * at_body.point_J;
}

/// Calls f(velocity, dP/dq of it) for the joints above the point.
template <class F>
void for_each_mover(const ModelData& model, const Packed& w, const AppliedWrench& at_body,
                    const F& f) {
  if (at_body.joint < 0) return;
  const Vec3 P = point_of(model, w, at_body);
  for (int i = at_body.joint; i >= 0; i = model.tree.parent[i]) {
    const double* S = at(w.S_W, model.packed.slot[i]);
    const Vec3 move = three(S + 3 * lanes) + three(S).cross(P);
    const Drive& drive = model.tree.drive[i];
    f(drive.velocity, Vec3(drive.multiplier * move));
  }
}

/// Q.(J_a - J_b)^T n.
double along(const Packed& w, const PackedPoint& a, const Vec3& P_a, const PackedPoint& b,
             const Vec3& P_b, const Vec3& n, const VecX& Q) {
  VecX push = VecX::Zero(Q.size()), size = push;
  add_pull(w, a, P_a, n, push, size);
  add_pull(w, b, P_b, -n, push, size);
  return push.dot(Q);
}

}  // namespace

void add_push(const ModelData& model, const Packed& w, const AppliedWrench& at_body,
              const Vec3& force, VecX& Q) {
  for_each_mover(model, w, at_body, [&](int c, const Vec3& move) { Q[c] += move.dot(force); });
}

Vec3 pull_push(const ModelData& model, const Packed& w, const AppliedWrench& at_body,
               const VecX& Q) {
  Vec3 out = Vec3::Zero();
  for_each_mover(model, w, at_body, [&](int c, const Vec3& move) { out += Q[c] * move; });
  return out;
}

void add_spring_gradient(const ModelData& model, const ArcDerivative& arc, const VecX& Q,
                         ParameterGradient& to) {
  const Packed& w = arc.s.w;
  const auto& springs = model.mass.potentials.springs;
  for (std::size_t k = 0; k < springs.size(); ++k) {
    const PackedSpring& s = model.packed.potentials->springs[k];
    const Packed::PlacedSpring& x = w.springs[k];
    if (!(x.d > 0)) continue;  // of length 0 it pulls nothing there; others have no step there
    const double push = along(w, s.a, x.P_a, s.b, x.P_b, x.r / x.d, Q);
    const auto row = static_cast<Eigen::Index>(k);
    to.springs(row, 0) -= (x.d - springs[k].length) * push;
    to.springs(row, 1) += springs[k].stiffness * push;
  }
  for (std::size_t k = 0; k < arc.s.dampers.size(); ++k) {
    const PlacedDamper& x = arc.s.dampers[k];
    const double push = along(w, x.a, x.P_a, x.b, x.P_b, x.n, Q);
    to.dampers[static_cast<Eigen::Index>(k)] -= x.n.dot(x.r_rate) * push;
  }
}

}  // namespace saltus
