#include "variational/step/contact_report.hpp"

#include <algorithm>

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
    // what pulls is told apart: the mean of a push and a pull is nowhere
    const bool alike = (known.lambda < 0) == (impulse.lambda < 0);
    if (known.pair == impulse.pair && alike) return add(impulse, known);
  }
  report.contacts.push_back(impulse);
}

}  // namespace

void tell_rows(const Node& node, const Flight& f, StepReport& report) {
  for (const int i : f.rows.active) {
    const Row& row = f.rows.row[i];
    const Contact& contact = node.contacts[row.contact];
    tell(acted(node, contact, row.p[0], across(contact, row.p)), report);
  }
}

void tell_residual(const Rows& rows, StepReport& report) {
  const auto& friction = rows.W.friction;
  if (std::all_of(friction.begin(), friction.end(), [](double mu) { return mu == 0; })) return;
  report.friction_residual = std::max(report.friction_residual, rows.residual);
}

void tell_launch(const Flight& f, Node& node, StepReport& report) {
  double change = node.launch.change;
  node.launch.change = 0;
  if (f.is_launched) change += f.launch.lambda;
  if (change != 0) {
    report.impulses[static_cast<std::size_t>(node.launch.impulse)].lambda += change;
  }
}

void tell_closing(const Flight& f, StepReport& report) {
  for (const ContactImpulse& each : f.closings) tell(each, report);
}

}  // namespace saltus
