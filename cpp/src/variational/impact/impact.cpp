#include "variational/impact/impact.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "variational/impact/certify.hpp"
#include "variational/impact/custom_law.hpp"
#include "variational/law/contact_problem.hpp"
#include "variational/law/contact_qp.hpp"

namespace saltus {
namespace {

/// Kinetic energy u^2 / 2G of the approach that an impulse turns round; lambda = -(1 + e) u / G.
double normal_energy(const ImpactScratch& s, const Impulse& impulse) {
  const double u_G = impulse.lambda / (1 + s.restitution[impulse.pair]);
  return u_G * u_G * s.G.diagonal[impulse.pair] / 2;
}

/// What restitution takes: T changes by lambda . (u- + u+) / 2, whatever the order of the impulses.
double lost_energy(const Node& node, const ImpactScratch& s) {
  double gained = 0;
  bool elastic = true;
  for (const Impulse& impulse : s.impulses) {
    const double before = node.contacts[impulse.pair].u, after = s.u[impulse.pair];
    gained += impulse.lambda * (before + after) / 2;
    elastic = elastic && s.restitution[impulse.pair] == 1;
  }
  return elastic ? 0 : -gained;  // not the rounding of nothing
}

/// Says what the arc after the impact has to match, and by a change of which impulse: the last
/// strong one (theory, section 5, warning a).
/// @param first of this impact's impulses in the report
void prepare_launch(const Scene& scene, double energy, int first, Node& node, ImpactScratch& s) {
  double strongest = 0;
  for (const Impulse& impulse : s.impulses) {
    strongest = std::max(strongest, normal_energy(s, impulse));
  }
  for (std::size_t k = 0; k < s.impulses.size(); ++k) {
    const Impulse& impulse = s.impulses[k];
    const double part = normal_energy(s, impulse);
    if (!(part > 1e-3 * strongest)) continue;
    s.launch.impulse = first + static_cast<int>(k);
    s.launch.normal_energy = part;
    s.launch.n.setZero();
    add(scene.trees, 1, node.contacts[impulse.pair].n, s.launch.n);
  }
  s.launch.energy = energy - lost_energy(node, s);
  s.launch.response = s.launch.n;
  solve(scene.model.tree, scene.model.packed, node.M, s.launch.response);
}

/// v from p, without the rounding that the cascade's updates have gathered, and what every contact
/// does now.
void settle_velocities(const Scene& scene, Node& node) {
  const double speed = typical_speed(scene, node);
  node.v = node.p;
  solve(scene.model.tree, scene.model.packed, node.M, node.v);
  if (node.loops.some) hold_velocity(node);
  for (int i = 0; i < node.touching; ++i) classify(scene, node, speed, node.contacts[i]);
}

/// p += sum lambda_i n_i
void apply_impulses(const Scene& scene, const ImpactScratch& s, Node& node) {
  for (const Impulse& impulse : s.impulses) {
    add(scene.trees, impulse.lambda, node.contacts[impulse.pair].n, node.p);
  }
}

/// The impact of all impulses in the report from `first` on.
void tell_impact(const Node& node, int first, ImpactLaw law, bool fallback, StepReport& report) {
  const int count = static_cast<int>(report.impulses.size()) - first;
  report.impacts.push_back({node.t, first, count, node.touching, law, fallback});
}

void tell_reflections(const Node& node, const ImpactScratch& s, ImpactLaw law, bool fallback,
                      StepReport& report) {
  const int first = static_cast<int>(report.impulses.size());
  for (const Impulse& impulse : s.impulses) {
    const Contact& c = node.contacts[impulse.pair];
    report.impulses.push_back(acted(node, c, impulse.lambda, Vec3::Zero()));
  }
  tell_impact(node, first, law, fallback, report);
}

/// What friction takes is not known before: no energy is there to be matched, and every law is
/// nodal_energy.
bool resolve_with_friction(const Scene& scene, Node& node, ImpactScratch& s, StepReport& report) {
  const StepOptions& options = scene.options;
  FrictionScratch& x = s.friction;
  s.colliding.clear();
  for (int i = 0; i < node.touching; ++i) s.colliding.push_back(&node.contacts[i]);
  set_contact_blocks(scene, s.colliding, node, s.neighbours, x.W, x.u);
  x.p.assign(s.colliding.size(), Vec3::Zero());
  x.impulses.clear();
  if (!collide(x.W, {options.order, options.max_impulses}, x.pile, x.u, x.p, x.impulses)) {
    return false;
  }
  const int first = static_cast<int>(report.impulses.size());
  for (const FrictionImpulse& each : x.impulses) {
    const Contact& c = node.contacts[each.contact];
    apply(scene, c, each.p, node);
    report.impulses.push_back(acted(node, c, each.p[0], across(c, each.p)));
  }
  constexpr ImpactLaw law = ImpactLaw::nodal_energy;
  tell_impact(node, first, law, options.law != law, report);
  if (options.certify) report.certificates.push_back(certify_with_friction(node, s));
  settle_velocities(scene, node);
  return true;
}

void set_contact_space(const Scene& scene, Node& node, ImpactScratch& s) {
  set_contact_matrix(scene, node, s.neighbours, s.G);
  if (s.u.size() < node.touching) {
    for (VecX* each : {&s.u, &s.rest, &s.restitution}) each->resize(node.touching);
  }
  for (int i = 0; i < node.touching; ++i) {
    const Contact& c = node.contacts[i];
    s.u[i] = c.u;
    s.rest[i] = c.epsilon_u;
    s.restitution[i] = c.restitution;
  }
}

}  // namespace

ImpactScratch::ImpactScratch(const Scene& scene) : neighbours(scene), friction(scene.has_friction) {
  constexpr std::size_t few = 64;  // contacts; what is more grows once
  const std::size_t gaps =
      static_cast<std::size_t>(scene.model.pairs.size()) + scene.model.limits.size();
  const std::size_t reserved = std::min(gaps, few);
  for (VecX* each : {&launch.n, &launch.response}) each->setZero(scene.model.tree.n_v);
  impulses.reserve(1024);
  G.start.reserve(reserved + 1);
  G.diagonal.reserve(reserved);
  G.column.reserve(reserved * reserved);
  G.value.reserve(reserved * reserved);
  for (VecX* each : {&u, &rest, &restitution}) each->setZero(static_cast<Eigen::Index>(reserved));
  cascade.key.reserve(reserved);
  cascade.winner.reserve(4 * reserved);
  colliding.reserve(reserved);
}

bool can_open(const Scene& scene, Node& node, ImpactScratch& s) {
  set_contact_matrix(scene, node, s.neighbours, s.G);
  std::vector<int> all(static_cast<std::size_t>(s.G.size()));
  std::iota(all.begin(), all.end(), 0);
  return cone_interior(dense_part(s.G, all)) > 0;
}

bool resolve_impact_at(const Scene& scene, double energy, Node& node, ImpactScratch& s,
                       StepReport& report, const Launch*& launch) {
  const StepOptions& options = scene.options;
  launch = nullptr;
  if (options.law != ImpactLaw::custom && has_friction(node)) {
    return resolve_with_friction(scene, node, s, report);
  }
  set_contact_space(scene, node, s);
  const int m = node.touching;
  // the arc's energy is not told where loops hold it
  const ImpactLaw law = node.loops.some ? ImpactLaw::nodal_energy : options.law;
  s.impulses.clear();
  if (options.law == ImpactLaw::custom) {
    obey_custom_law(scene, node, s.impulses);
  } else {
    if (!cascade(s.G, s.u.head(m), s.rest.head(m), s.restitution.head(m),
                 {options.order, options.max_impulses}, s.cascade, s.impulses)) {
      return false;
    }
    apply_impulses(scene, s, node);
    if (law != ImpactLaw::nodal_energy) {
      prepare_launch(scene, energy, static_cast<int>(report.impulses.size()), node, s);
      launch = &s.launch;
    }
  }
  tell_reflections(node, s, law, law != options.law, report);
  if (options.certify) report.certificates.push_back(certify(s));
  settle_velocities(scene, node);
  return true;
}

}  // namespace saltus
