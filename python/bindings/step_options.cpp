// From what a user writes for the options of a step to StepOptions.
#include <memory>

#include "bindings.hpp"

namespace saltus::bindings {
namespace {

VecX to_momenta(const py::object& answer) {
  try {
    return answer.cast<VecX>();
  } catch (const py::cast_error&) {
    throw py::type_error("the custom law returned " + py::repr(answer).cast<std::string>() +
                         "; it is to return the momenta after, an array of shape (n,)");
  }
}

/// Steps run without the interpreter's lock, and copy their options without it too: the count of
/// references lies behind a pointer of C++'s own.
ImpactFunction asking_python_law(const py::object& law) {
  const std::shared_ptr<py::object> shared(new py::object(law), [](py::object* held) {
    const py::gil_scoped_acquire acquire;
    delete held;
  });
  return [shared](const ImpactProblem& problem) {
    const py::gil_scoped_acquire acquire;
    return to_momenta((*shared)(py::cast(problem)));
  };
}

}  // namespace

void set_law(const LawChoice& law, StepOptions& options) {
  if (PyCallable_Check(law.value.ptr()) != 0) {
    options.law = ImpactLaw::custom;
    options.custom = asking_python_law(law.value);
  } else {
    options.law = to_enum(Choice<ImpactLaw>{law.value}, "law");
  }
}

StepOptions make_step_options(double h, const LawChoice& law, bool collisions,
                              const Choice<ImpactOrder>& order, bool certify, int max_iterations,
                              int max_impacts, int max_halvings, int max_impulses, double rest,
                              double simultaneous, bool strict) {
  StepOptions options;
  options.h = h;
  set_law(law, options);
  options.collisions = collisions;
  options.order = to_enum(order, "order");
  options.certify = certify;
  options.max_iterations = max_iterations;
  options.max_impacts = max_impacts;
  options.max_halvings = max_halvings;
  options.max_impulses = max_impulses;
  options.rest = rest;
  options.simultaneous = simultaneous;
  options.strict = strict;
  return options;
}

}  // namespace saltus::bindings
