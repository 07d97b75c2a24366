#include "variational/step/unlocated.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "saltus/tree/coordinates.hpp"
#include "variational/flight/impact_time.hpp"

namespace saltus {
namespace {

constexpr int most_rounds = 12;  ///< in which rows join; 1 to 4 are usual

/// Rounds after which what is left of overlaps may be moved apart (lift.cpp), where it is no more
/// than so many touches, 1e-6 of the shapes' size: where parts of many bodies pass each other there
/// are others in every round, and to stand still would be worse.
constexpr int few_rounds = 4;
constexpr double little_touches = 1e4;

/// L_v and L_q at (q, v), in s.
void evaluate_at(const ModelData& model, double t, const VecX& q, const VecX& p, const VecX& v,
                 ArcScratch& s) {
  momentum_residual(model, {q, p, 0, nullptr, 0, t}, v, s);
}

/// The velocity at the arc's end without contacts. Motors and dampers may be stiff: they act in the
/// arc's middle, which one Newton step of its equation finds.
void set_free_velocity(const Scene& scene, double tau, Node& node, ArcScratch& s, Unlocated& x) {
  const ModelData& model = scene.model;
  evaluate_at(model, node.t, node.q, node.p, node.v, s);
  x.v_free = node.p + tau * s.L_q;
  x.work = 0;
  x.v_middle.resize(0);
  if (s.has_forces) {
    const ArcProblem problem{node.q, node.p, tau, nullptr, 0, node.t};
    x.v = node.v;
    const auto evaluate = [&] { return std::isfinite(momentum_residual(model, problem, x.v, s)); };
    bool found = evaluate();
    set_second_partials(model, s);
    if (found && factorize(model.tree, model.packed, s.w, tau, s.J)) {
      s.dv = s.r;
      solve(model.tree, model.packed, s.J, s.dv);
      x.v += s.dv;
      if (node.loops.some) node.loops.solver.meet(node.loops.values.drive, x.v);
      found = evaluate();
    }
    if (found) {
      x.v_free = node.p + tau * s.L_q;
      x.work = tau * s.forces.Q.dot(x.v);
      x.forces = s.forces;
      x.wrench_force = s.wrench_force;
      x.v_middle = x.v;
    }
  }
  solve(model.tree, model.packed, node.M, x.v_free);
  if (node.loops.some) node.loops.solver.meet(node.loops.values.drive, x.v_free);
}

void add_cut(const Contact& contact, double offset, Unlocated& x) {
  x.cuts.push_back(contact);
  x.offset.push_back(offset);
}

/// v from v_free and the law. Changes node.p and node.v, which are given back.
void resolve(const Scene& scene, Node& node, Unlocated& x) {
  const VecX p_before = node.p;
  node.v = x.v_free;
  x.list.clear();
  for (Contact& each : x.cuts) x.list.push_back(&each);
  set_contact_blocks(scene, x.list, node, x.neighbours, x.W, x.u);
  for (std::size_t i = 0; i < x.cuts.size(); ++i) x.u[i][0] += x.offset[i];
  x.p.assign(x.cuts.size(), Vec3::Zero());
  x.pile.reserve(x.cuts.size());
  x.residual = settle_for_sure(x.W, x.pile, x.u, x.p, 1e-12).excess;
  for (std::size_t i = 0; i < x.cuts.size(); ++i) apply(scene, x.cuts[i], x.p[i], node);
  x.v = node.v;
  node.p = p_before;
}

/// Rows of what overlaps at `end` more than at the node.
/// @return true where there are some
bool cut_overlaps(const Scene& scene, double tau, const Node& node, const Node& end, Unlocated& x) {
  bool found = false;
  for (int i = 0; i < end.touching; ++i) {
    const Contact& c = end.contacts[i];
    const double floor = floor_of(node, c.slot);
    const double touch = node.pool[c.slot].touch;
    if (c.phi >= floor) continue;
    add_cut(c, (c.phi - floor - touch) / tau - dot(scene.trees, c.n, x.v), x);
    found = true;
  }
  return found;
}

/// Rows of bodies that are deeper in each other at `end` than at the node: parts that are far in
/// each other face each other no more. @return true where there are some
bool cut_bodies(const Scene& scene, double tau, const Node& node, Node& end, Unlocated& x) {
  const ModelData& model = scene.model;
  const Pair* last = nullptr;
  bool found = false;
  for (const int number : end.broad.candidates) {
    const int slot = end.pool.slot_of(model, number);
    const Pair* solid = end.pool.solid(slot);
    if (solid == nullptr || std::exchange(last, solid) == solid) continue;
    const Gap gap = pair_gap(model.tree, end.kin, *solid);
    const double deep = -noisy_touches * solid->touch;
    if (gap.phi >= deep) continue;
    const double floor = std::min(pair_gap(model.tree, node.kin, *solid).phi, 0.0);
    if (gap.phi >= floor + deep) continue;
    x.whole = fresh_contact(scene);
    write_contact(scene, 0, slot, *solid, gap, end, end.dense, x.whole);
    add_cut(x.whole, (gap.phi - floor - solid->touch) / tau - dot(scene.trees, x.whole.n, x.v), x);
    found = true;
  }
  return found;
}

bool overlaps_little(const Node& node, const Node& end) {
  return std::all_of(
      end.contacts.begin(), end.contacts.begin() + end.touching, [&](const Contact& c) {
        return c.phi >= floor_of(node, c.slot) - little_touches * node.pool[c.slot].touch;
      });
}

void place_end_node(const Scene& scene, double tau, const Node& node, Node& end, Unlocated& x) {
  integrate(scene.model.tree, node.q, tau, x.v, x.q_end);
  if (node.loops.some) close_near(scene, node, node.t + tau, x.q_end, end);
  end.v = x.v;
  place_node(scene, node.t + tau, x.q_end, node.p, end);
}

/// Bodies that contacts push stand still, all others go as they would.
void stop(const Scene& scene, Unlocated& x) {
  x.v = x.v_free;
  for (const Contact& each : x.cuts) {
    if (each.bound > 0) continue;  // a joint with dry friction
    for (const ContactVector::Part& part : each.n.part) {
      if (part.tree < 0) continue;
      for (const int k : scene.trees.of[part.tree]) x.v[k] = 0;
    }
  }
  x.p.assign(x.cuts.size(), Vec3::Zero());
}

/// Stands still all that has to, for the rest to overlap nowhere.
void stop_until_clear(const Scene& scene, double tau, const Node& node, Node& end, Unlocated& x) {
  x.residual = 0;
  for (int round = 0; round < most_rounds; ++round) {
    stop(scene, x);
    place_end_node(scene, tau, node, end, x);
    if (!find_contacts(scene, end)) continue;
    const bool overlaps = cut_overlaps(scene, tau, node, end, x);
    if (!cut_bodies(scene, tau, node, end, x) && !overlaps) return;
  }
  x.v.setZero();
  x.p.assign(x.cuts.size(), Vec3::Zero());
  place_end_node(scene, tau, node, end, x);
}

/// M(q+) v, and v shortened where the arc gained energy beyond what forces do.
/// @return false where that is no help
bool set_momenta(const Scene& scene, double start, Node& end, ArcScratch& arc, Unlocated& x) {
  const double V = potential_energy(scene.model.packed, end.w);
  const double before = start + x.work;
  evaluate_at(scene.model, end.t, x.q_end, end.p, x.v, arc);
  const double T = 0.5 * x.v.dot(arc.L_v), most = before - V;
  double part = 1;
  if (T > most) part = most > 0 ? std::sqrt(most / T) : 0;
  end.p = part * arc.L_v;
  end.v = part * x.v;
  x.energy = part * part * T + V - before;
  return end.p.allFinite() && (part > 0 || !(T > 0));
}

void tell(const Node& node, Unlocated& x) {
  x.impulses.clear();
  double most = 0;
  for (std::size_t i = 0; i < x.cuts.size(); ++i) {
    if (x.cuts[i].bound > 0) continue;
    const Vec3& p = x.p[i];
    x.impulses.push_back(acted(node, x.cuts[i], p[0], across(x.cuts[i], p)));
    if (p.norm() > most) most = p.norm(), x.pair = x.impulses.back().pair;
  }
}

}  // namespace

Unlocated::Unlocated(const Scene& scene) : neighbours(scene) {
  for (VecX* each : {&v_free, &v}) each->setZero(scene.model.tree.n_v);
  q_end.setZero(scene.model.tree.n_q);
}

Rung step_unlocated(const Scene& scene, double tau, double t, Node& node, Node& end,
                    ArcScratch& arc, Unlocated& x) {
  const ModelData& model = scene.model;
  x.cuts.clear();
  x.offset.clear();
  x.pair = -1;
  x.residual = 0;
  set_velocity_at_node(scene, node);
  const double before = node_energy(scene, node);
  set_free_velocity(scene, tau, node, arc, x);
  for (int i = 0; i < node.touching; ++i) {
    const Contact& c = node.contacts[i];
    add_cut(c, std::max(c.phi, 0.0) / tau, x);
  }
  for (std::size_t k = 0; k < node.dry.size(); ++k) {
    if (node.is_still(k)) continue;
    add_cut(node.dry[k], 0, x);
    x.cuts.back().bound = tau * node.dry_force[k];
  }
  Rung rung = Rung::stopped;
  for (int round = 0; round < most_rounds; ++round) {
    resolve(scene, node, x);
    if (!x.v.allFinite()) break;
    place_end_node(scene, tau, node, end, x);
    if (!find_contacts(scene, end)) break;
    const bool is_deep = cut_bodies(scene, tau, node, end, x);
    const bool is_near = !is_deep && round >= few_rounds && overlaps_little(node, end);
    if ((!is_near && cut_overlaps(scene, tau, node, end, x)) || is_deep) continue;
    rung = Rung::unlocated;
    break;
  }
  if (rung == Rung::stopped) stop_until_clear(scene, tau, node, end, x);
  if (!set_momenta(scene, before, end, arc, x)) {
    rung = Rung::stopped;
    x.v.setZero();
    end.v.setZero();
    place_end_node(scene, tau, node, end, x);
    end.p.setZero();
    x.energy = potential_energy(model.packed, end.w) - before;
  }
  tell(node, x);
  node.v = end.v;
  place_node(scene, t, x.q_end, end.p, node);
  set_velocity_at_node(scene, node);
  find_contacts(scene, node);
  return rung;
}

}  // namespace saltus
