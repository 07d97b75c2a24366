// An arc by time stepping, where no other is found.
//
// No instant is sought: all contacts that close within tau are rows of one law, without rebound, of
// the velocity v that the arc has throughout (J. J. Moreau 1999, with the gaps of its end):
//
//   q+ = q (+) tau v,  M(q) (v - v_free) = sum B^T p,   0 <= p_n  _|_  u_n >= 0,  Coulomb,
//   u_n = (phi + tau n.(v - v_at)) / tau
//
// where phi and n of a contact are those at the node, and of one that overlaps at q+ those there,
// v_at being the velocity that leads there: such rows join until nothing overlaps. v = 0 meets all
// of them, so there is an answer. Momenta are M(q+) v. No row adds energy but by turning; what
// turns and gravity add is taken off v.
#pragma once

#include "variational/arc/finish.hpp"

namespace saltus {

/// Written by step_unlocated.
struct Unlocated {
  explicit Unlocated(const Scene& scene);

  std::vector<ContactImpulse> impulses;
  double energy = 0;    ///< [J] what the arc has changed
  int pair = -1;        ///< number of the pair that took the largest impulse
  double residual = 0;  ///< of Coulomb's law, as StepReport::friction_residual

  // scratch; it is rare, and may allocate
  std::vector<Contact> cuts;   ///< rows, as contacts
  std::vector<double> offset;  ///< (cuts) [m/s] u_n - n.v
  Contact whole;               ///< of two bodies
  std::vector<Contact*> list;
  std::vector<Vec3> u, p;
  Neighbours neighbours;
  ContactBlocks W;
  PileScratch pile;
  VecX v_free, v, q_end;
  double work = 0;     ///< [J] what drives the step did in the arc without contacts:
  ForceValues forces;  ///< in its middle, where the velocity is
  VecX wrench_force, v_middle;
};

/// Leaves the node tau later, at time t. `end` is a node that may be used, and `arc` scratch.
/// @return Rung::unlocated, or Rung::stopped: bodies in contact stand still, and with them what
/// would fly into one that does
Rung step_unlocated(const Scene& scene, double tau, double t, Node& node, Node& end,
                    ArcScratch& arc, Unlocated& x);

}  // namespace saltus
