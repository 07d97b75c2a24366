// Second derivatives of smooth steps.
#include "derivatives/step_impl.hpp"

namespace saltus {

FlownArc& StepDerivatives::Impl::only_arc() {
  need_step();
  if (program.pieces.size() != 1 || program.pieces.front().kind != StepProgram::Kind::rest) {
    throw ModelError(
        "the step has no second derivative yet: it has an impact, or more than one arc");
  }
  FlownArc& arc = *program.arcs.front();
  check_curvature(model, arc);
  return arc;
}

StepDirection StepDerivatives::Impl::bend(const StepDirection& direction) {
  FlownArc& flown = *program.arcs.front();
  const auto or_zero = [&](const VecX& x) { return x.size() > 0 ? x : program.zero; };
  Tangent z{or_zero(direction.q), or_zero(direction.p), 0, 0};
  StepDirection out;
  out.qfrc = or_zero(direction.qfrc);
  if (direction.control.size() > 0) out.qfrc += flown.arc.Q_u * direction.control;
  out.h = push_curvature(model, flown.arc, direction.h, bent, out.qfrc, z);
  out.control = flown.arc.Q_u.transpose() * out.qfrc;
  out.q = std::move(z.q);
  out.p = std::move(z.p);
  return out;
}

StepDirection StepDerivatives::hvp(const StateDirection& of, const StepDirection& direction) {
  FlownArc& arc = impl_->only_arc();
  impl_->check(direction);
  impl_->check(of);
  set_arc_covector(impl_->model, arc.arc, {of.q, of.p, 0, 0}, impl_->bent);
  return impl_->bend(direction);
}

MatX StepDerivatives::hessian(const StateDirection& of) {
  FlownArc& arc = impl_->only_arc();
  impl_->check(of);
  set_arc_covector(impl_->model, arc.arc, {of.q, of.p, 0, 0}, impl_->bent);
  const Eigen::Index n = impl_->model.tree.n_v, n_u = impl_->model.forces.n_u();
  MatX out(2 * n + n_u + 1, 2 * n + n_u + 1);
  for (Eigen::Index c = 0; c < out.cols(); ++c) {
    StepDirection by;
    if (c < n) by.q = VecX::Unit(n, c);
    if (c >= n && c < 2 * n) by.p = VecX::Unit(n, c - n);
    if (c >= 2 * n && c < 2 * n + n_u) by.control = VecX::Unit(n_u, c - 2 * n);
    if (c == 2 * n + n_u) by.h = 1;
    const StepDirection column = impl_->bend(by);
    out.col(c) << column.q, column.p, column.control, column.h;
  }
  return (out + out.transpose()) / 2;
}

}  // namespace saltus
