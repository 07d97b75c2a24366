// The derivative of a step as a row of linear pieces, walked forwards and backwards.
#pragma once

#include <memory>

#include "derivatives/friction_derivative.hpp"
#include "saltus/derivatives/step_derivative.hpp"

namespace saltus {

/// An impact: its node, and its impulses in one order.
struct ImpactPieces {
  explicit ImpactPieces(const ModelData& model) : node(model) {}
  NodeDerivative node;
  std::vector<ImpulseDerivative> impulses;  ///< without friction
  std::vector<FrictionDerivative> rubbing;  ///< all, where there is some
  bool is_together = false;  ///< plastic: a kick, and when comes by the gap of `first`
  KickDerivative kick;
  int first = 0;  ///< index in the node's gaps
  Tangent flow;   ///< b before it
  double slope = 0;
  Tangent arrival;  ///< b of the arc that ends here; empty at an end of the step
  VecX p_before, p_after;
};

/// An arc that a gap ends without an impact.
struct Passing {
  int pair = -1;
  Kinematics kin;
  GapDerivative gap;
  Tangent arrival;
  double slope = 0;
};

struct StepProgram {
  enum class Kind {
    rest,    ///< arc: over the time that is left
    part,    ///< arc: a given part of the step
    to_gap,  ///< arc: of fixed duration, what comes next moves its end
    pass,    ///< a gap closes, and that is all
    impact,
  };
  struct Piece {
    Kind kind;
    int index;
    double part;
  };
  std::vector<Piece> pieces;
  // pools
  std::vector<std::unique_ptr<FlownArc>> arcs;
  std::vector<std::unique_ptr<ImpactPieces>> impacts;
  std::vector<Passing> passings;
  int n_arcs = 0, n_impacts = 0, n_passings = 0;

  bool has_rest = false;          ///< time may be left at the end, along
  bool has_match = false;         ///< an arc meets an energy
  EnergyGradient start;           ///< of the energy that is matched; empty where none is
  Tangent motion;                 ///< (v, f) there
  bool tells_time = true;         ///< no force is a function of time whose derivative is not told
  std::string timed_kind, timed;  ///< "force" or "joint", and the name of one that is
  Rubbing friction;               ///< of the pairs that rub
  VecX dQ, zero;                  ///< scratch
};

/// @throws ModelError as StepDerivatives::linearize
void set_program(const ModelData& model, const Tape& tape, StepProgram& program);

/// @throws ModelError where a force may be a function of time; `what` goes on "no derivative ..."
void check_time(const StepProgram& program, const std::string& what);

/// The impulses of an impact in the order of `contacts`, which are indices in its gaps.
void set_impulses(const ModelData& model, const Tape& tape, const std::vector<int>& contacts,
                  ImpactPieces& impact);

/// Directions by the order of the impulses, or by that of trajectories along z.
enum class Order { own, of_direction };

/// z <- after a piece. @param left [s] of the step, by what the pieces before have changed it
void push_piece(const ModelData& model, const Tape& tape, const StepDirection& by, Order order,
                const StepProgram::Piece& piece, StepProgram& program, Tangent& z, double& left);

/// What is asked along: empty vectors are 0.
void push_program(const ModelData& model, const Tape& tape, const StepDirection& by, Order order,
                  StepProgram& program, Tangent& z);

/// z <- covector of the start; writes the rest of `to`.
/// @param parameters written too, or nullptr
void pull_program(const ModelData& model, const Tape& tape, StepProgram& program, Tangent& z,
                  StepDirection& to, ParameterGradient* parameters);

}  // namespace saltus
