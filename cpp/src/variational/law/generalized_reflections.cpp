#include "variational/law/generalized_reflections.hpp"

#include <algorithm>
#include <cmath>

#include "variational/law/contact_parts.hpp"
#include "variational/law/contact_problem.hpp"
#include "variational/law/contact_qp.hpp"

namespace saltus {
namespace {

std::vector<Part> parts_of(const ContactMatrix& G, const std::vector<char>& in) {
  return saltus::parts_of(G.start, G.column, [&](int k) { return G.value[k] != 0; }, in);
}

/// One reflection; u of the part that it belongs to and of all others that feel it.
void reflect(const ContactMatrix& G, const Part& part, const VecRef& restitution,
             Eigen::Ref<VecX> u, std::vector<Impulse>& impulses) {
  const VecX before = u(part), lambda = contact_multipliers(dense_part(G, part), before);
  const double e = shared_restitution(restitution(part), lambda.cwiseProduct(before.cwiseAbs()));
  for (std::size_t row = 0; row < part.size(); ++row) {
    const int i = part[row];
    const double impulse = (1 + e) * lambda[static_cast<Eigen::Index>(row)];
    if (impulse == 0) continue;
    for (int k = G.start[i]; k < G.start[i + 1]; ++k) u[G.column[k]] += G.value[k] * impulse;
    impulses.push_back({i, impulse});
  }
  for (std::size_t row = 0; row < part.size(); ++row) {
    const auto at = static_cast<Eigen::Index>(row);
    if (lambda[at] > 0) u[part[row]] = -e * before[at];  // without the rounding of G lambda
  }
}

}  // namespace

bool reflect_together(const ContactMatrix& G, Eigen::Ref<VecX> u, const VecRef& rest,
                      const VecRef& restitution, int max_impulses, std::vector<Impulse>& impulses) {
  const auto first = impulses.size();
  std::vector<char> approaches(static_cast<std::size_t>(G.size()));
  for (;;) {
    for (int i = 0; i < G.size(); ++i) approaches[i] = u[i] < -rest[i];
    const std::vector<Part> parts = parts_of(G, approaches);
    if (parts.empty()) return true;
    if (impulses.size() - first >= static_cast<std::size_t>(max_impulses)) return false;
    // parts do not feel each other, so that one after the other is all at once
    for (const Part& part : parts) reflect(G, part, restitution, u, impulses);
  }
}

void project(const ContactMatrix& G, Eigen::Ref<VecX> u, const VecRef& rest,
             std::vector<Impulse>& impulses) {
  const VecX plastic = VecX::Zero(G.size());
  const std::vector<char> all(static_cast<std::size_t>(G.size()), 1);
  for (const Part& part : parts_of(G, all)) {
    const bool rests = ((u + rest)(part).array() >= 0).all();
    if (!rests) reflect(G, part, plastic, u, impulses);
  }
}

}  // namespace saltus
