#include "saltus/variational/overlap.hpp"

#include <algorithm>
#include <sstream>

#include "saltus/collision/broad_phase.hpp"
#include "saltus/collision/contact.hpp"
#include "saltus/tree/coordinates.hpp"
#include "variational/law/contact_qp.hpp"

namespace saltus {
namespace {

/// Quadratic where gaps are smooth; corners and edges take turns, and stacks pass depth on.
constexpr int most_steps = 100;

/// A pair and its gap at a configuration.
struct Overlap {
  int pair;
  double phi;
  double touch;
};

/// The pairs nearer than `margin`, and their gradients.
struct NearPairs {
  std::vector<Overlap> pairs;
  MatX phi_q;  ///< (pairs, n_v)
  VecX phi;

  double depth() const {
    double most = 0;
    for (const Overlap& each : pairs) most = std::max(most, -each.phi);
    return most;
  }
};

NearPairs near_pairs(const Model& model, const VecX& q, double margin, BroadPhase& broad) {
  Kinematics kin(model->tree);
  set_configuration(model->tree, q, kin);
  const int n_v = model.n_v();
  find_candidates(model->tree, model->shapes, model->pairs, kin, VecX::Zero(n_v), margin, broad);
  NearPairs out;
  std::vector<VecX> rows;
  for (const int number : broad.candidates) {
    const Pair pair = model.pair(number);
    const Gap gap = pair_gap(model->tree, kin, pair);
    if (gap.phi > margin || is_silent(model->tree, kin, pair, gap)) continue;
    VecX row = VecX::Zero(n_v);
    add_gap_gradient(model->tree, kin, pair, gap, row);
    if (row.isZero(0)) continue;  // nothing that moves can change it
    out.pairs.push_back({number, gap.phi, pair.touch});
    rows.push_back(row);
  }
  out.phi_q.resize(static_cast<Eigen::Index>(rows.size()), n_v);
  out.phi.resize(out.phi_q.rows());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    out.phi_q.row(static_cast<Eigen::Index>(i)) = rows[i];
    out.phi[static_cast<Eigen::Index>(i)] = out.pairs[i].phi;
  }
  return out;
}

bool is_resolved(const NearPairs& near) {
  // half of what counts as touching: a start on it is not refused for its rounding
  return std::all_of(near.pairs.begin(), near.pairs.end(),
                     [](const Overlap& each) { return each.phi >= -each.touch / 2; });
}

[[noreturn]] void fail(const Model& model, const NearPairs& near) {
  std::vector<std::string> left;
  for (const Overlap& each : near.pairs) {
    if (each.phi >= -each.touch / 2) continue;
    std::ostringstream text;
    text << model.pair_name(each.pair) << " by " << -each.phi << " m";
    left.push_back(text.str());
  }
  throw ModelError("after " + std::to_string(most_steps) + " steps bodies still overlap: " +
                   list_names(left) + "; move them apart by hand, or exclude the pair");
}

}  // namespace

VecX resolve_overlap(const Model& model, const VecRef& start) {
  VecX q = model.checked_q(start, "q");
  BroadPhase broad(model->tree, model->shapes, model->pairs);
  NearPairs near = near_pairs(model, q, 0, broad);
  for (int k = 0; k < most_steps && !is_resolved(near); ++k) {
    // pairs that a step out of the deepest overlap could close
    near = near_pairs(model, q, 2 * near.depth(), broad);
    const Eigen::LLT<Eigen::MatrixXd> M(model.mass_matrix(q));
    const MatX columns = M.solve(near.phi_q.transpose());
    MatX G = near.phi_q * columns;
    // where there is no way out the multipliers stay finite
    G.diagonal() *= 1 + 1e-9;
    integrate(model->tree, q, 1, columns * contact_multipliers(G, near.phi), q);
    near = near_pairs(model, q, 0, broad);
  }
  if (!is_resolved(near)) fail(model, near);
  return q;
}

}  // namespace saltus
