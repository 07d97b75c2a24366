#include "saltus/variational/overlap.hpp"

#include <algorithm>
#include <sstream>

#include "saltus/collision/broad_phase.hpp"
#include "saltus/collision/contact.hpp"
#include "saltus/collision/parts.hpp"
#include "saltus/model/close_loops.hpp"
#include "saltus/tree/coordinates.hpp"
#include "variational/law/contact_qp.hpp"

namespace saltus {
namespace {

/// Quadratic where gaps are smooth; corners and edges take turns, and stacks pass depth on.
constexpr int most_steps = 100;

/// Touches that whole shapes may overlap by: half of what a start is refused for (their gaps come
/// from an iteration).
constexpr double whole_touches = 50;

/// A gap at a configuration.
struct Overlap {
  std::string name;
  double phi;
  double most;  ///< [m] it is no overlap down to -most
  const char* unit = " m";
  bool is_one() const { return phi < -most; }
};

/// Gaps smaller than a margin, and their gradients.
struct NearPairs {
  std::vector<Overlap> pairs;
  std::vector<VecX> rows;
  std::vector<Overlap> stuck;  ///< that overlap, and no joint moves them along the normal

  double depth() const {
    double most = 0;
    for (const Overlap& each : pairs) most = std::max(most, -each.phi);
    return most;
  }
  VecX phi() const {
    VecX out(static_cast<Eigen::Index>(pairs.size()));
    for (std::size_t i = 0; i < pairs.size(); ++i) out[static_cast<Eigen::Index>(i)] = pairs[i].phi;
    return out;
  }
  MatX phi_q(int n_v) const {
    MatX out(static_cast<Eigen::Index>(rows.size()), n_v);
    for (std::size_t i = 0; i < rows.size(); ++i) out.row(static_cast<Eigen::Index>(i)) = rows[i];
    return out;
  }
};

void add_pair(const Model& model, const Kinematics& kin, const Pair& pair, const Gap& gap,
              const Overlap& overlap, NearPairs& out) {
  VecX row = VecX::Zero(model.n_v());
  add_gap_gradient(model->tree, kin, pair, gap, row);
  if (row.isZero(0)) {
    if (overlap.is_one()) out.stuck.push_back(overlap);
    return;
  }
  out.pairs.push_back(overlap);
  out.rows.push_back(row);
}

std::string solid_name(const Model& model, const Pair& pair) {
  return model->shapes[static_cast<std::size_t>(pair.a)].name + " ~ " +
         model->shapes[static_cast<std::size_t>(pair.b)].name;
}

/// Joints' limits are gaps that a way out keeps, however far they are.
void add_limits(const Model& model, const VecX& q, NearPairs& out) {
  for (std::size_t k = 0; k < model->limits.size(); ++k) {
    const JointLimit& limit = model->limits[k];
    const Pair pair = model.pair(model->first_limit + static_cast<int>(k));
    VecX row = VecX::Zero(model.n_v());
    const Drive& drive = model->tree.drive[static_cast<std::size_t>(limit.joint)];
    row[drive.velocity] = limit.stop.side;
    const double phi = limit.stop.side * (q[limit.coordinate] - limit.stop.bound);
    const bool is_angle =
        model->coordinates[static_cast<std::size_t>(limit.coordinate)].unit == Unit::radian;
    out.pairs.push_back({limit.name, phi, pair.touch / 2, is_angle ? " rad" : " m"});
    out.rows.push_back(row);
  }
}

/// The parts of two shapes; of those that overlap as wholes these, and of their parts what leads
/// out the same way: corners deep inside are nearer to other faces.
NearPairs near_pairs(const Model& model, const VecX& q, double margin, BroadPhase& broad) {
  Kinematics kin(model->tree);
  set_configuration(model->tree, q, kin);
  find_candidates(model->tree, model->shapes, model->pairs, kin, VecX::Zero(model.n_v()), margin,
                  broad);
  NearPairs out;
  PairTable::Key of{-1, -1, 0};
  Gap whole{};
  bool overlaps = false, is_stuck = false;
  for (const int number : broad.candidates) {
    const Pair pair = model.pair(number);
    const PairTable::Key key = model->pairs.key(number);
    if (key.a != of.a || key.b != of.b) {
      of = key;
      const Pair solid = make_solid_pair(model->tree, model->shapes, key.a, key.b);
      whole = pair_gap(model->tree, kin, solid);
      overlaps = model->pairs.count(key.a, key.b) > 1 && whole.phi < -whole_touches * solid.touch;
      const Overlap overlap{solid_name(model, solid), whole.phi, whole_touches * solid.touch};
      const std::size_t stuck = out.stuck.size();
      if (overlaps) add_pair(model, kin, solid, whole, overlap, out);
      is_stuck = out.stuck.size() > stuck;
    }
    if (is_stuck) continue;
    const Gap gap = pair_gap(model->tree, kin, pair);
    if (gap.phi > margin || is_silent(model->tree, kin, pair, gap)) continue;
    constexpr double same_way = 0.9;
    if (overlaps && (std::abs(gap.n_W.dot(whole.n_W)) < same_way || gap.phi < 1.1 * whole.phi)) {
      continue;
    }
    add_pair(model, kin, pair, gap, {model.pair_name(number), gap.phi, pair.touch / 2}, out);
  }
  add_limits(model, q, out);
  return out;
}

bool is_resolved(const NearPairs& near) {
  // half of what counts as touching: a start on it is not refused for its rounding
  return near.stuck.empty() && std::none_of(near.pairs.begin(), near.pairs.end(),
                                            [](const Overlap& each) { return each.is_one(); });
}

std::string list(const std::vector<Overlap>& overlaps) {
  std::vector<std::string> names;
  for (const Overlap& each : overlaps) {
    if (!each.is_one()) continue;
    std::ostringstream text;
    text << each.name << " by " << -each.phi << each.unit;
    names.push_back(text.str());
  }
  return list_names(names);
}

[[noreturn]] void fail(const NearPairs& near, int steps) {
  const std::string help =
      "; move them apart by hand, or exclude the pair (add_exclusion of a ModelBuilder, <exclude "
      "link1=... link2=.../> in a file)";
  if (!near.stuck.empty()) {
    throw ModelError(
        "no joint moves them out of each other by the shortest way: " + list(near.stuck) + help);
  }
  throw ModelError("after " + counted(steps, "step") +
                   " bodies still overlap: " + list(near.pairs) + help);
}

/// One step: the least motion in the metric of M that opens all, as far as gaps are linear.
/// @return false where there is none
bool step_out(const Model& model, const NearPairs& near, VecX& q) {
  const MatX phi_q = near.phi_q(model.n_v());
  const Eigen::LLT<Eigen::MatrixXd> M(model.mass_matrix(q));
  MatX columns = M.solve(phi_q.transpose());
  for (Eigen::Index k = 0; k < columns.cols() && model->equalities.rows > 0; ++k) {
    // of a motion that is told only what is added to it
    columns.col(k) = consistent_velocity(model, q, columns.col(k)) -
                     consistent_velocity(model, q, VecX::Zero(model.n_v()));
  }
  MatX G = phi_q * columns;
  // where there is no way out the multipliers stay finite
  G.diagonal() *= 1 + 1e-9;
  try {
    const VecX dq = columns * contact_multipliers(G, near.phi());
    if (!dq.allFinite()) return false;
    integrate(model->tree, q, 1, dq, q);
    if (model->equalities.rows > 0) q = close_loops(model, q);
  } catch (const StepError&) {
    return false;
  }
  return true;
}

}  // namespace

VecX resolve_overlap(const Model& model, const VecRef& start) {
  VecX q = model.checked_q(start, "q");
  BroadPhase broad(model->tree, model->shapes, model->pairs);
  NearPairs near = near_pairs(model, q, 0, broad);
  int steps = 0;
  while (steps < most_steps && !is_resolved(near) && near.stuck.empty()) {
    // pairs that a step out of the deepest overlap could close
    const NearPairs wide = near_pairs(model, q, 2 * near.depth(), broad);
    if (!step_out(model, wide, q)) break;
    ++steps;
    near = near_pairs(model, q, 0, broad);
  }
  if (!is_resolved(near)) fail(near, steps);
  return q;
}

}  // namespace saltus
