// A step's report with pairs by name, as Python has it.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "saltus/variational/stepper.hpp"

namespace saltus::bindings {

/// An Impact with its pairs by name and its own impulses.
struct NamedImpact {
  double t;
  std::vector<std::string> pairs;
  VecX lambdas;
  MatX tangentials, points, normals;  ///< (impulses, 3)
  int contacts;
  ImpactLaw law;
  bool fallback;
  std::string certificate;
};

struct NamedContact {
  std::string pair;
  double impulse;
  Vec3 tangential, point, normal;
};

/// Stepper's own report is overwritten by its next step; Python keeps copies.
struct NamedReport {
  int iterations, arcs, sustained;
  double residual;
  double friction_residual;
  std::vector<NamedImpact> impacts;
  std::vector<std::pair<double, std::string>> settlings;
  std::vector<NamedContact> contacts;
  std::vector<std::tuple<double, double, std::string, double, std::string>> fallbacks;
  std::map<std::string, double> work;
  std::map<std::string, VecX> loops;
};

NamedReport with_names(const Model& model, const StepReport& report);

}  // namespace saltus::bindings
