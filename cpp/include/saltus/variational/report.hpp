// The report of a step.
#pragma once

#include <string>
#include <vector>

#include "saltus/variational/options.hpp"

namespace saltus {

/// One normal impulse: p += lambda phi_q of this pair.
struct Impulse {
  int pair;       ///< index in model->pairs
  double lambda;  ///< [N s] >= 0
};

/// The impulse between the two shapes of a pair. lambda n_W + p_W acts on the first at point_W, the
/// opposite on the second. For a contact held closed, divided by the step h, it is the mean force.
struct ContactImpulse {
  int pair;       ///< index in model->pairs
  double lambda;  ///< [N s] normal impulse
  Vec3 p_W;       ///< [N s] friction impulse, across the normal; 0 without friction
  Vec3 point_W;   ///< [m] halfway between the nearest points of the two shapes
  Vec3 n_W;       ///< unit normal, from the second shape to the first
};

/// All impulses at one instant.
struct Impact {
  double t;       ///< [s]
  int first;      ///< its impulses are impulses[first, first + count), in order
  int count;      ///< of its impulses
  int contacts;   ///< closed contacts
  ImpactLaw law;  ///< the law that was used
  bool fallback;  ///< nodal_energy replaced the chosen law (theory, section 5, warning a)
};

/// The end of infinitely many ever lower bounces of a pair (a Zeno point); it then stays closed.
struct Settling {
  double t;  ///< [s] when the last bounce ends
  int pair;  ///< index in model->pairs
};

/// How a step that failed at first was made.
enum class Rung {
  halved,  ///< by arcs of half the step, a quarter, ...: all is as exact as with a smaller h
  /// An arc by time stepping: contacts that close in it do not rebound, and no instant is sought.
  /// Of first order in its short duration; energy is only lost.
  unlocated,
  stopped,  ///< an arc that bodies in contact stand still in: their kinetic energy is lost
};

/// "halved", "unlocated", "stopped"
SALTUS_EXPORT std::string rung_name(Rung rung);

/// A step, or an arc of it, that was made otherwise.
struct Fallback {
  double t;       ///< [s] where it starts
  double tau;     ///< [s] the longest arc that the step was made of, or that arc
  Rung rung;      ///< of a step `halved`
  double energy;  ///< [J] what the arc changed of the energy; 0 of `halved`
  int pair;       ///< index in model->pairs of the arc's largest impulse; -1 of `halved`
};

/// Written by Stepper; valid until its next step.
struct StepReport {
  int iterations = 0;   ///< Newton iterations, over all arcs tried
  int arcs = 0;         ///< arcs of the step; 1 without impacts
  int sustained = 0;    ///< contacts held closed by a force, summed over the arcs
  double residual = 0;  ///< [largest momentum] of the worst arc
  /// Residual of Coulomb's law, as a fraction of the largest impulse or rate: the worst of the arcs
  /// and of the closing half kicks. Up to 1e-9 is rounding; more than 1e-6 is an error.
  double friction_residual = 0;
  /// [J] done on the model in the step: by each actuator, by damping, by dry friction, and by the
  /// forces of the input. H changes by their sum, but for O(h^2) of the midpoint rule.
  VecX work;  ///< (n_u + 3)
  /// [N s | N m s] what loops pushed in the step, those of impacts left aside; by the step h it is
  /// their mean force. Rows as in model->equalities.
  VecX loops;
  std::vector<Impact> impacts;            ///< in order of time
  std::vector<ContactImpulse> impulses;   ///< of impacts
  std::vector<Settling> settlings;        ///< in order of time
  std::vector<Fallback> fallbacks;        ///< none as a rule
  std::vector<std::string> certificates;  ///< (impacts), "" of single contacts; if asked for
  /// Of pairs that were held closed, each once: the sum of its impulses in arcs and between them,
  /// those of impacts left aside. Each acts where the contact is as its arc starts, or between
  /// arcs; point and normal are the mean of these, weighted by lambda.
  std::vector<ContactImpulse> contacts;
};

}  // namespace saltus
