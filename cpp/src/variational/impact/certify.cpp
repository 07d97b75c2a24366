#include "variational/impact/certify.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

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

}  // namespace saltus
