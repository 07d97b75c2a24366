// What an impact does to the momenta at a node (theory, sections 5 and 6).
#include <algorithm>
#include <cmath>
#include <numeric>

#include "variational/impact/certify.hpp"
#include "variational/impact/custom_law.hpp"
#include "variational/law/contact_problem.hpp"
#include "variational/law/contact_qp.hpp"
#include "variational/node/node.hpp"

namespace saltus {
namespace {

/// Kinetic energy u^2 / 2G of the approach that an impulse turns round; lambda = -(1 + e) u / G.
double normal_energy(const Node& node, const Impulse& impulse) {
  const double u_G = impulse.lambda / (1 + node.restitution[impulse.pair]);
  return u_G * u_G * node.G.diagonal[impulse.pair] / 2;
}

/// What restitution takes: T changes by lambda . (u- + u+) / 2, whatever the order of the impulses.
double lost_energy(const Node& node) {
  double gained = 0;
  bool elastic = true;
  for (const Impulse& impulse : node.impulses) {
    const double before = node.contacts[impulse.pair].u, after = node.u[impulse.pair];
    gained += impulse.lambda * (before + after) / 2;
    elastic = elastic && node.restitution[impulse.pair] == 1;
  }
  return elastic ? 0 : -gained;  // not the rounding of nothing
}

/// Says what the arc after the impact has to match, and by a change of which impulse: the last
/// strong one (theory, section 5, warning a).
/// @param first of this impact's impulses in the report
void prepare_launch(double energy, int first, Node& node) {
  double strongest = 0;
  for (const Impulse& impulse : node.impulses) {
    strongest = std::max(strongest, normal_energy(node, impulse));
  }
  node.launch.change = 0;
  for (std::size_t k = 0; k < node.impulses.size(); ++k) {
    const Impulse& impulse = node.impulses[k];
    const double part = normal_energy(node, impulse);
    if (!(part > 1e-3 * strongest)) continue;
    node.launch.impulse = first + static_cast<int>(k);
    node.launch.normal_energy = part;
    node.launch.n.setZero();
    add(node.trees, 1, node.contacts[impulse.pair].n, node.launch.n);
  }
  node.launch.pending = true;
  node.launch.energy = energy - lost_energy(node);
}

/// v from p, and what every contact does now.
void settle_velocities(const ModelData& model, const StepOptions& options, Node& node) {
  const double speed = typical_speed(model, options, node);
  node.v = node.p;  // without the rounding that the cascade's updates have gathered
  solve(model.tree, model.packed, node.M, node.v);
  for (int i = 0; i < node.touching; ++i) {
    node.held[node.contacts[i].pair] = 0;
    classify(node, speed, options.rest, node.contacts[i]);
  }
}

/// p += sum lambda_i n_i
void apply_impulses(Node& node) {
  for (const Impulse& impulse : node.impulses) {
    add(node.trees, impulse.lambda, node.contacts[impulse.pair].n, node.p);
  }
}

/// The impact of all impulses in the report from `first` on.
void tell_impact(const Node& node, int first, ImpactLaw law, bool fallback, StepReport& report) {
  const int count = static_cast<int>(report.impulses.size()) - first;
  report.impacts.push_back({node.t, first, count, node.touching, law, fallback});
}

void tell_reflections(const Node& node, ImpactLaw law, StepReport& report) {
  const int first = static_cast<int>(report.impulses.size());
  for (const Impulse& impulse : node.impulses) {
    const Contact& c = node.contacts[impulse.pair];
    report.impulses.push_back(acted(node, c, impulse.lambda, Vec3::Zero()));
  }
  tell_impact(node, first, law, false, report);
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
bool order_was_free(const Node& node, const std::vector<int>& group) {
  const ContactBlocks& W = node.friction.W;
  VecX u(W.size());
  for (int i = 0; i < W.size(); ++i) u[i] = node.contacts[i].u;
  std::vector<int> approaching;
  for (const FrictionImpulse& each : node.friction.impulses) {
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

/// Of impacts with friction no theory tells for all velocities whether the order matters. This
/// tells whether it did for those that were. Contacts without rebound have no order.
std::string certify_with_friction(const Node& node) {
  const ContactBlocks& W = node.friction.W;
  const std::vector<int> group = coupled_groups(W);
  std::vector<char> hit(group.size(), 0);
  for (const FrictionImpulse& each : node.friction.impulses) hit[group[each.contact]] = 1;
  const auto reached = std::count_if(group.begin(), group.end(), [&](int g) { return hit[g]; });
  if (reached < 2) return "";
  if (std::all_of(W.restitution.begin(), W.restitution.end(), [](double e) { return e == 0; })) {
    return "unique, plastic";
  }
  return order_was_free(node, group) ? "order_dependent" : "unique";
}

/// What friction takes is not known before: no energy is there to be matched, and every law is
/// nodal_energy.
bool resolve_with_friction(const ModelData& model, const StepOptions& options, Node& node,
                           StepReport& report) {
  if (!collide_at_node(model, {options.order, options.max_impulses}, node)) return false;
  const int first = static_cast<int>(report.impulses.size());
  for (const FrictionImpulse& each : node.friction.impulses) {
    const Contact& c = node.contacts[each.contact];
    report.impulses.push_back(acted(node, c, each.p[0], across(c, each.p)));
  }
  constexpr ImpactLaw law = ImpactLaw::nodal_energy;
  tell_impact(node, first, law, options.law != law, report);
  if (options.certify) report.certificates.push_back(certify_with_friction(node));
  settle_velocities(model, options, node);
  return true;
}

}  // namespace

bool can_open(const Node& node) {
  std::vector<int> all(static_cast<std::size_t>(node.G.size()));
  std::iota(all.begin(), all.end(), 0);
  return cone_interior(dense_part(node.G, all)) > 0;
}

bool resolve_node_impact(const ModelData& model, const StepOptions& options, double energy,
                         Node& node, StepReport& report) {
  if (options.law != ImpactLaw::custom && has_friction(node)) {
    return resolve_with_friction(model, options, node, report);
  }
  set_contact_matrix(model, node);
  const int m = node.touching;
  node.impulses.clear();
  if (options.law == ImpactLaw::custom) {
    obey_custom_law(model, options.custom, node);
  } else {
    CascadeOptions cascade_options{options.order, options.max_impulses};
    if (!cascade(node.G, node.u.head(m), node.rest.head(m), node.restitution.head(m),
                 cascade_options, node.cascade, node.impulses)) {
      return false;
    }
    apply_impulses(node);
    if (options.law != ImpactLaw::nodal_energy) {
      prepare_launch(energy, static_cast<int>(report.impulses.size()), node);
    }
  }
  tell_reflections(node, options.law, report);
  if (options.certify) report.certificates.push_back(certify(node));
  settle_velocities(model, options, node);
  return true;
}

}  // namespace saltus
