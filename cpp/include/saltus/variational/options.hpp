// Options of a step: the time step, the impact law, bounds and tolerances with their reasons.
#pragma once

#include <span>
#include <string>

#include "saltus/error.hpp"
#include "saltus/variational/impact_problem.hpp"

namespace saltus {

/// The energy that an elastic impact conserves (theory, section 5), and that restitution reduces.
/// Where forces act that are not in L (damping, motors, wrenches), all built-in laws are
/// nodal_energy, with the arcs of L: impacts tell so (`fallback`).
enum class ImpactLaw {
  nodal_energy,     ///< H(q, p+) = H(q, p-) at the impact: lambda = -2u/G, always solvable
  discrete_energy,  ///< the paper's (11c): E_d of the arcs on both sides equal; exactly symplectic
  shadow_energy,    ///< H - h^2 kappa / 24 equal at both ends of the step
  compensated,      ///< (11c) with arcs of L + (h^2 - tau^2) kappa / 24: symplectic, and O(h^4)
  custom,           ///< a function of the user, StepOptions::custom
};

/// A row of the table of laws, which is in terms/options.cpp.
struct LawEntry {
  ImpactLaw law;        ///< of this row
  const char* name;     ///< "nodal_energy"
  const char* meaning;  ///< for people, in a sentence
};

/// All of them, in the order of ImpactLaw.
SALTUS_EXPORT std::span<const LawEntry> impact_laws();

/// "nodal_energy", ...
SALTUS_EXPORT std::string law_name(ImpactLaw law);

/// Which approaching contact takes the next impulse. Unless classify_impact() certifies a unique
/// outcome, the outcome depends on this order, and each order is a convention.
enum class ImpactOrder {
  fastest,  ///< the most negative u_i / sqrt(G_ii); ties go to the lowest index
  index,    ///< the lowest index
  /// all of them together: the velocity is reflected in the nearest face of their cone, until none
  /// approaches (generalized reflections). Keeps mirror symmetry.
  symmetric,
};

/// Of a step.
struct StepOptions {
  double h = 0.01;                           ///< [s] time step
  ImpactLaw law = ImpactLaw::nodal_energy;   ///< which energy an impact keeps
  ImpactOrder order = ImpactOrder::fastest;  ///< which contact is next
  bool certify = false;  ///< reports for impacts on several contacts whether the outcome is unique
  ImpactFunction custom = {};  ///< the function that law = custom calls
  bool collisions = true;      ///< false: bodies pass through each other

  int max_iterations = 40;  ///< Newton iterations per arc; 2 to 4 are usual
  /// Impacts per step; with more a body bounces faster than h can follow. Also the bound of arcs
  /// without an impact, but at most 100 of these.
  int max_impacts = 1000;
  /// How often a failed step is repeated with arcs of half the duration: by default down to h / 64.
  /// 0: never. StepReport::fallbacks reports it.
  int max_halvings = 6;
  /// True: a step that neither whole nor halved arcs make is an error. Else its contacts are
  /// resolved by time stepping, which loses order and energy, and StepReport::fallbacks tells.
  bool strict = false;
  int max_impulses = 100000;  ///< impulses an impact; Galperin's 10^4-th part of pi needs 31415

  /// epsilon_u: a contact with |u| below this fraction of sqrt(2 E G) is at rest and does not
  /// approach; 1e-10 is far above the rounding of p (1e-16, more after long cascades) and far below
  /// any motion that matters.
  double rest = 1e-10;
  /// epsilon_t: a contact that would close within this fraction of h takes part in an impact.
  double simultaneous = 1e-9;
};

}  // namespace saltus
