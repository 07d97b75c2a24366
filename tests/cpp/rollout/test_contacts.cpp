// What a run keeps of the contacts in it, and of itself where a step fails.
#include <gtest/gtest.h>

#include <stdexcept>

#include "kit/scenes.hpp"
#include "saltus/rollout/batch.hpp"

namespace saltus {
namespace {

using scenes::cradle;

constexpr double weight = 9.81;  // of 1 kg, [N]

/// A ball of 1 kg and 0.1 m on the floor, which does not bounce.
Model resting_ball() {
  ModelBuilder b("ball");
  scenes::add_bead(b, "height", Vec3(0.5, -2, 0.1), Vec3::UnitZ(), 1, 0.1);
  return b.add_half_space("floor", Vec3::UnitZ()).set_default_contact({0, 0}).build();
}

TEST(Contacts, WhatHoldsABallIsRecordedRowByRow) {
  const Model model = resting_ball();
  const Trajectory run = simulate(
      model, model.state(), 1, {.step = {.h = 0.01}, .record_every = 8, .record_contacts = true});
  ASSERT_TRUE(run.contacts);
  ASSERT_EQ(run.contacts->size(), 100u);
  for (int k = 0; k < 100; ++k) {
    const RecordedContact& each = (*run.contacts)[k];
    EXPECT_EQ(each.row, k / 8 + 1);
    EXPECT_DOUBLE_EQ(each.t, (k + 1) * 0.01);
    EXPECT_EQ(each.impact, -1);
    EXPECT_EQ(model.pair_name(each.impulse.pair), "height ~ floor");
    EXPECT_NEAR(each.impulse.lambda, weight * 0.01, 1e-15);
    EXPECT_LE((each.impulse.point_W - Vec3(0.5, -2, 0)).norm(), 1e-15);
    EXPECT_EQ(each.impulse.n_W, Vec3::UnitZ());
    EXPECT_EQ(each.impulse.p_W, Vec3::Zero());
  }
  EXPECT_FALSE(simulate(model, model.state(), 1).contacts);
}

TEST(Contacts, ImpulsesOfImpactsAreAmongThem) {
  const Model model = cradle({.balls = 3});
  const State start = model.state({{"swing_0", 0.3}});
  const Trajectory run = simulate(model, start, 1, {.step = {.h = 0.01}, .record_contacts = true});
  ASSERT_EQ(run.impulses.size(), 2u);
  ASSERT_EQ(run.contacts->size(), 2u);
  for (int i = 0; i < 2; ++i) {
    const RecordedContact& each = (*run.contacts)[i];
    EXPECT_EQ(each.impact, 0);
    EXPECT_EQ(each.t, run.impacts[0].t);
    EXPECT_EQ(each.row, 51);
    EXPECT_EQ(each.impulse.lambda, run.impulses[i].lambda);
    // balls of 0.05 m at x = 0, 0.1 and 0.2, 1 m below their pivots
    EXPECT_LE((each.impulse.point_W - Vec3(0.05 + 0.1 * i, 0, -1)).norm(), 1e-12);
    EXPECT_LE((each.impulse.n_W + Vec3::UnitX()).norm(), 1e-12);  // from the second to the first
  }
}

TEST(Contacts, ThoseOfStepsAfterTheLastRowAreLeftOut) {
  const Model model = resting_ball();
  const State start = model.state();
  Trajectory stopped = simulate(model, start, 1);
  int asked = 0;
  BatchOptions batch{.run = {.step = {.h = 1e-5}, .record_every = 1000, .record_contacts = true}};
  batch.run.progress = [&](double) { return ++asked < 2; };
  simulate(model, start, 100, batch.run, stopped);
  EXPECT_FALSE(stopped.complete);
  EXPECT_EQ(static_cast<Eigen::Index>(stopped.contacts->size()), 1000 * (stopped.t.size() - 1));
  const Trajectory never = simulate_batch(model, std::vector<State>{start}, 1e-3, batch).run(0);
  EXPECT_TRUE(never.contacts);
}

// 16 GB are shared by the runs: of 200 000 each has room for some 700 contacts.
TEST(Contacts, MoreThanThereIsRoomForAreRefused) {
  const Model model = resting_ball();
  const std::vector<State> starts(200000, model.state());
  const BatchOptions options{
      .run = {.step = {.h = 0.01}, .record_every = 1000, .record_contacts = true},
      .threads = 1,
      .on_failure = OnFailure::stop};
  try {
    simulate_batch(model, starts, 10, options);
    ADD_FAILURE() << "nothing thrown";
  } catch (const ModelError& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.rfind("run 0: 7", 0), 0u) << text;
    EXPECT_NE(text.find("record no contacts"), std::string::npos) << text;
  }
}

TEST(Contacts, RowsBeforeAnErrorAreKept) {
  const Model model = cradle({.balls = 3});
  const State start = model.state({{"swing_0", 0.3}});
  const Trajectory whole = simulate(model, start, 1, {.h = 0.01});
  Trajectory run = simulate(model, start, 0.1, {.h = 0.01});
  // an impulse is allowed, and the first impact, at 0.5046 s, needs two
  EXPECT_THROW(simulate(model, start, 1, {.step = {.h = 0.01, .max_impulses = 1}}, run),
               JammedError);
  EXPECT_FALSE(run.complete);
  ASSERT_EQ(run.t.size(), 51);
  EXPECT_EQ(run.t, whole.t.head(51));
  EXPECT_EQ(run.q, whole.q.topRows(51));
  EXPECT_EQ(run.p, whole.p.topRows(51));
  EXPECT_EQ(run.shadow, whole.shadow.head(51));
  EXPECT_TRUE(run.impacts.empty());
  EXPECT_GT(run.iterations, 50);
}

TEST(Contacts, NumbersThatMakeNoRunLeaveTheOldOne) {
  const Model model = cradle({.balls = 3});
  Trajectory run = simulate(model, model.state(), 0.1, {.h = 0.01});
  EXPECT_THROW(simulate(model, model.state(), -1, {.step = {.h = 0.01}}, run), ModelError);
  EXPECT_TRUE(run.complete);
  EXPECT_EQ(run.t.size(), 11);
}

}  // namespace
}  // namespace saltus
