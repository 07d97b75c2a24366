// The variational impact stepper: State -> State, one step of size h with all impacts inside it.
#pragma once

#include <memory>

#include "saltus/model/model.hpp"
#include "saltus/variational/options.hpp"
#include "saltus/variational/report.hpp"

namespace saltus {

/// Owns a copy of the model and its scratch. Deterministic: the same sequence of states in gives
/// the same bits out (the first guess uses the arcs before, so a single state out of sequence may
/// differ in the last bits). Not for use by two threads at once; make one a thread.
class SALTUS_EXPORT Stepper {
 public:
  /// @throws ModelError where an option is out of its range.
  explicit Stepper(const Model& model, const StepOptions& options = {});
  ~Stepper();
  Stepper(Stepper&&) noexcept;
  Stepper& operator=(Stepper&&) noexcept;

  /// The state h later. `state` is not changed.
  /// @throws ModelError on a state that does not fit the model or overlaps (names pairs, depths);
  ///         StepError when an arc does not converge or impacts do not end; JammedError.
  State advance(const State& state);

  /// The same in place, without any allocation after the first step; on an exception `state` is
  /// as it was.
  void step(State& state);

  /// Takes the next state as a start, also where it is the one that the last step ended with: what
  /// comes is what a new Stepper would give, to the last bit.
  void forget();

  const StepReport& report() const;
  const Model& model() const;
  const StepOptions& options() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace saltus
