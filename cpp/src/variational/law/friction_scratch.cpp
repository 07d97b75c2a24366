#include "variational/law/friction_scratch.hpp"

namespace saltus {

FrictionScratch::FrictionScratch(bool with_friction) : any(with_friction) {
  if (!any) return;
  constexpr std::size_t a_few_boxes = 16;
  reserve(a_few_boxes);
  impulses.reserve(1024);
}

void FrictionScratch::reserve(std::size_t contacts) {
  if (contacts <= u.capacity()) return;
  saltus::reserve(W, contacts);
  for (auto* each : {&u, &p}) each->reserve(contacts);
  pile.reserve(contacts);
}

}  // namespace saltus
