// What StepDerivatives has.
#pragma once

#include "derivatives/arc_curvature.hpp"
#include "derivatives/columns.hpp"
#include "saltus/derivatives/step_derivative.hpp"

namespace saltus {

struct StepDerivatives::Impl {
  Impl(const Model& with, const StepOptions& with_options)
      : shared(with_options.collisions ? with : with.without_collisions()),
        options(with_options),
        model(*shared),
        dense(model) {}

  void check(const StepDirection& d) const;
  void check(const StateDirection& covector) const;
  void need_step() const;
  /// By a law that matches energies: the impulses of other orders are not made.
  bool is_matched() const { return program.start.q.size() > 0 || program.has_match; }
  void need_orders() const;
  Tangent push(const StepDirection& by, Order order = Order::own);
  StepDirection pull(const StateDirection& covector, bool with_parameters);
  void set_columns(Input input, MatX& out);
  double spread(const MatX& A, std::size_t impact, Smoothness& verdict);
  bool is_at_edge() const;
  /// The only arc of a step that has second derivatives. @throws ModelError of others
  FlownArc& only_arc();
  /// What the covector changes by along a direction.
  StepDirection bend(const StepDirection& direction);
  void judge(StepDerivative& out);

  Model shared;
  StepOptions options;
  const ModelData& model;
  Tape tape;
  StepProgram program;
  DenseScratch dense;
  ParameterGradient parameters;
  ArcCovector bent;  ///< of second derivatives
  bool is_set = false;
};

}  // namespace saltus
