#include "variational/step/contact_report.hpp"

#include "variational/flight/slip_blocks.hpp"

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

void tell_holds(const Node& node, Flight& f, StepReport& report) {
  for (int i = 0; i < f.active; ++i) {
    const ArcConstraint& c = f.constraints[i];
    if (c.kind != ArcConstraint::Kind::hold) continue;
    const Contact& contact = contact_of(node, c);
    const Vec3 p = impulse_of(c);
    tell(acted(node, contact, p[0], across(contact, p)), report);
  }
}

void tell_launch(const Flight& f, Node& node, StepReport& report) {
  double change = node.launch.change;
  node.launch.change = 0;
  for (int i = 0; i < f.active; ++i) {
    const ArcConstraint& c = f.constraints[i];
    if (c.kind == ArcConstraint::Kind::launch) change += c.lambda;
  }
  if (change != 0) {
    report.impulses[static_cast<std::size_t>(node.launch.impulse)].lambda += change;
  }
}

void tell_closing(Node& node, StepReport& report) {
  for (const ContactImpulse& each : node.closing) tell(each, report);
  node.closing.clear();
}

}  // namespace saltus
