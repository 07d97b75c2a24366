// The derivative of an impulse at a node (theory, D2), and of when it comes.
//
// With n = phi_q, w = M^-1 n, G = n.w, v before it and v_s = v + lambda / (1 + e) w,
//
//   dlambda = -(1+e)/G [(2 v_s - v).dn + w.(dp - L_vq(q, v_s) dq)] - (n.v/G) de
//   dp+     = dp + n dlambda + lambda dn        dn = phi_qq dq + (dq x n)/2 on balls
//
// of which all but dn is one covector. The impulse comes when its gap closes: along the motion
// (b_q, b_p) before it a time sigma = -n.dq / n.b_q later, dz += b sigma.
#pragma once

#include "derivatives/arc_derivative.hpp"

namespace saltus {

/// A contact at a node.
struct GapDerivative {
  VecX n;                       ///< (n_v) phi_q
  MatX H;                       ///< phi_qq among
  std::vector<int> velocities;  ///< these
  std::vector<int> balls;       ///< first velocities of the balls among them
};

void set_gap_derivative(const ModelData& model, const Kinematics& kin, const Pair& pair,
                        GapDerivative& out);
Pair pair_of(const ModelData& model, int number);
/// Of a pair by its number, at the configuration in `kin`.
void set_gap_derivative(const ModelData& model, const Kinematics& kin, int pair,
                        GapDerivative& out);

/// dn += factor (what dq makes of n).
void add_gradient_change(const GapDerivative& gap, const VecX& dq, double factor, VecX& dn);
/// Its transpose.
void add_gradient_covector(const GapDerivative& gap, const VecX& n_hat, double factor, VecX& q);

struct ImpulseDerivative {
  int contact = -1;  ///< index in the node's gaps
  double lambda = 0, restitution = 1;
  double u = 0, G = 0;  ///< gap rate before; n.M^-1 n
  VecX of_q, of_p;      ///< (n_v) dlambda by them
  VecX v_s, w;          ///< (n_v)
  Tangent flow;         ///< b before it
  double slope = 0;     ///< n.b_q
  double closing = 0;   ///< [m/s^2] second derivative of the gap along the motion before it
};

/// A node with closed contacts: all impulses are made here.
struct NodeDerivative {
  explicit NodeDerivative(const ModelData& model);
  double t = 0;
  VecX q;
  ArcDerivative motion;  ///< of no duration: M, and f at the last v
  Kinematics kin;
  std::vector<GapDerivative> gaps;
  std::vector<int> pairs;  ///< their numbers
  std::vector<double> restitution;
  Packed w;  ///< at (q, v_s)
  HessianProduct product;
  VecX v, zero;
};

/// @throws ModelError as set_arc_derivative
void set_node(const ModelData& model, const Tape& tape, const TapeImpact& impact,
              NodeDerivative& node);

/// Of the contact's impulse at momenta p, which it changes.
void set_impulse(const ModelData& model, const Tape& tape, int contact, VecX& p,
                 NodeDerivative& node, ImpulseDerivative& out);

/// First partials at (q, v_s), in node.w.
void evaluate_at_compression(const ModelData& model, const ImpulseDerivative& impulse,
                             NodeDerivative& node);

/// [m/s^2] Second derivative of the gap along node.motion.
double closing_of(const ModelData& model, const GapDerivative& gap, NodeDerivative& node);

/// The motion (M^-1 p, f) at the node.
void set_flow(const ModelData& model, const Tape& tape, const VecX& p, NodeDerivative& node,
              Tangent& flow);

/// z <- after the impulse.
void push_impulse(const GapDerivative& gap, const ImpulseDerivative& impulse, double de,
                  Tangent& z);
/// z <- before it. @return the covector of lambda
double pull_impulse(const GapDerivative& gap, const ImpulseDerivative& impulse, Tangent& z);

}  // namespace saltus
