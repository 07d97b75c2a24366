// The end of an arc: a node, and the closing half kick.
//
// p_end = p_start + tau L_q has the second half of gravity's and all other forces' kick in it, and
// what the arc held closed takes that up: an impact without rebound, onto the rates of the arc's
// own rows. Those are not the contacts of the node. A corner may have slid over the border of its
// face, an edge off another's end, and bore the load to the arc's end; without it the half kick
// would be taken for an approach of what comes next there: edges that cross at the border, a second
// table, a corner that has come onto the face. With it they find a body at rest, u = 0, and the
// next arc presses them. Where it bore the load is off by what it slid in one arc, O(h), for that
// arc.
//
// What slid in the arc has friction in the direction of the opening kick, that of its slip in the
// arc's middle: the two kicks together are of second order then, also where the direction turns. So
// long as that is against the slip before and after the kick; else Coulomb's law says, as of what
// stuck.
#pragma once

#include "variational/arc/memory.hpp"
#include "variational/arc/solve.hpp"

namespace saltus {

/// The closing half kick. Written by `finish`.
struct HalfKick {
  explicit HalfKick(const Scene& scene);

  std::vector<ContactImpulse> impulses;
  double residual = 0;  ///< of the law
  int unlawful = -1;    ///< slot of the pair that it was least met by
  double dry_work = 0;  ///< [J] of joints with dry friction

  // scratch
  std::vector<Contact> own;        ///< a pool: what the arc held and is no contact of the node
  std::vector<Contact*> contacts;  ///< all that share it
  Neighbours neighbours;
  ContactBlocks W;
  std::vector<Vec3> u, p;
  std::vector<Mat3> sizes;       ///< (contacts) W_ii in the arc; 0 where not known
  std::vector<double> dry_rate;  ///< (contacts) of joints, before
  std::vector<int> sticking;     ///< (trees) joints that dry friction holds
  std::vector<Vec3> push;  ///< (1, friction) of a normal impulse of 1 where it slid; else zero
  VecX p_before, v_before;
  PileScratch pile;
};

/// What rested in the arc goes on to rest, most often. The opening and the closing half kick differ
/// by twice what was wrong with the former, so that their mean is the guess.
void remember(const HalfKick& kick, Memory& memory);

/// Puts the node at the end of the arc, at time t. Writes q, p, v and contacts, and takes the
/// frames there from the arc if they are known.
/// @param motion (shapes) as move_node takes it
/// @return false where the mass matrix is singular.
bool finish(const Scene& scene, double t, const std::vector<double>& motion, ArcWork& work,
            Node& node, HalfKick& kick);

}  // namespace saltus
