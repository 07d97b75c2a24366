// Contacts with friction that hit together: rounds on all of them, so that what is its own mirror
// image stays so.
//
// A round takes all contacts that approach, those that feel each other as one part, through the two
// phases of a single one (coulomb.hpp):
//
//   compression  Coulomb's law without rebound, at all of the part: rates u_c, impulses p_c
//   expansion    e lambda_c more at each, and of the tangential impulses in the discs of radius
//                mu e lambda_c those of least kinetic energy
//
// and rounds go on until none approaches. Without friction this is the generalized reflection
// (generalized_reflections.hpp), of one contact collide_contact, and e is shared likewise.
//
// No energy is gained: e p_c is among what the second phase chooses from, and with it
// dT = (1 + e) u_c.p_c - (1 - e^2) p_c.W p_c / 2 <= 0 as for one contact. v after a round is
// unique, even where impulses are not.
#pragma once

#include "variational/law/pile.hpp"

namespace saltus {

/// ImpactOrder::symmetric of contacts with friction; arguments as for collide(). After
/// 32 m + 64 impulses of contacts that lose energy what approaches yet does not rebound.
/// @return false where max_impulses did not suffice, or no impulses meet the law
bool collide_together(const ContactBlocks& W, int max_impulses, PileScratch& pile,
                      std::vector<Vec3>& u, std::vector<FrictionImpulse>& impulses);

}  // namespace saltus
