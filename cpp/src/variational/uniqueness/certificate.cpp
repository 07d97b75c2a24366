#include "saltus/variational/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

#include "saltus/error.hpp"
#include "variational/law/contact_problem.hpp"
#include "variational/law/contact_qp.hpp"
#include "variational/uniqueness/coxeter.hpp"

namespace saltus {
namespace {

using std::numbers::pi;

/// Normals are one where their angle is pi to this, the root of rounding: 1 + cos is known to
/// 1e-16.
constexpr double same_normal = 1e-7;

MatX wedge_angles(const MatX& G) {
  const VecX root = G.diagonal().cwiseSqrt();
  MatX angles(G.rows(), G.cols());
  for (Eigen::Index i = 0; i < G.rows(); ++i) {
    for (Eigen::Index j = 0; j < G.cols(); ++j) {
      angles(i, j) = std::acos(std::clamp(-G(i, j) / (root[i] * root[j]), -1.0, 1.0));
    }
    angles(i, i) = pi;
  }
  return angles;
}

std::vector<int> first_with_normal(const MatX& angles) {
  std::vector<int> same;
  for (int i = 0; i < angles.rows(); ++i) {
    int first = 0;
    while (angles(first, i) < pi - same_normal) ++first;
    same.push_back(first);
  }
  return same;
}

/// The m with theta = pi/m to `tolerance`, or 0.
int part_of_half_turn(double theta, double tolerance) {
  const double m = std::round(pi / theta);
  return m >= 2 && m < 1e6 && std::abs(m * theta / pi - 1) <= tolerance ? static_cast<int>(m) : 0;
}

/// Contacts that feel each other, directly or through others.
using Group = std::vector<int>;

std::vector<Group> groups_of(const MatX& angles, const std::vector<int>& same, double tolerance) {
  std::vector<Group> groups;
  std::vector<char> done(same.size());
  for (int seed = 0; seed < angles.rows(); ++seed) {
    if (done[seed] || same[seed] != seed) continue;
    Group group{seed};
    done[seed] = 1;
    for (std::size_t at = 0; at < group.size(); ++at) {
      for (int j = 0; j < angles.rows(); ++j) {
        if (done[j] || same[j] != j) continue;
        if (part_of_half_turn(angles(group[at], j), tolerance) == 2) continue;
        done[j] = 1;
        group.push_back(j);
      }
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

struct Verdict {
  std::string type;              ///< empty if not unique
  std::optional<long> impulses;  ///< bound
};

Verdict judge(const Group& group, const MatX& angles, bool elastic, double tolerance) {
  if (group.size() == 1) return {"A1", 1};
  if (!elastic) return {"", {}};
  std::vector<Edge> edges;
  for (int a = 0; a < static_cast<int>(group.size()); ++a) {
    for (int b = a + 1; b < static_cast<int>(group.size()); ++b) {
      const double theta = angles(group[a], group[b]);
      const int m = part_of_half_turn(theta, tolerance);
      if (m == 0 && group.size() == 2) {
        return {"", static_cast<long>(std::ceil(pi / theta))};
      }
      if (m == 0) return {"", {}};
      if (m > 2) edges.push_back({a, b, m});
    }
  }
  ReflectionGroup found = finite_group(static_cast<int>(group.size()), edges);
  if (found.type.empty()) return {"", {}};
  return {std::move(found.type), found.mirrors};
}

/// "A3 x A1^2" of A1, A3, A1, whose ranks are the sizes.
std::string product_name(const std::vector<std::pair<int, std::string>>& factors) {
  std::map<std::pair<int, std::string>, int> count;  // by falling rank, then by name
  for (const auto& [rank, name] : factors) ++count[{-rank, name}];
  std::string text;
  for (const auto& [factor, times] : count) {
    text += (text.empty() ? "" : " x ") + factor.second;
    if (times > 1) text += "^" + std::to_string(times);
  }
  return text;
}

/// Groups are unique together if each is.
void certify(const VecRef& e, double tolerance, ImpactCertificate& out) {
  std::vector<std::pair<int, std::string>> factors;
  bool unique = true;
  out.impulses = 0;
  for (const Group& group : groups_of(out.angles, out.same, tolerance)) {
    bool elastic = true, alike = true;
    for (int i = 0; i < e.size(); ++i) {
      const int first = out.same[i];
      if (std::find(group.begin(), group.end(), first) == group.end()) continue;
      elastic = elastic && e[i] == 1;
      alike = alike && e[i] == e[first];
    }
    // one normal with two e: whichever comes first decides
    Verdict verdict = alike ? judge(group, out.angles, elastic, tolerance) : Verdict{};
    unique = unique && !verdict.type.empty();
    factors.emplace_back(static_cast<int>(group.size()), std::move(verdict.type));
    if (!verdict.impulses) {
      out.impulses.reset();
    } else if (out.impulses) {
      *out.impulses += *verdict.impulses;
    }
  }
  out.kind = unique ? ImpactKind::unique : ImpactKind::order_dependent;
  if (unique) out.type = product_name(factors);
}

std::string name_of(ImpactKind kind) {
  switch (kind) {
    case ImpactKind::unique:
      return "unique";
    case ImpactKind::order_dependent:
      return "order_dependent";
    case ImpactKind::jammed:
      return "jammed";
  }
  return "unknown";
}

}  // namespace

std::string describe(const ImpactCertificate& certificate) {
  std::string text = name_of(certificate.kind);
  if (!certificate.type.empty()) text += ", " + certificate.type;
  if (!certificate.impulses) return text;
  const long most = *certificate.impulses;
  return text + ", at most " + std::to_string(most) + (most == 1 ? " impulse" : " impulses");
}

ImpactCertificate classify_impact(const Eigen::Ref<const MatX>& M, const Eigen::Ref<const MatX>& N,
                                  const VecRef& restitution, const CertificateOptions& options) {
  if (!(options.tolerance > 0 && options.tolerance <= 1e-3)) {
    std::ostringstream text;
    text << "tolerance " << options.tolerance << " of angles is outside (0, 1e-3]";
    throw ModelError(text.str());
  }
  const ContactProblem problem = contact_problem(M, N, VecX(VecX::Zero(M.rows())), restitution);
  const auto m = N.rows();
  ImpactCertificate out{ImpactKind::unique, "", 0, wedge_angles(problem.G), 1, {}};
  if (m == 0) return out;
  out.same = first_with_normal(out.angles);
  out.interior = cone_interior(problem.G);
  if (m > 1 && (restitution.array() == 0).all()) {
    out.type = "plastic";
    out.impulses = m;
    return out;
  }
  certify(restitution, options.tolerance, out);
  if (out.kind == ImpactKind::order_dependent && out.interior == 0) {
    out.kind = ImpactKind::jammed;
    out.impulses.reset();
  }
  return out;
}

ImpactCertificate classify_impact(const Eigen::Ref<const MatX>& M, const Eigen::Ref<const MatX>& N,
                                  double restitution, const CertificateOptions& options) {
  return classify_impact(M, N, VecX(VecX::Constant(N.rows(), restitution)), options);
}

}  // namespace saltus
