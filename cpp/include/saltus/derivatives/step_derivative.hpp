// Derivatives of a step, through its impacts: exact, for one or two times what the step cost.
//
// Theory, D. A step is a row of arcs and impacts, and its derivative the product of theirs. When a
// gap closes depends on the start, and so does what is left of the step after it:
//
//   arc to a closing gap   dz <- A dz, then with b = (q_tau, p_tau) of its end
//                          sigma = -n.dq / n.b_q,  dz += b sigma,  time left -= sigma
//   impulse                dp += n dlambda + lambda dn
//   arc to the end         with dtau the change of the time left
//
// Where several contacts close at one instant a trajectory near by resolves them at instants of
// their own, in an order that depends on where it is: the derivative is piecewise linear, one
// selection an order. It is that of the step's own order, unless another is asked for; the verdict
// (Smoothness) says what that is worth. Nothing is smoothed or clipped.
//
// Directions of q are along velocities, and those of a ball R -> exp(eta) R in the axes of its
// placement; p is the momentum. A step of arcs alone is symplectic in them:
// D^T Omega(p_end) D = Omega(p), Omega = [[-[p]x, -1], [1, 0]] with [p]x of balls, else 0.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "saltus/model/model.hpp"
#include "saltus/variational/stepper.hpp"

namespace saltus {

/// What a derivative is worth.
enum class Smoothness {
  smooth,           ///< one derivative in all directions
  selection,        ///< of one order of several impacts; others differ by `spread`
  one_sided,        ///< contacts only just touch, stick or slide; an impact is at the step's end
  order_dependent,  ///< the outcome depends on the order: the derivative is of one side of a jump
  grazing,          ///< an impact so weak that it is lost with a change of the start by `depth`
};

/// "smooth", ...
SALTUS_EXPORT std::string smoothness_name(Smoothness smoothness);

/// A direction of a step's inputs; or a covector of them. Empty vectors are 0.
struct StepDirection {
  VecX q;            ///< (n_v) of the start, along velocities
  VecX p;            ///< (n_v) of the start
  VecX control;      ///< (n_u)
  VecX qfrc;         ///< (n_v) [N m | N] of forces on the coordinates
  double h = 0;      ///< [s]
  VecX restitution;  ///< (impacts) of each impact, all its contacts alike
  VecX friction;     ///< (rubbing) of each pair in StepDerivatives::rubbing
  MatX forces;       ///< (wrenches, 3) [N] of the force of each wrench that was applied
  MatX torques;      ///< (wrenches, 3) [N m] of its torque; both in the axes that it has
};

/// What happens where a pair touches, as a covector has it.
struct PairGradient {
  int pair;            ///< its number
  double restitution;  ///< by e; 0 of what does not rebound
  double friction;     ///< by mu; 0 of what sticks
};

/// A covector of what the model is made of.
struct ModelGradient {
  /// (links, 10) of a link's own mass, first moment m c and inertia about its frame's origin, xx xy
  /// xz yy yz zz, in its frame; 0 of links fixed to the world. Compensation of gravity stays.
  MatX inertia;
  VecX stiffness;  ///< (n_v) [N m/rad | N/m] of joints' linear springs
  VecX rest;       ///< (n_v) [rad | m] where these are at rest
  VecX damping;    ///< (n_v) [N m s/rad | N s/m]
  VecX armature;   ///< (n_v) [kg m^2 | kg]
  /// (n_u, 4) gain, bias, bias_l and bias_v of each actuator (force_model.hpp); 0 where it pushes
  /// all it can.
  MatX actuators;
  MatX springs;  ///< (springs between points, 2) [N/m], [m] by stiffness and length
  VecX dampers;  ///< (dampers between points) [N s/m]
  /// (joints, 3) by where each joint's frame is in its parent link's, in the axes of that link;
  /// 0 of fixed ones.
  MatX placements;
  std::vector<PairGradient> pairs;  ///< that rebound or rub, by their numbers; of others 0
};

/// Of the state that a step ends in.
struct StateDirection {
  VecX q;  ///< (n_v) along velocities
  VecX p;  ///< (n_v)
};

/// An impact as its derivative sees it.
struct ImpactDerivative {
  double t;                ///< [s]
  std::vector<int> pairs;  ///< in the order of the impulses
  double spread;           ///< largest difference of A by another order, relative to its own
  double depth;            ///< [m] how far the weakest impulse's gap would close without it
  std::vector<int> weak;   ///< pairs that touch and neither approached nor leave
};

/// Dense, for people and small models. Rows q, then p, of the state that the step ends in.
struct StepDerivative {
  MatX A;                                      ///< (2 n_v, 2 n_v) by q and p
  MatX B;                                      ///< (2 n_v, n_u) by the controls
  MatX qfrc;                                   ///< (2 n_v, n_v) by forces on the coordinates
  VecX h;                                      ///< (2 n_v) by the step's duration
  MatX restitution;                            ///< (2 n_v, impacts)
  MatX friction;                               ///< (2 n_v, rubbing) by each pair's friction
  std::vector<int> rubbing;                    ///< numbers of these pairs
  MatX forces;                                 ///< (2 n_v, 3 wrenches) by each one's force
  MatX torques;                                ///< (2 n_v, 3 wrenches) by each one's torque
  Smoothness smoothness = Smoothness::smooth;  ///< what all this is worth
  std::vector<ImpactDerivative> impacts;       ///< in order
};

/// The derivative along one order of the impacts of one instant.
struct Selection {
  int impact;              ///< index in StepDerivative::impacts
  std::vector<int> pairs;  ///< in the order of the impulses
  VecX p;                  ///< (n_v) after them
  MatX A;                  ///< (2 n_v, 2 n_v); empty where p is another than the step's
};

/// Owns a copy of the model and its working memory. Not thread-safe.
class SALTUS_EXPORT StepDerivatives {
 public:
  /// With room for a step's products.
  explicit StepDerivatives(const Model& model, const StepOptions& options = {});
  ~StepDerivatives();
  /// The other one is of no use any more.
  StepDerivatives(StepDerivatives&&) noexcept;
  /// Likewise.
  StepDerivatives& operator=(StepDerivatives&&) noexcept;

