// What a Stepper is made of, for stepper.cpp, acceptance.cpp and step_errors.cpp.
#pragma once

#include <exception>
#include <optional>
#include <string>

#include "saltus/variational/stepper.hpp"
#include "variational/arc/finish.hpp"
#include "variational/flight/flight.hpp"
#include "variational/step/standing.hpp"
#include "variational/step/step_input.hpp"
#include "variational/step/unlocated.hpp"

namespace saltus {

struct Stepper::Impl {
  Impl(const Model& with, const StepOptions& with_options)
      : scene(with, with_options),
        pool(scene.model),
        node(scene, pool),
        memory(scene.model.tree.n_v, pool.size()),
        flight(scene),
        kick(scene),
        impact(scene),
        meter(scene.model),
        end(scene, pool),
        unlocated(scene),
        standing(scene) {
    for (VecX* each : {&last.q, &q_sunk}) each->setZero(scene.model.tree.n_q);
    for (VecX* each : {&lift, &p_sunk}) each->setZero(scene.model.tree.n_v);
    last.p.setZero(scene.model.tree.n_v);
    report.work.setZero(scene.model.forces.n_u() + 3);
    report.loops.setZero(scene.model.equalities.rows);
    damped = perhaps_stiff(scene);
    if (!damped.empty()) flight.work.scratch.shift.setZero(scene.model.tree.n_v);
    report.impacts.reserve(64);
    report.impulses.reserve(1024);
    report.settlings.reserve(64);
    report.contacts.reserve(64);
  }

  void step(State& state, const ForceInput& with);
  void take(const ForceInput& with);  // step_input.cpp
  bool stands_on(const State& state) const;
  void stand(State& state);
  void add_work();  // likewise
  void add_work(double tau, const VecX& v, const ForceValues& forces, const VecX& wrench_force);
  void add_dry_work();  // likewise
  void set_shift();     // likewise
  void add_shift_work();
  void add_loop_work(const VecX& impulse);
  void step_once(State& state, bool is_own);
  void step_at_any_price(State& state, bool is_own);
  void fly_unlocated(double tau, double t);
  void start(const State& state, bool is_own);
  void check_overlap();  // start_checks.cpp
  void check_loops();    // likewise
  void fly_one_arc(double left, const Launch* launch);
  void end_arc(double t);
  const Launch* collide();
  double conserved_energy();
  void end_step(const Launch* launch);

  // record.cpp
  void refuse(const char* why);
  void start_tape(const State& state);
  void record_arc(double asked, double left, const Launch* launch);
  void record_match(const Launch& launch, TapeArc& to);
  void record_row(const Row& row, double friction, const Vec3& P, TapeRow& to);
  void record_joint(int dry, double P, double tau, TapeRow& to);
  void record_loops(const VecX& P, std::vector<TapeRow>& rows, int& used);
  void record_kick(std::size_t k, TapeArc& arc);
  void record_end();
  void record_contacts();
  void record_impulses();
  void end_tape();

  // acceptance.cpp
  int most_impacts() const;
  int most_work() const;
  bool halves_left() const;
  double pile_work() const;
  void forget_pile_work();
  void note_start();
  void check_energy();
  bool is_doubtful();
  void check_free_energy();
  void check_step_energy(double start);
  void check_gaps();
  void check_idle_arcs();
  void lift_out();  // lift.cpp
  void lift_once(double before);
  bool place_with_contacts(const VecX& q, const VecX& p);
  void place_back();

  [[noreturn]] void fail(FlightOutcome outcome);
  [[noreturn]] void raise(const std::string& why, const std::string& advice, int count);
  [[noreturn]] void fail_at_last(const std::exception_ptr& first, const std::string& why) const;
  [[noreturn]] void fail_law(int slot, double residual);
  [[noreturn]] void fail_jammed();
  [[noreturn]] void fail_impacts();
  [[noreturn]] void fail_arcs();
  [[noreturn]] void fail_work();
  [[noreturn]] void fail_driven();
  void check_closed(double lowest);
  [[noreturn]] void fail_energy(double gain);
  [[noreturn]] void fail_sinking(const Contact& contact);
  bool loses_energy() const;
  std::string name_of(int slot) const;
  std::string contact_list() const;
  std::string held_list() const;
  std::string fast_joint() const;
  std::string weak_loop() const;
  std::string loops_in_words() const;

  Scene scene;
  PairPool pool;
  Node node;
  Memory memory;
  Flight flight;
  HalfKick kick;
  ImpactScratch impact;
  EnergyMeter meter;
  Node end;             // of an arc by time stepping
  Unlocated unlocated;  // likewise
  Standing standing;
  VecX q_sunk, p_sunk, lift;   // by lift_out
  ForceInput input;            // of the step
  bool input_is_same = false;  // as that of the step before
  std::vector<int> damped;     // velocities whose damping may be stiff
  StepReport report;
  std::optional<Tape> recorded;  // where one is asked for
  State last;  // where the step starts; the node still holds it if the last step ended there
  bool last_is_valid = false;
  double longest = 0;  // [s] no arc of this attempt may be longer
  bool is_last_attempt = false;
  // of the last failure
  bool halves_help = false;     // with shorter arcs it may not come
  bool blames_contact = false;  // with time stepping it does not: contacts are to blame
  int grazes = 0;               // attempts at this step with arcs that end without an impact
  std::string cause;
  // where the arc started, by note_start
  double deepest = 0;              // [m] its lowest gap, or 0
  double kinetic = 0, energy = 0;  // [J] if contacts hold the arc
  /// [J] in the middle of the last arc without contacts, if nothing has hit since.
  struct MiddleEnergy {
    double kinetic = 0, total = 0, work = 0;
    bool is_known = false;
  };
  MiddleEnergy middle;
  // [J] what forces did in it, and the sum of what each did
  double done = 0, done_size = 0;
};

}  // namespace saltus
