// What friction does at contacts that stay closed: each slides, sticks, or is not pressed.
//
// `settle` (friction.hpp) says which of these a contact does, and its impulse to some digits. With
// that known the equations are linear, and `polish` solves them to rounding:
//
//   sticks  u_n = 0, u_t = 0      unknown lambda, beta
//   slides  u_n = 0               unknown lambda, beta = -mu lambda d, d = u_t / |u_t|
//
// Where contacts are redundant (four legs of a table) there are many solutions: rates that others
// imply are left out, with their impulses as `settle` found them, and of redundant normals it is
// the change that is kept the shortest. So all impulses stay within their cones.
#pragma once

#include <array>
#include <vector>

#include "saltus/variational/friction.hpp"
#include "variational/coulomb.hpp"
#include "variational/pile.hpp"
#include "variational/redundant.hpp"

namespace saltus {

struct Grip {
  enum class Mode : char { none, slides, sticks };  ///< none: not pressed, or mu = 0
  Mode mode = Mode::none;
  Vec2 slide = Vec2::Zero();  ///< unit direction in the contact's tangents, where it slides
};

/// Of a contact with these rates under this impulse.
/// @param rest [m/s] slower is no sliding
Grip grip_of(const Vec3& u, const Vec3& p, double friction, double rest);

/// What an impulse of lambda does where it slides, per lambda: (1, -mu d).
inline Vec3 slide_direction(const Grip& grip, double friction) {
  return {1, -friction * grip.slide[0], -friction * grip.slide[1]};
}

/// Rates that do not follow from each other: a Cholesky factor of W that grows by a row each.
struct IndependentRates {
  void start() { contact.clear(), rate.clear(), L.clear(); }
  /// Takes one more. @return false where it follows from those taken
  bool take(const ContactBlocks& W, int contact, int rate);

  std::vector<int> contact, rate;
  std::vector<double> L;  ///< lower triangle by rows
};

/// What an impulse was in the last arc, for a guess.
struct ImpulseMemory {
  Vec3 p = Vec3::Zero();  ///< [N s] over `tau`
  double tau = 0;         ///< [s]
  int flight = -1;        ///< its number; an older one is no guess
};

/// One unknown of `polish`: an impulse at a contact along a direction, and the rate that it ends.
struct PolishUnknown {
  int contact;
  int rate;
  Vec3 along;
};

struct PolishScratch {
  std::vector<PolishUnknown> unknown;
  std::vector<Vec3> change;
  IndependentRates rates;
  RedundantSystem system;
  void reserve(std::size_t contacts);
};

/// What a node or a flight keeps of friction; empty where no materials have any.
struct FrictionScratch {
  explicit FrictionScratch(bool with_friction);
  void reserve(std::size_t contacts);  ///< no effect where there is room
  bool any;                            ///< some pair of materials has friction
  ContactBlocks W;
  std::vector<Vec3> u, p;
  std::vector<int> contact;  ///< of each block: an index in the node's or flight's list
  std::vector<FrictionImpulse> impulses;
  PileScratch pile;
  PolishScratch polish;
  std::vector<ImpulseMemory> memory;  ///< (pool), of a node
  double residual = 0;  ///< of Coulomb's law, the largest of a step's closing half kicks
  int flight = 0;       ///< the number of the flight that leaves the node
};

/// u = 0 to rounding where contacts are pressed, see above. u and p stay as they are where that is
/// out of reach: impulses would leave their cones.
void polish(const ContactBlocks& W, PolishScratch& s, std::vector<Vec3>& u, std::vector<Vec3>& p);

}  // namespace saltus
