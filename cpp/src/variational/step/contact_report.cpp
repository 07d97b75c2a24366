#include "variational/step/contact_report.hpp"

#include <algorithm>
#include "variational/step/stepper_impl.hpp"

namespace saltus {
namespace {

/// Adds an impulse to what is known of its pair. The moment of the sum is that of its parts where
/// the normal is the same (and the friction in proportion): of what slides on a plane, for
/// instance.
void add(const ContactImpulse& more, ContactImpulse& known) {
  const double lambda = known.lambda + more.lambda;
  known.p_W += more.p_W;
  if (lambda != 0) {
    const double part = more.lambda / lambda;
    known.point_W += part * (more.point_W - known.point_W);
    known.n_W = (known.n_W + part * (more.n_W - known.n_W)).normalized();
  }
  known.lambda = lambda;
}

void tell(const ContactImpulse& impulse, StepReport& report) {
  if (impulse.lambda == 0 && impulse.p_W.isZero(0)) return;
  for (ContactImpulse& known : report.contacts) {
    if (known.pair == impulse.pair) return add(impulse, known);
  }
  report.contacts.push_back(impulse);
}

/// How far an arc or a half kick with these contacts is from Coulomb's law.
void tell_residual(const ContactBlocks& W, double residual, StepReport& report) {
  const auto has_friction = [](double mu) { return mu > 0; };
  if (std::none_of(W.friction.begin(), W.friction.end(), has_friction)) return;
  report.friction_residual = std::max(report.friction_residual, residual);
}

}  // namespace

const StepReport& Stepper::report() const { return impl_->report; }
const Model& Stepper::model() const { return impl_->scene.shared; }
const StepOptions& Stepper::options() const { return impl_->scene.options; }

void clear(StepReport& report) {
  report.iterations = report.arcs = report.sustained = 0;
  report.work.setZero();
  report.loops.setZero();
  report.residual = report.friction_residual = 0;
  report.impacts.clear();
  report.impulses.clear();
  report.contacts.clear();
  report.settlings.clear();
  report.certificates.clear();
}

void tell_rows(const Node& node, const Rows& rows, StepReport& report) {
  tell_residual(rows.W, rows.residual, report);
  report.sustained += count_pressed(rows);
  for (const int i : rows.active) {
    const Row& row = rows.row[i];
    if (row.is_joint()) continue;
    const Contact& contact = contact_of(node, row);
    tell(acted(node, contact, row.p[0], across(contact, row.p)), report);
  }
}

void tell_launch(const Launch& launch, const Flight& f, StepReport& report) {
  const LaunchLine& line = f.work.line;
  if (line.use != LaunchLine::Use::none && line.lambda != 0) {
    report.impulses[static_cast<std::size_t>(launch.impulse)].lambda += line.lambda;
  }
  if (!f.has_missed_energy) return;
  report.impacts.back().fallback = true;
  report.impacts.back().law = ImpactLaw::nodal_energy;
}

void tell_settlings(const PairPool& pool, const Flight& f, StepReport& report) {
  for (const Settling& each : f.settlings) {
    report.settlings.push_back({each.t, pool.number(each.pair)});
  }
}

void tell_half_kick(const HalfKick& kick, StepReport& report) {
  if (kick.impulses.empty()) return;
  tell_residual(kick.W, kick.residual, report);
  tell(kick.impulses, report);
}

void tell(const std::vector<ContactImpulse>& impulses, StepReport& report) {
  for (const ContactImpulse& each : impulses) tell(each, report);
}

}  // namespace saltus
