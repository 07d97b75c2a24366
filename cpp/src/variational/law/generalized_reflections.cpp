#include "variational/law/generalized_reflections.hpp"

#include <algorithm>
#include <cmath>

#include "variational/law/contact_problem.hpp"
#include "variational/law/contact_qp.hpp"

namespace saltus {
namespace {

using Part = std::vector<int>;

/// The contacts with `in`, each with those that it feels, directly or through others.
std::vector<Part> parts_of(const ContactMatrix& G, std::vector<char> in) {
  std::vector<Part> parts;
  for (int seed = 0; seed < G.size(); ++seed) {
    if (!in[seed]) continue;
    Part part{seed};
    in[seed] = 0;
    for (std::size_t at = 0; at < part.size(); ++at) {
      for (int k = G.start[part[at]]; k < G.start[part[at] + 1]; ++k) {
        const int j = G.column[k];
        if (!in[j] || G.value[k] == 0) continue;
        in[j] = 0;
        part.push_back(j);
      }
    }
    std::sort(part.begin(), part.end());
    parts.push_back(std::move(part));
  }
  return parts;
}

/// The e of a part, by the energy that each contact takes up.
double shared_restitution(const VecX& e, const VecX& lambda, const VecX& u) {
  if ((e.array() == e[0]).all()) return e[0];
  const VecX weight = lambda.cwiseProduct(u.cwiseAbs());
  return std::sqrt(e.cwiseAbs2().dot(weight) / weight.sum());
}

/// One reflection; u of the part that it belongs to and of all others that feel it.
void reflect(const ContactMatrix& G, const Part& part, const VecRef& restitution,
             Eigen::Ref<VecX> u, std::vector<Impulse>& impulses) {
  const VecX before = u(part), lambda = contact_multipliers(dense_part(G, part), before);
  const double e = shared_restitution(restitution(part), lambda, before);
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
