#include "derivatives/contact_placements.hpp"

#include "derivatives/held_rows.hpp"
#include "derivatives/loop_rows.hpp"

namespace saltus {

void add_gap_placements(const ModelData& model, const Kinematics& kin, int pair, double of_gap,
                        PlacementGradient& to) {
  RowCovectors hat;
  hat.motion[0] = of_gap;
  add_row_placements(model, kin, pair_of(model, pair), {}, hat, to.by_joint);
}

void add_impulse_placements(const ModelData& model, const NodeDerivative& node,
                            const ImpulseDerivative& impulse, const VecX& p_hat, double of_lambda,
                            PlacementGradient& to) {
  const double compression = -impulse.u / impulse.G;
  const double factor = -of_lambda * (1 + impulse.restitution) / impulse.G;
  RowCovectors hat;
  hat.row[0] = impulse.lambda * p_hat + factor * (impulse.v_s + compression * impulse.w);
  const int pair = node.pairs[static_cast<std::size_t>(impulse.contact)];
  add_row_placements(model, node.kin, pair_of(model, pair), {}, hat, to.by_joint);
}

void add_kick_placements(const ModelData& model, const VecX& q, const KickDerivative& kick,
                         const VecX& residual, const VecX& p_hat, PlacementGradient& to) {
  Kinematics kin(model.tree);
  set_configuration(model.tree, q, kin);
  std::vector<RowCovectors> hats(kick.contacts.size());
  for (Eigen::Index c = 0; c < kick.size(); ++c) {
    const auto k = static_cast<std::size_t>(kick.contact_of[static_cast<std::size_t>(c)]);
    const KickContact& contact = kick.contacts[k];
    RowCovectors& hat = hats[k];
    const auto add = [&](int i, const VecX& x) {
      if (hat.row[i].size() == 0) hat.row[i].setZero(x.size());
      hat.row[i] += x;
    };
    const int own = kick.row_of[static_cast<std::size_t>(c)];
    add(own, kick.P[c] * p_hat - residual[c] * kick.v);
    if (contact.mode != KickContact::Mode::along) continue;
    for (int i = 1; i < 3; ++i) add(i, kick.P[c] * contact.P[i] / contact.P[0] * p_hat);
  }
  for (std::size_t k = 0; k < hats.size(); ++k) {
    const KickContact& contact = kick.contacts[k];
    if (contact.joint >= 0) continue;
    if (contact.loop >= 0) {
      add_loop_placements(model, kin, contact.loop, hats[k].row[0], 0, to.by_joint);
      continue;
    }
    add_row_placements(model, kin, contact.pair, contact.frame, hats[k], to.by_joint);
  }
}

void add_held_placements(const ModelData& model, const FlownArc& arc, const VecX& p_hat,
                         const VecX& of_rates, PlacementGradient& to) {
  const TapeArc& told = *arc.told;
  const Places places = places_of(model, told, arc.arc);
  const auto add = [&](const Kinematics& kin, const Pair& pair, const FrameChoice& choice,
                       const RowCovectors& hat) {
    add_row_placements(model, kin, pair, choice, hat, to.by_joint);
  };
  Eigen::Index at = 0;
  for (int k = 0; k < told.n_held; ++k) {
    const TapeRow& row = told.held[static_cast<std::size_t>(k)];
    const Eigen::Index first = at;
    at += rates_of(row);
    if (row.joint >= 0) continue;
    if (row.loop >= 0) {
      add_loop_placements(model, places.start, row.loop, row.P[0] * p_hat, 0, to.by_joint);
      add_loop_placements(model, places.end, row.loop, {}, of_rates[first], to.by_joint);
      continue;
    }
    const Pair pair = pair_of(model, row.pair);
    const Pair& own = watched(row, pair);
    RowCovectors push, middle, gap, chord;
    for (int i = 0; i < rates_of(row); ++i) push.row[i] = row.P[i] * p_hat;
    add(places.start, pair, choice_of(row, pair.on_b.joint < 0), push);
    gap.motion[0] = of_rates[first];
    add(places.end, own, choice_of(row, false), gap);
    if (rates_of(row) == 1) continue;
    for (int i = 1; i < 3; ++i) {
      middle.row[i] = of_rates[first + i] * arc.arc.v;
      chord.motion[i] = of_rates[first + i];
    }
    if (!row.is_point) {
      add(places.middle, own, choice_of(row, false), middle);
      continue;
    }
    add(places.end, row.frozen, choice_of(row, true), chord);
    chord.motion = -chord.motion;
    add(places.start, row.frozen, choice_of(row, true), chord);
  }
}

}  // namespace saltus
