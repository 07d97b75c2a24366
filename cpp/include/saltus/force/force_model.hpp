// Forces on the coordinates that no potential of the bodies makes: damping, motors, servos.
//
// Theory, F1, F2. A force Q(q, v, u) is evaluated in the middle of an arc, with the control u held
// over the step, and enters the arc's equation with L_q. What acts through gears has a length and a
// rate of its own, l = sum of ratio q and l' = sum of ratio v, and pushes each coordinate with its
// ratio times
//
//   f = clip(gain clip(u) + bias_0 + bias_l l + bias_v l', +-effort)       MuJoCo's `general`
//
//   motor              gain 1, bias 0               u is the force
//   position servo     gain kp, bias_l -kp, bias_v -kd       u is the length to reach
//   velocity servo     gain kv, bias_v -kv          u is the rate to reach
//
// The actuators of one coordinate together push by `effort` of its joint at most; one over several
// coordinates has its own effort alone.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "saltus/force/force_function.hpp"
#include "saltus/force/point_damper.hpp"
#include "saltus/tree/tree.hpp"

namespace saltus {

/// How an actuator moves one coordinate.
struct Gear {
  int velocity;    ///< index in v
  int coordinate;  ///< the same coordinate in q
  double ratio;    ///< of the coordinate's rate in l'
};

/// One motor, servo or other force that is affine in l and l', see above.
struct Actuator {
  std::string name;                                         ///< of its control
  std::vector<Gear> gears;                                  ///< what it moves
  double gain = 1;                                          ///< of f by u
  double bias = 0;                                          ///< of f, constant
  double bias_l = 0;                                        ///< of f by l
  double bias_v = 0;                                        ///< of f by l'
  double effort = std::numeric_limits<double>::infinity();  ///< [N m | N] of f
  double lower = -std::numeric_limits<double>::infinity();  ///< of u
  double upper = std::numeric_limits<double>::infinity();   ///< likewise

  /// Moves one coordinate.
  bool is_single() const { return gears.size() == 1; }
};

/// Frozen; written by build(). Vectors by velocity are empty where no coordinate has any.
struct ForceModel {
  VecX damping;   ///< (n_v) [N m s/rad | N s/m] >= 0; of a ball its three are equal
  VecX friction;  ///< (n_v) [N m | N] dry, 0 of balls
  VecX effort;    ///< (n_v) [N m | N] of all actuators of one coordinate; infinite where no limit
  std::vector<Actuator> actuators;       ///< in the order of the controls
  std::vector<PointDamper> dampers;      ///< between points of bodies
  std::vector<FunctionForce> functions;  ///< that users wrote

  /// Numbers of a control.
  int n_u() const { return static_cast<int>(actuators.size()); }
  /// Actuators over several coordinates.
  int n_coupled() const;
  /// Columns of Packed::coupled that dampers and functions take.
  int n_columns() const;
  /// True where steps evaluate forces even if nobody applies any.
  bool acts() const {
    return damping.size() > 0 || !actuators.empty() || !dampers.empty() || !functions.empty();
  }
};

/// A force on a body and a torque, in the world's axes or in the body's.
struct AppliedWrench {
  int joint = -1;               ///< of the tree, whose body it acts on
  Vec3 point_J = Vec3::Zero();  ///< [m] where, in that joint's frame
  Vec3 force = Vec3::Zero();    ///< [N]
  Vec3 torque = Vec3::Zero();   ///< [N m]
  bool in_body = false;         ///< axes of the joint's frame, which turn with the body
  /// In that frame, those that derivatives by force and torque are along, where these are in_body.
  Mat3 axes = Mat3::Identity();
};

/// What drives a model over a step.
struct ForceInput {
  VecX control;                         ///< (n_u) or empty: 0
  VecX qfrc;                            ///< (n_v) [N m | N] or empty: 0
  std::vector<AppliedWrench> wrenches;  ///< on bodies

  /// True where more than controls is told.
  bool acts() const { return qfrc.size() > 0 || !wrenches.empty(); }
};

/// An actuator of one coordinate, side by side with the others: most are.
struct SingleActuator {
  int index;       ///< its number
  int velocity;    ///< as in Gear, and so on as in Actuator
  int coordinate;  ///< likewise
  double ratio;    ///< likewise
  double gain;     ///< likewise
  double bias;     ///< likewise
  double bias_l;   ///< likewise
  double bias_v;   ///< likewise
  double effort;   ///< likewise
  double lower;    ///< likewise
  double upper;    ///< likewise
};

/// Forces at one (q, v, u), with the slopes that Newton's method needs.
struct ForceValues {
  ForceValues() = default;
  /// Sized for a model.
  SALTUS_EXPORT ForceValues(const ForceModel& forces, int n_v);

  VecX Q;        ///< (n_v) the sum
  VecX size;     ///< (n_v) of the terms it is a sum of, for rounding
  VecX Q_q;      ///< (n_v) slope of each by its own coordinate
  VecX Q_v;      ///< (n_v) slope of each by its own velocity
  MatX coupled;  ///< (n_v, r) gears of the actuators over several coordinates
  VecX slope;    ///< (2 r) of these by l, by l'
  VecX effort;   ///< (n_u) f of each actuator, after all limits
  VecX rate;     ///< (n_u) l' of each
  VecX damping;  ///< (n_v) Q of damping alone, dampers included
  VecX single;   ///< (n_v) scratch: of single actuators before the joint's limit
  std::vector<SingleActuator> singles;  ///< as the model has them; written by the constructor
  std::vector<int> geared;              ///< the other actuators; likewise
  std::vector<ForceAnswer> answers;     ///< of the functions
};

/// Writes all of `out` but what is at points of bodies: wrenches and dampers. And but functions.
SALTUS_EXPORT void set_forces(const ForceModel& forces, const VecRef& q, const VecRef& v,
                              const ForceInput& input, ForceValues& out);

/// Asks all functions and adds what they answer.
/// @throws ModelError as `ask`, and what they throw
SALTUS_EXPORT void add_functions(const ForceModel& forces, const ForceMoment& now,
                                 ForceValues& out);

}  // namespace saltus