  /// Takes up the tape of a step (Stepper::tape): evaluates its arcs again, and factors them.
  /// @throws ModelError that names what of the step has no derivative
  void linearize(const Tape& tape);
  /// Numbers of the pairs that push with friction in the step.
  const std::vector<int>& rubbing() const;

  /// The direction of the step's end, in O(n).
  /// @throws ModelError where an array does not fit
  StateDirection jvp(const StepDirection& direction);
  /// The covector of the step's inputs, in O(n).
  StepDirection vjp(const StateDirection& covector);
  /// The same, with the gradient by the model; O(n) more.
  StepDirection vjp(const StateDirection& covector, ModelGradient& by_model);
  /// All of it: 2 n_v + n_u + ... products.
  StepDerivative derivative();
  /// A and B alone.
  void derivative(MatX& A, MatX& B);
  /// The one-sided derivative along a direction, by the order that trajectories there have.
  StateDirection directional(const StepDirection& direction);
  /// The second derivative of covector.(q, p) of the step's end along a direction, in O(n): what
  /// vjp changes by. Of smooth steps, one arc without contacts, and of models without balls.
  /// @throws ModelError that names what of the step or the model has none
  StepDirection hvp(const StateDirection& covector, const StepDirection& direction);
  /// The same for all directions of q, p, the controls and h: (2 n_v + n_u + 1) squared, symmetric.
  MatX hessian(const StateDirection& covector);
  /// All orders of the impacts of each instant with several contacts.
  /// @param most of each impact
  std::vector<Selection> selections(int most = 1000);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace saltus
