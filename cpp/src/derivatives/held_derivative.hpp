// Contacts that are held closed: in an arc, and by a kick at a node (theory, D6).
//
// The impulses lambda of an arc act along the gradients C at its start, and its end keeps the gaps
// at 0. With the arc's own derivative linear in z = (dq, dp), and R its answer to dp = C,
//
//   z.p += lambda dC,   z <- arc z,   z += R dlambda    so that  E.dq = 0 at the end
//
// A kick, p+ = p + N^T lambda with N M^-1 p+ = 0, has
//
//   dp += lambda dN,   N M^-1 N^T dlambda = -[dN v+ + N M^-1 (dp - L_vq(q, v+) dq)],   dp += N
//   dlambda
#pragma once

#include <memory>

#include "derivatives/impulse_derivative.hpp"
#include "derivatives/parameters.hpp"

namespace saltus {

/// Rows that push together. Redundant ones share what they do: W^+ has least norm.
struct HeldRows {
  std::vector<GapDerivative> gaps;  ///< where they push
  VecX lambda;                      ///< (m)
  MatX W_inverse;                   ///< (m, m)

  Eigen::Index size() const { return lambda.size(); }
};

struct HeldArc {
  HeldRows rows;
  MatX E;         ///< (n_v, m) gradients at the end
  MatX R_q, R_p;  ///< (n_v, m)
};

struct KickDerivative {
  HeldRows rows;
  MatX of_q, of_p;  ///< (n_v, m) of the right-hand side, before its sign
};

/// An arc with what held it, and the kick at its end.
struct FlownArc {
  explicit FlownArc(const ModelData& model) : arc(model) {}
  ArcDerivative arc;
  HeldArc held;
  KickDerivative kick;
  std::unique_ptr<NodeDerivative> node;  ///< of the kick, where one has been
};

/// Writes all of `out`. @throws ModelError as set_arc_derivative
void set_flown_arc(const ModelData& model, const Tape& tape, const TapeArc& told, FlownArc& out);

/// Of the kick by the first n rows at node.q, after which the momenta are p.
void set_kick(const ModelData& model, const Tape& tape, const std::vector<TapeRow>& rows, int n,
              const VecX& p, NodeDerivative& node, KickDerivative& out);

void push_flown(const ModelData& model, FlownArc& arc, const VecX& dQ, double dtau, Tangent& z);
/// @param to parameters, or nullptr
double pull_flown(const ModelData& model, FlownArc& arc, VecX& Q, Tangent& z,
                  ParameterGradient* to);

void push_kick(const KickDerivative& kick, Tangent& z);
/// @return (m) what the rows' right-hand sides are multiplied by
VecX pull_kick(const KickDerivative& kick, Tangent& z);
/// What a kick adds by the inertias that it meets; `motion` is that after it.
void add_kick_gradient(const ModelData& model, const KickDerivative& kick, const VecX& residual,
                       const ArcDerivative& motion, ParameterGradient& to);

}  // namespace saltus
