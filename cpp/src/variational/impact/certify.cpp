#include "variational/impact/certify.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numeric>

#include "saltus/variational/certificate.hpp"
#include "variational/law/contact_problem.hpp"

namespace saltus {
namespace {

/// The contacts that impulses can have reached, ascending: those connected by entries of G with
/// one.
std::vector<int> reached(const ImpactScratch& s) {
  const ContactMatrix& G = s.G;
  std::vector<char> seen(static_cast<std::size_t>(G.size()), 0);
  std::vector<int> list;
  const auto add = [&](int i) {
    if (seen[i]) return;
    seen[i] = 1;
    list.push_back(i);
  };
  for (const Impulse& impulse : s.impulses) add(impulse.pair);
  for (std::size_t k = 0; k < list.size(); ++k) {
    for (int j = G.start[list[k]]; j < G.start[list[k] + 1]; ++j) {
      // what two contacts on different sides of a body leave of each other may be rounding
      const double scale = G.diagonal[list[k]] * G.diagonal[G.column[j]];
      if (G.value[j] * G.value[j] > 1e-24 * scale) add(G.column[j]);
    }
  }
  std::sort(list.begin(), list.end());
  return list;
}

/// Contacts that feel each other, through others too, have one number.
std::vector<int> coupled_groups(const ContactBlocks& W) {
  std::vector<int> group(static_cast<std::size_t>(W.size()));
  std::iota(group.begin(), group.end(), 0);
  for (int i = 0; i < W.size(); ++i) {
    for (int k = W.start[i]; k < W.start[i + 1]; ++k) {
      const int j = W.contact[k], from = group[j], to = group[i];
      // what two contacts on different sides of a body leave of each other may be rounding
      const double scale = W.own[i].trace() * W.own[j].trace();
      if (from == to || !(W.block[k].squaredNorm() > 1e-24 * scale)) continue;
      std::replace(group.begin(), group.end(), from, to);
    }
  }
  return group;
}

/// True where impulses could have come in another order that matters: at some time two contacts
/// approached that feel each other.
bool order_was_free(const Node& node, const ImpactScratch& s, const std::vector<int>& group) {
  const ContactBlocks& W = s.friction.W;
  VecX u(W.size());
  for (int i = 0; i < W.size(); ++i) u[i] = node.contacts[i].u;
  std::vector<int> approaching;
  for (const FrictionImpulse& each : s.friction.impulses) {
    approaching.assign(group.size(), 0);
    for (int i = 0; i < W.size(); ++i) {
      if (u[i] < -W.rest[i] && ++approaching[group[i]] > 1) return true;
    }
    for (int k = W.start[each.contact]; k < W.start[each.contact + 1]; ++k) {
      u[W.contact[k]] += W.block[k].row(0).dot(each.p);
    }
  }
  return false;
}

}  // namespace

// Angles depend on G alone, so that M = 1 and N = sqrt(G) stand for the bodies, however many.
std::string certify(const ImpactScratch& s) {
  const std::vector<int> list = reached(s);
  const auto m = static_cast<Eigen::Index>(list.size());
  if (m < 2) return "";
  const Eigen::MatrixXd G = dense_part(s.G, list);
  VecX restitution(m);
  for (Eigen::Index i = 0; i < m; ++i) restitution[i] = s.restitution[list[i]];
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(G);
  const VecX root = eigen.eigenvalues().cwiseMax(0).cwiseSqrt();
  const MatX N = eigen.eigenvectors() * root.asDiagonal() * eigen.eigenvectors().transpose();
  return describe(classify_impact(MatX::Identity(m, m), N, restitution));
}

// Of impacts with friction no theory tells for all velocities whether the order matters. This
// tells whether it did for those that were. Contacts without rebound have no order.
std::string certify_with_friction(const Node& node, const ImpactScratch& s) {
  const ContactBlocks& W = s.friction.W;
  const std::vector<int> group = coupled_groups(W);
  std::vector<char> hit(group.size(), 0);
  for (const FrictionImpulse& each : s.friction.impulses) hit[group[each.contact]] = 1;
  const auto reached = std::count_if(group.begin(), group.end(), [&](int g) { return hit[g]; });
  if (reached < 2) return "";
  if (std::all_of(W.restitution.begin(), W.restitution.end(), [](double e) { return e == 0; })) {
    return "unique, plastic";
  }
  return order_was_free(node, s, group) ? "order_dependent" : "unique";
}

}  // namespace saltus
