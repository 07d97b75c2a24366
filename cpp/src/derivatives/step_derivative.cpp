#include <limits>

#include "derivatives/step_impl.hpp"
#include "derivatives/verdict.hpp"

namespace saltus {

void StepDerivatives::Impl::need_step() const {
  if (!is_set)
    throw ModelError("there is no step to differentiate: none was recorded, or it failed");
}

void StepDerivatives::Impl::need_orders() const {
  need_step();
  if (is_matched()) {
    throw ModelError(
        "other orders of impacts are not differentiated with laws that match energies");
  }
}

void StepDerivatives::Impl::check(const StepDirection& d) const {
  const auto fits = [](const VecX& x, int n, const char* what, const char* unit) {
    if (x.size() > 0) check_vector(x, n, what, unit);
  };
  fits(d.q, model.tree.n_v, "dq", "velocities");
  fits(d.p, model.tree.n_v, "dp", "velocities");
  fits(d.control, model.forces.n_u(), "du", "actuators");
  fits(d.qfrc, model.tree.n_v, "dqfrc", "velocities");
  fits(d.restitution, program.n_impacts, "drestitution", "impacts");
  const auto wrenches = static_cast<Eigen::Index>(tape.input.wrenches.size());
  const auto fits_wrenches = [&](const MatX& x, const std::string& what) {
    if (x.size() == 0 || (x.rows() == wrenches && x.cols() == 3)) return;
    throw ModelError(what + " is " + std::to_string(x.rows()) + " by " + std::to_string(x.cols()) +
                     "; it is " + std::to_string(wrenches) +
                     " by 3, a row for each wrench that was applied in the step");
  };
  fits_wrenches(d.forces, "dforces");
  fits_wrenches(d.torques, "dtorques");
  const auto rubs = static_cast<Eigen::Index>(program.friction.pairs.size());
  if (d.friction.size() > 0 && d.friction.size() != rubs) {
    throw ModelError("dfriction has " + std::to_string(d.friction.size()) + " entries; it has " +
                     std::to_string(rubs) +
                     ", one for each pair that pushes with friction in the "
                     "step (rubbing)");
  }
}

void StepDerivatives::Impl::check(const StateDirection& covector) const {
  check_vector(covector.q, model.tree.n_v, "q_hat", "velocities");
  check_vector(covector.p, model.tree.n_v, "p_hat", "velocities");
}

Tangent StepDerivatives::Impl::push(const StepDirection& by, Order order) {
  Tangent z{by.q.size() > 0 ? by.q : program.zero, by.p.size() > 0 ? by.p : program.zero, 0, 0};
  push_program(model, tape, by, order, program, z);
  return z;
}

void StepDerivatives::Impl::set_columns(Input input, MatX& out) {
  push_columns(model, tape, input, program, dense, out);
}

/// The largest difference of A by other orders of the impact, relative to its largest entry.
double StepDerivatives::Impl::spread(const MatX& A, std::size_t index, Smoothness& verdict) {
  constexpr int most = 64;  // orders; of many contacts these are a sample
  if (is_matched() || !program.impacts[index]->rubbing.empty()) {
    verdict = worse(verdict, Smoothness::selection);
    return std::numeric_limits<double>::quiet_NaN();
  }
  ImpactPieces& impact = *program.impacts[index];
  const auto orders = find_orders(model, tape.impacts[index], impact, most);
  double out = 0;
  MatX other;
  for (std::size_t k = 1; k < orders.size(); ++k) {
    if (!is_same_outcome(orders[k].p, orders[0].p)) {
      verdict = worse(verdict, Smoothness::order_dependent);
      continue;
    }
    set_impulses(model, tape, orders[k].contacts, impact);
    set_columns(Input::state, other);
    out = std::max(out, (other - A).cwiseAbs().maxCoeff() / A.cwiseAbs().maxCoeff());
  }
  if (orders.size() > 1) set_impulses(model, tape, orders[0].contacts, impact);
  if (out > 1e-9) verdict = worse(verdict, Smoothness::selection);
  return out;
}

void StepDerivatives::Impl::judge(StepDerivative& out) {
  for (int k = 0; k < program.n_impacts; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const TapeImpact& told = tape.impacts[i];
    ImpactPieces& impact = *program.impacts[i];
    out.impacts.push_back(describe(model, told, impact));
    ImpactDerivative& own = out.impacts.back();
    if (told.contacts.size() > 1 && !told.is_together)
      own.spread = spread(out.A, i, out.smoothness);
    for (std::size_t j = 0; j < told.contacts.size(); ++j) {
      const int pair = told.contacts[j].pair;
      const double touch = shared.pair(pair).touch;
      if (own.depth < 100 * touch) out.smoothness = worse(out.smoothness, Smoothness::grazing);
    }
    const bool is_at_end = impact.arrival.q.size() == 0;
    int approaching = 0;
    for (const TapeContact& c : told.contacts) approaching += c.u < -c.epsilon_u;
    const bool is_several = told.is_together && approaching > 1;
    if (is_at_end || is_several || !own.weak.empty()) {
      out.smoothness = worse(out.smoothness, Smoothness::one_sided);
    }
  }
  if (is_at_edge()) out.smoothness = worse(out.smoothness, Smoothness::one_sided);
  if (program.n_passings > 0 || tape.has_settled)
    out.smoothness = worse(out.smoothness, Smoothness::grazing);
}

/// Some contact is at the edge of its cone.
bool StepDerivatives::Impl::is_at_edge() const {
  bool found = false;
  for (int k = 0; k < program.n_arcs; ++k) {
    found = found || program.arcs[static_cast<std::size_t>(k)]->is_at_edge();
  }
  for (int k = 0; k < program.n_impacts; ++k) {
    const ImpactPieces& impact = *program.impacts[static_cast<std::size_t>(k)];
    found = found || (impact.is_together && impact.kick.is_at_edge);
    for (const FrictionDerivative& each : impact.rubbing) found = found || each.is_at_edge();
  }
  return found;
}

StepDerivatives::StepDerivatives(const Model& model, const StepOptions& options)
    : impl_(std::make_unique<Impl>(model, options)) {}
StepDerivatives::~StepDerivatives() = default;
StepDerivatives::StepDerivatives(StepDerivatives&&) noexcept = default;
StepDerivatives& StepDerivatives::operator=(StepDerivatives&&) noexcept = default;

void StepDerivatives::linearize(const Tape& tape) {
  impl_->is_set = false;
  if (!tape.is_whole) impl_->need_step();
  impl_->tape = tape;
  set_program(impl_->model, impl_->tape, impl_->program);
  impl_->is_set = true;
}

const std::vector<int>& StepDerivatives::rubbing() const {
  impl_->need_step();
  return impl_->program.friction.pairs;
}

StateDirection StepDerivatives::jvp(const StepDirection& direction) {
  impl_->need_step();
  impl_->check(direction);
  Tangent z = impl_->push(direction);
  return {std::move(z.q), std::move(z.p)};
}

StateDirection StepDerivatives::directional(const StepDirection& direction) {
  impl_->need_orders();
  impl_->check(direction);
  Tangent z = impl_->push(direction, Order::of_direction);
  return {std::move(z.q), std::move(z.p)};
}

StepDirection StepDerivatives::Impl::pull(const StateDirection& covector, bool with_parameters) {
  need_step();
  check(covector);
  Tangent z{covector.q, covector.p, 0, 0};
  StepDirection out;
  pull_program(model, tape, program, z, out, with_parameters ? &parameters : nullptr);
  out.q = std::move(z.q);
  out.p = std::move(z.p);
  return out;
}

StepDirection StepDerivatives::vjp(const StateDirection& covector) {
  return impl_->pull(covector, false);
}

StepDirection StepDerivatives::vjp(const StateDirection& covector, ModelGradient& by_model) {
  StepDirection out = impl_->pull(covector, true);
  const ParameterGradient& all = impl_->parameters;
  by_model = {by_link(impl_->model, all),
              all.stiffness,
              all.rest,
              all.damping,
              all.armature,
              all.actuators,
              all.springs,
              all.dampers,
              by_joint(impl_->model, all.placement),
              by_pair(all, impl_->program.friction)};
  return out;
}

void StepDerivatives::derivative(MatX& A, MatX& B) {
  impl_->need_step();
  impl_->set_columns(Input::state, A);
  impl_->set_columns(Input::control, B);
}

StepDerivative StepDerivatives::derivative() {
  StepDerivative out;
  derivative(out.A, out.B);
  impl_->set_columns(Input::qfrc, out.qfrc);
  impl_->set_columns(Input::restitution, out.restitution);
  impl_->set_columns(Input::friction, out.friction);
  out.rubbing = rubbing();
  impl_->set_columns(Input::forces, out.forces);
  impl_->set_columns(Input::torques, out.torques);
  if (impl_->program.tells_time) {
    StepDirection by;
    by.h = 1;
    const Tangent z = impl_->push(by);
    out.h.resize(2 * z.q.size());
    out.h << z.q, z.p;
  }
  impl_->judge(out);
  return out;
}

std::vector<Selection> StepDerivatives::selections(int most) {
  impl_->need_orders();
  std::vector<Selection> out;
  for (int k = 0; k < impl_->program.n_impacts; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const TapeImpact& told = impl_->tape.impacts[i];
    ImpactPieces& impact = *impl_->program.impacts[i];
    if (told.contacts.size() < 2 || told.is_together || !impact.rubbing.empty()) continue;
    const auto orders = find_orders(impl_->model, told, impact, most);
    for (const ImpactOrderFound& order : orders) {
      Selection selection{k, {}, order.p, {}};
      for (const int c : order.contacts) {
        selection.pairs.push_back(told.contacts[static_cast<std::size_t>(c)].pair);
      }
      if (is_same_outcome(order.p, orders[0].p)) {
        set_impulses(impl_->model, impl_->tape, order.contacts, impact);
        impl_->set_columns(Input::state, selection.A);
      }
      out.push_back(std::move(selection));
    }
    set_impulses(impl_->model, impl_->tape, orders[0].contacts, impact);
  }
  return out;
}

std::string smoothness_name(Smoothness smoothness) {
  switch (smoothness) {
    case Smoothness::smooth:
      return "smooth";
    case Smoothness::selection:
      return "selection";
    case Smoothness::one_sided:
      return "one_sided";
    case Smoothness::order_dependent:
      return "order_dependent";
    case Smoothness::grazing:
      break;
  }
  return "grazing";
}

}  // namespace saltus
