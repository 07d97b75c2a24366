// What happened in a step.
#pragma once

#include <string>
#include <vector>

#include "saltus/variational/options.hpp"

namespace saltus {

/// One reflection: p += lambda phi_q of this pair.
struct Impulse {
  int pair;       ///< index in model->pairs
  double lambda;  ///< [N s] >= 0
};

/// What acted between the two shapes of a pair. On the first acts lambda n_W + p_W, at point_W; on
/// the second the opposite. By the step h, what held a pair closed over the step is the mean force.
struct ContactImpulse {
  int pair;       ///< index in model->pairs
  double lambda;  ///< [N s] along the normal
  Vec3 p_W;       ///< [N s] friction's, across the normal; 0 without friction
  Vec3 point_W;   ///< [m] where: halfway between the nearest points of the two shapes
  Vec3 n_W;       ///< unit normal, from the second shape to the first
};

/// All impulses at one instant.
struct Impact {
  double t;   ///< [s]
  int first;  ///< its impulses are impulses[first, first + count), in order
  int count;
  int contacts;   ///< pairs that touched
  ImpactLaw law;  ///< the law that was used
  bool fallback;  ///< another law asked for, nodal_energy used (theory, section 5, warning a)
};

/// A pair that bounced ever lower has come to rest.
struct Settling {
  double t;  ///< [s] when the last of infinitely many bounces ends
  int pair;  ///< index in model->pairs
};

/// How a step was made that could not be made as it should.
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
  int arcs = 0;         ///< arcs that the step is made of; 1 without impacts
  int sustained = 0;    ///< arcs' contacts that were held closed by a force
  double residual = 0;  ///< [largest momentum] of the worst arc
  /// How far from Coulomb's law the step is, of its arcs and its closing half kicks the worst: by a
  /// part of the largest impulse or rate. To 1e-9 it is rounding; more than 1e-6 is an error.
  double friction_residual = 0;
  std::vector<Impact> impacts;
  std::vector<ContactImpulse> impulses;  ///< of impacts
  std::vector<Settling> settlings;
  std::vector<Fallback> fallbacks;        ///< none as a rule
  std::vector<std::string> certificates;  ///< (impacts), "" of single contacts; if asked for
  /// Of pairs that were held closed, each once: the sum of its impulses in arcs and between them,
  /// those of impacts left aside. Each acts where the contact is as its arc starts, or between
  /// arcs; point and normal are the mean of these, weighted by lambda.
  std::vector<ContactImpulse> contacts;
};

}  // namespace saltus
