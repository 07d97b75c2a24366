#include "derivatives/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace saltus {
namespace {

/// The node's contacts as the cascade sees them: u and G.
struct ContactSpace {
  MatX G;
  VecX u;
};

ContactSpace contact_space(const ModelData& model, ImpactPieces& impact) {
  NodeDerivative& node = impact.node;
  const auto m = static_cast<Eigen::Index>(node.gaps.size());
  ContactSpace out{MatX(m, m), VecX(m)};
  const auto solved = [&](VecX x) {
    solve_scaled(model.tree, model.packed, node.motion.s.J, x);
    return x;
  };
  const VecX v = solved(impact.p_before);
  for (Eigen::Index j = 0; j < m; ++j) {
    const VecX column = solved(node.gaps[static_cast<std::size_t>(j)].n);
    for (Eigen::Index i = 0; i < m; ++i) {
      out.G(i, j) = node.gaps[static_cast<std::size_t>(i)].n.dot(column);
    }
    out.u[j] = node.gaps[static_cast<std::size_t>(j)].n.dot(v);
  }
  return out;
}

/// Depth-first search over orders.
struct Search {
  const TapeImpact& told;
  const ImpactPieces& impact;
  const MatX& G;
  int most;
  std::vector<int> order;
  std::vector<ImpactOrderFound> found;

  void go(const VecX& u, const VecX& p) {
    bool ends = true;
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (!(u[i] < -told.contacts[k].epsilon_u)) continue;
      ends = false;
      const auto size = static_cast<int>(std::max(found.size(), order.size()));
      if (size >= most) return;
      const double lambda = -(1 + told.contacts[k].restitution) * u[i] / G(i, i);
      VecX after = u + lambda * G.col(i);
      after[i] = -told.contacts[k].restitution * u[i];
      order.push_back(static_cast<int>(i));
      go(after, p + lambda * impact.node.gaps[k].n);
      order.pop_back();
    }
    if (ends) found.push_back({order, p});
  }
};

}  // namespace

std::vector<ImpactOrderFound> find_orders(const ModelData& model, const TapeImpact& told,
                                          ImpactPieces& impact, int most) {
  const ContactSpace space = contact_space(model, impact);
  Search search{told, impact, space.G, most, {}, {}};
  search.go(space.u, impact.p_before);
  std::vector<int> own;
  for (const TapeImpulse& each : told.impulses) own.push_back(each.contact);
  std::vector<ImpactOrderFound> out{{own, impact.p_after}};
  for (ImpactOrderFound& each : search.found) {
    if (each.contacts != own) out.push_back(std::move(each));
  }
  return out;
}

bool is_same_outcome(const VecX& p, const VecX& other) {
  return (p - other).norm() <= 1e-9 * (p.norm() + other.norm());
}

void list_weak(const TapeImpact& told, ImpactPieces& impact, std::vector<int>& weak) {
  const VecX& v = impact.node.v;  // after the last impulse
  for (std::size_t i = 0; i < told.contacts.size(); ++i) {
    const TapeContact& c = told.contacts[i];
    const double after = impact.node.gaps[i].n.dot(v);
    // a plastic contact comes to rest by itself, and is held from then on
    const bool lands = c.restitution == 0 && c.u < -c.epsilon_u;
    if (lands) continue;
    if (std::abs(c.u) <= c.epsilon_u || std::abs(after) <= c.epsilon_u) weak.push_back(c.pair);
  }
}

ImpactDerivative describe(const ModelData& model, const TapeImpact& told, ImpactPieces& impact) {
  ImpactDerivative out{told.t, {}, 0, std::numeric_limits<double>::infinity(), {}};
  for (const ImpulseDerivative& each : impact.impulses) {
    out.pairs.push_back(told.contacts[static_cast<std::size_t>(each.contact)].pair);
    const double depth = each.u * each.u / (2 * std::abs(each.closing));
    if (depth < out.depth) out.depth = depth;
  }
  for (const FrictionDerivative& each : impact.rubbing) {
    out.pairs.push_back(told.contacts[static_cast<std::size_t>(each.contact)].pair);
    out.depth = std::min(out.depth, each.u * each.u / (2 * std::abs(each.closing)));
  }
  impact.node.v = impact.p_after;
  solve_scaled(model.tree, model.packed, impact.node.motion.s.J, impact.node.v);
  list_weak(told, impact, out.weak);
  return out;
}

Smoothness worse(Smoothness a, Smoothness b) {
  const auto rank = [](Smoothness s) {
    switch (s) {
      case Smoothness::order_dependent:
        return 4;
      case Smoothness::grazing:
        return 3;
      case Smoothness::selection:
        return 2;
      case Smoothness::one_sided:
        return 1;
      default:
        return 0;
    }
  };
  return rank(a) >= rank(b) ? a : b;
}

}  // namespace saltus
