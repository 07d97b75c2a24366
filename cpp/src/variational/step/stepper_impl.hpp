// What a Stepper is made of, for stepper.cpp and step_errors.cpp.
#pragma once

#include <exception>
#include <string>

#include "saltus/variational/stepper.hpp"
#include "variational/flight/flight.hpp"

namespace saltus {

struct Stepper::Impl {
  Impl(const Model& with, const StepOptions& with_options)
      : model(with_options.collisions ? with : with.without_collisions()),
        options(with_options),
        node(*model),
        flight(*model, options, node.friction.any) {
    last.q.setZero(model.n_q());
    last.p.setZero(model.n_v());
    report.impacts.reserve(64);
    report.impulses.reserve(1024);
    report.settlings.reserve(64);
    report.contacts.reserve(64);
  }

  void step(State& state);
  void step_once(State& state, bool is_own);
  void start(const State& state, bool is_own);
  void check_overlap() const;
  void fly_one_arc(double left);
  void arrive(double t);
  bool is_last_attempt() const;
  void check_energy();
  void check_gaps();
  double conserved_energy();
  void end_step();
  [[noreturn]] void fail(FlightOutcome outcome);
  [[noreturn]] void fail_at_last(const std::exception_ptr& first) const;
  [[noreturn]] void fail_jammed();
  [[noreturn]] void fail_impacts() const;
  [[noreturn]] void fail_arcs();
  [[noreturn]] void fail_energy(double gain);
  [[noreturn]] void fail_sinking(const Contact& contact);
  std::string contact_list() const;
  std::string held_list() const;
  std::string fast_joint() const;

  Model model;
  StepOptions options;
  Node node;
  Flight flight;
  StepReport report;
  State last;  // where the step starts; the node still holds it if the last step ended there
  bool last_is_valid = false;
  double longest = 0;        // [s] no arc of this attempt may be longer
  bool halves_help = false;  // what failed may not fail with shorter arcs
  // where the arc started
  double deepest = 0;              // [m] its lowest gap, or 0
  double kinetic = 0, energy = 0;  // [J] if contacts held it
};

}  // namespace saltus
