// The tape of a step: what its derivatives are made of, recorded on request.
//
// A step is a row of arcs and impacts. An arc is told by its start, its velocity and its duration,
// and by what ended it; an impact by the node it is at and by its impulses in their order. Whoever
// walks the tape evaluates the arcs again, about a Newton iteration each.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "saltus/collision/pair.hpp"
#include "saltus/force/force_model.hpp"
#include "saltus/variational/options.hpp"

namespace saltus {

/// A contact or a loop that pushes: over an arc, or in the kick that ends it.
struct TapeRow {
  int pair = -1;
  int loop = -1;           ///< row of the equalities, which pushes both ways; and no pair
  int joint = -1;          ///< velocity of a joint with dry friction; P is along it, and no pair
  bool is_frozen = false;  ///< held as `frozen`, a plane of b
  bool is_point = false;   ///< and there at a point of a
  Pair frozen;
  double friction = 0;
  Vec3 P =
      Vec3::Zero();  ///< [N s] along n and two tangents: tangents(n, axis), or those fixed in b
  int axis = 0;
  bool slides = false;
  Vec3 point_B = Vec3::Zero();  ///< [m] where it starts, in the frame of b's joint; if is_point
  std::array<Vec3, 2> t_B = {Vec3::Zero(), Vec3::Zero()};  ///< tangents fixed in b
  /// Of a kick: its friction is along that of row `held` of the arc, which slid.
  bool is_along = false;
  int held = -1;
};

/// An arc (q, v, tau), as solved.
struct TapeArc {
  enum class End {
    step,  ///< it took all the time that was left
    part,  ///< a given part of the step, the attempt being one with shorter arcs
    gap,   ///< a gap closed
  };
  double t = 0;    ///< [s] when it starts
  double tau = 0;  ///< [s]
  End end = End::step;
  double part = 1;    ///< tau / h where its end is `part`
  int pair = -1;      ///< whose gap closed
  VecX q, p;          ///< (n_q), (n_v) at its start
  VecX v;             ///< (n_v)
  VecX q_end, p_end;  ///< likewise at its end
  VecX shift;         ///< (n_v) of stiff damping, or empty
  /// Of an arc after an impact whose law matches energies: index in the impact's contacts of the
  /// one whose impulse was changed, and by how much; -1: none was.
  int matched = -1;
  double delta = 0;                 ///< [N s]
  std::vector<TapeRow> held, kick;  ///< pools: the first n_held and n_kick are valid
  int n_held = 0, n_kick = 0;
};

/// A contact that was closed at an impact.
struct TapeContact {
  int pair;
  double u, epsilon_u;  ///< [m/s] gap rate before; slower is rest
  double restitution, friction;
};

struct TapeImpulse {
  int contact;  ///< index in the impact's contacts
  double lambda;
  Vec3 P = Vec3::Zero();  ///< with friction: along n and tangents(n, axis)
  int axis = 0;
};

struct TapeImpact {
  double t = 0;
  VecX q, p, v;  ///< before
  std::vector<TapeContact> contacts;
  std::vector<TapeImpulse> impulses;
  bool is_together = false;                 ///< all at once, plastic: no order, each contact once
  ImpactLaw law = ImpactLaw::nodal_energy;  ///< that was used, the launch after it left aside
};

/// Of the last step. Storage is used again: a step records without allocating, after the first few.
struct Tape {
  struct Piece {
    bool is_arc;
    int index;  ///< in arcs or impacts
  };
  double t = 0, h = 0;
  ImpactLaw law = ImpactLaw::nodal_energy;
  VecX q, p;  ///< at its start
  VecX q_end, p_end;
  ForceInput input;
  std::vector<Piece> pieces;  ///< in order
  std::vector<TapeArc> arcs;  ///< pools: `pieces` names those that are used
  std::vector<TapeImpact> impacts;
  int n_arcs = 0, n_impacts = 0;
  /// What of the step derivatives are not made of yet, in words; "" where there is nothing.
  std::string refusal;
  bool has_settled = false;  ///< a bounce ended in the step, as of a pair that rests
  bool is_whole = false;     ///< the step was made
};

}  // namespace saltus
