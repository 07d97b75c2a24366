#include "variational/contact_report.hpp"

#include <algorithm>

#include "variational/slip_blocks.hpp"

namespace saltus {
namespace {

void tell(int pair, double lambda, const Vec3& p_W, StepReport& report) {
  if (lambda == 0 && p_W.isZero(0)) return;
  const auto known = std::find_if(report.contacts.begin(), report.contacts.end(),
                                  [&](const ContactImpulse& each) { return each.pair == pair; });
  if (known == report.contacts.end()) {
    report.contacts.push_back({pair, lambda, p_W});
  } else {
    known->lambda += lambda;
    known->p_W += p_W;
  }
}

}  // namespace

void tell_holds(const Node& node, Flight& f, StepReport& report) {
  for (int i = 0; i < f.active; ++i) {
    const ArcConstraint& c = f.constraints[i];
    if (c.kind != ArcConstraint::Kind::hold) continue;
    const Vec3 p = impulse_of(c);
    tell(node.pool.number(c.place), p[0], across(contact_of(node, c), p), report);
  }
}

void tell_closing(Node& node, StepReport& report) {
  for (const ContactImpulse& each : node.closing) {
    tell(node.pool.number(each.pair), each.lambda, each.p_W, report);
  }
  node.closing.clear();
}

}  // namespace saltus
