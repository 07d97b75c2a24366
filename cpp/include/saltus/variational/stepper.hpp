// The variational impact stepper: State -> State, one step of size h with all impacts inside it.
#pragma once

#include <memory>

#include "saltus/model/model.hpp"
#include "saltus/variational/options.hpp"
#include "saltus/variational/report.hpp"
#include "saltus/variational/tape.hpp"

namespace saltus {

/// Owns a copy of the model and its working memory. Deterministic: the same sequence of states in
/// gives the same bits out. (The first guess uses the arcs before, so the step of a single state
/// may differ in the last bits; where more contacts slide with friction than a body needs, their
/// shares of the load are no single answer, and may differ, and the motion with them.) Not
/// thread-safe; make one stepper per thread.
class SALTUS_EXPORT Stepper {
 public:
  /// @throws ModelError on an option outside its range.
  explicit Stepper(const Model& model, const StepOptions& options = {});
  ~Stepper();
  /// Takes over its working memory.
  Stepper(Stepper&&) noexcept;
  /// Takes over its working memory.
  Stepper& operator=(Stepper&&) noexcept;

  /// The state h later. `state` is not changed.
  /// @throws ModelError on a state or input that does not fit the model, or with overlapping bodies
  ///         (names pairs and depths); StepError if an arc does not converge or impacts do not end;
  ///         JammedError.
  State advance(const State& state, const ForceInput& input = {});

  /// The same in place, without any allocation after the first step; on an exception `state` is
  /// unchanged. `input` are controls and forces, held over the step.
  void step(State& state, const ForceInput& input = {});

  /// Forgets all earlier steps: the next steps are bitwise those of a new Stepper.
  void forget();

  /// Whether the next steps record a tape for derivatives. Off, as at first, it costs nothing.
  void record(bool on);
  /// Of the last step; nullptr where none was recorded, or the step failed. Valid until the next.
  const Tape* tape() const;

  /// Of the last step.
  const StepReport& report() const;
  /// The copy that it steps.
  const Model& model() const;
  /// As given.
  const StepOptions& options() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace saltus
