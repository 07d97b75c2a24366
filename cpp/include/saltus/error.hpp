// The exceptions that saltus throws. Everything a user can get wrong ends in one of these.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "saltus/export.hpp"

/// Models of bodies, their motion and their impacts.
namespace saltus {

/// Bad input: a file, a name, a shape of array, a number that no model can have.
/// The message names the culprit, its value and the alternatives. Python: `ModelError(ValueError)`.
class SALTUS_EXPORT ModelError : public std::invalid_argument {
 public:
  /// `kind` and `culprit` as in the members.
  explicit ModelError(const std::string& what, std::string kind = "", std::string culprit = "")
      : std::invalid_argument(what), element(std::move(kind)), name(std::move(culprit)) {}
  std::string element;  ///< kind of the culprit where it has a name: "link", "joint"
  std::string name;     ///< its name; a reader of files finds the line by these two
};

/// A step that could not be made; the state it started from is unchanged.
/// Python: `StepError(RuntimeError)` with the same attributes.
class SALTUS_EXPORT StepError : public std::runtime_error {
 public:
  /// The members, in their order.
  StepError(const std::string& what, double time, double scaled_residual, int spent)
      : std::runtime_error(what), t(time), residual(scaled_residual), iterations(spent) {}
  double t;         ///< [s] where the step (or arc) began
  double residual;  ///< [largest momentum] scaled residual when the solver gave up
  int iterations;   ///< Newton iterations, arcs or impulses spent
};

/// A cascade of impulses that does not end: bodies jammed between others. Python: `JammedError`.
class SALTUS_EXPORT JammedError : public StepError {
 public:
  using StepError::StepError;
};

}  // namespace saltus
