// The stepper as Python has it.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <thread>

#include "bindings.hpp"
#include "control.hpp"
#include "named_report.hpp"
#include "saltus/derivatives/step_derivative.hpp"

namespace saltus::bindings {

/// Advancing releases the interpreter's lock, so a second thread could come in: the mutex. What a
/// step asks (a law, a force, a motion) comes in by the same thread: that would wait for itself.
struct SharedStepper {
  Stepper stepper;
  std::unique_ptr<StepDerivatives> derivatives;  ///< where steps are recorded
  bool is_linear = false;                        ///< they are of the last step
  std::mutex mutex;
  std::atomic<std::thread::id> owner;

  /// The stepper for one call.
  struct Turn {
    explicit Turn(SharedStepper& of) : shared(of) {
      if (shared.owner == std::this_thread::get_id()) {
        throw ModelError(
            "the stepper is in a step, which asks this function: it can neither advance it nor "
            "read its report; another Stepper can");
      }
      shared.mutex.lock();
      shared.owner = std::this_thread::get_id();
    }
    ~Turn() {
      shared.owner = std::thread::id();
      shared.mutex.unlock();
    }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
    SharedStepper& shared;
  };

  SharedStepper(const Model& model, const StepOptions& options, bool record)
      : stepper(model, options) {
    stepper.record(record);
    if (record) derivatives = std::make_unique<StepDerivatives>(stepper.model(), options);
  }

  State advance(const State& state, const py::object& control, const Wrenches& forces,
                const Velocities& qfrc) {
    const ForceInput input = to_input(control, forces, qfrc, stepper.model());
    const py::gil_scoped_release release;
    const Turn turn(*this);
    is_linear = false;
    return stepper.advance(state, input);
  }
  NamedReport report() {
    const py::gil_scoped_release release;
    const Turn turn(*this);
    return with_names(stepper.model(), stepper.report());
  }

  /// What `f` makes of the derivatives of the last step.
  template <class F>
  auto derive(const F& f) {
    const py::gil_scoped_release release;
    const Turn turn(*this);
    if (!derivatives) {
      throw ModelError("the stepper records no steps; Stepper(model, record=True) does");
    }
    if (stepper.tape() == nullptr) {
      throw ModelError("there is no step to differentiate: advance comes first");
    }
    if (!is_linear) derivatives->linearize(*stepper.tape());
    is_linear = true;
    return f(*derivatives);
  }
};

void bind_step_derivatives(py::class_<SharedStepper>& c);

}  // namespace saltus::bindings
