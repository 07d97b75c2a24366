#include "variational/law/friction_scratch.hpp"

namespace saltus {

FrictionScratch::FrictionScratch(bool with_friction) : any(with_friction) {
  if (!any) return;
  constexpr std::size_t a_few_boxes = 16;
  reserve(a_few_boxes);
  impulses.reserve(1024);
}

void FrictionScratch::reserve(std::size_t contacts) {
  if (contacts <= contact.capacity()) return;
  W.start.reserve(contacts + 1);
  W.contact.reserve(contacts * contacts);
  W.block.reserve(contacts * contacts);
  W.own.reserve(contacts);
  for (auto* each : {&W.friction, &W.restitution, &W.rest}) each->reserve(contacts);
  for (auto* each : {&u, &p}) each->reserve(contacts);
  contact.reserve(contacts);
  pile.reserve(contacts);
}

int most_lawless(const FrictionScratch& x) {
  int most = 0;
  double worst = 0;
  for (int i = 0; i < static_cast<int>(x.W.own.size()); ++i) {
    const double each = lawlessness_of(x.W, i, x.u[i], x.p[i]);
    if (each > worst) worst = each, most = i;
  }
  return most;
}

}  // namespace saltus
