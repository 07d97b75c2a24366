// Many runs over threads: the same bits however many, failures that stay with their run.
#include "saltus/rollout/batch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <thread>

#include "kit/ask.hpp"
#include "kit/scenes.hpp"

namespace saltus {
namespace {

using scenes::cradle;
using test::message_of;

template <class Array>
bool same_bits(const Array& a, const Array& b) {  // also of NaN
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

bool same_impacts(const RunOutcome& a, const RunOutcome& b) {
  if (a.impacts.size() != b.impacts.size() || a.impulses.size() != b.impulses.size()) return false;
  for (std::size_t i = 0; i < a.impacts.size(); ++i) {
    if (a.impacts[i].t != b.impacts[i].t || a.impacts[i].count != b.impacts[i].count) return false;
  }
  for (std::size_t i = 0; i < a.impulses.size(); ++i) {
    if (a.impulses[i].lambda != b.impulses[i].lambda) return false;
  }
  return a.residual == b.residual && a.iterations == b.iterations;
}

void expect_same(const BatchTrajectory& a, const BatchTrajectory& b) {
  EXPECT_TRUE(same_bits(a.t, b.t));
  for (const auto field :
       {&BatchTrajectory::q, &BatchTrajectory::v, &BatchTrajectory::p, &BatchTrajectory::kinetic,
        &BatchTrajectory::potential, &BatchTrajectory::shadow}) {
    EXPECT_TRUE(same_bits(a.*field, b.*field));
  }
  ASSERT_EQ(a.runs(), b.runs());
  for (int i = 0; i < a.runs(); ++i) {
    EXPECT_TRUE(same_impacts(a.outcome[i], b.outcome[i])) << i;
    EXPECT_EQ(a.outcome[i].failure, b.outcome[i].failure);
  }
}

/// Cradles of which 0, 1, 2 ... balls are let go, at angles that differ.
std::vector<State> cradle_starts(const Model& model, int runs) {
  std::vector<State> out;
  for (int i = 0; i < runs; ++i) {
    VecX q = VecX::Zero(model.n_q());
    for (int ball = 0; ball < i % 3; ++ball) q[2 * ball] = 0.1 + 0.01 * i;
    out.push_back(model.state(q, VecX::Zero(model.n_q())));
  }
  return out;
}

/// A start whose balls overlap.
State overlapping(const Model& model) { return model.state({{"swing_0", -0.05}}); }

TEST(Batch, HasTheSameBitsOnAnyNumberOfThreads) {
  const Model model = cradle({.balls = 3});
  const std::vector<State> starts = cradle_starts(model, 17);
  for (const ImpactLaw law : {ImpactLaw::nodal_energy, ImpactLaw::discrete_energy}) {
    BatchOptions options{.run = {.step = {.h = 0.01, .law = law}}, .threads = 1};
    const BatchTrajectory one = simulate_batch(model, starts, 2, options);
    for (const int threads : {0, 2, 3, 8}) {
      options.threads = threads;
      expect_same(simulate_batch(model, starts, 2, options), one);
    }
  }
}

TEST(Batch, EachRunIsWhatSimulateGives) {
  const Model model = cradle({.balls = 3});
  const std::vector<State> starts = cradle_starts(model, 7);
  const BatchTrajectory batch = simulate_batch(
      model, starts, 1, {.run = {.step = {.h = 0.01}, .record_every = 7}, .threads = 3});
  const VecX errors = batch.energy_error();
  for (int i = 0; i < 7; ++i) {
    const Trajectory own = batch.run(i);
    const Trajectory alone =
        simulate(model, starts[i], 1, {.step = {.h = 0.01}, .record_every = 7});
    EXPECT_TRUE(own.complete);
    EXPECT_TRUE(same_bits(own.t, alone.t));
    EXPECT_TRUE(same_bits(own.q, alone.q));
    EXPECT_TRUE(same_bits(own.v, alone.v));
    EXPECT_TRUE(same_bits(own.p, alone.p));
    EXPECT_TRUE(same_bits(own.kinetic, alone.kinetic));
    EXPECT_TRUE(same_bits(own.potential, alone.potential));
    EXPECT_TRUE(same_bits(own.shadow, alone.shadow));
    EXPECT_EQ(own.impacts.size(), alone.impacts.size());
    EXPECT_EQ(own.iterations, alone.iterations);
    EXPECT_EQ(errors[i], alone.energy_error());
  }
  EXPECT_THROW(batch.run(7), ModelError);
  EXPECT_THROW(batch.run(-1), ModelError);
}

TEST(Batch, AFailureStaysWithItsRun) {
  const Model model = cradle({.balls = 3});
  std::vector<State> starts = cradle_starts(model, 9);
  starts[4] = overlapping(model);
  for (const int threads : {1, 3}) {
    const BatchTrajectory batch =
        simulate_batch(model, starts, 0.5, {.run = {.step = {.h = 0.01}}, .threads = threads});
    const auto failures = batch.failures();
    ASSERT_EQ(failures.size(), 1u);
    EXPECT_NE(failures.at(4).find("ball_0 ~ ball_1"), std::string::npos) << failures.at(4);
    for (int i = 0; i < 9; ++i) EXPECT_EQ(batch.outcome[i].complete, i != 4);
    EXPECT_EQ(batch.outcome[4].rows, 1);
    EXPECT_EQ(batch.q(4 * 51, 0), -0.05);
    EXPECT_TRUE(std::isnan(batch.q(4 * 51 + 1, 0)));
    EXPECT_TRUE(std::isnan(batch.kinetic(4, 50)));
    EXPECT_EQ(batch.run(4).t.size(), 1);
  }
}

TEST(Batch, ARunThatFailsOnItsWayKeepsItsRows) {
  const Model model = cradle({.balls = 3});
  const std::vector<State> starts = cradle_starts(model, 2);
  // an impulse is allowed, and the first impact of run 1 needs two
  const BatchTrajectory batch =
      simulate_batch(model, starts, 2, {.run = {.step = {.h = 0.01, .max_impulses = 1}}});
  EXPECT_TRUE(batch.outcome[0].complete);
  EXPECT_FALSE(batch.outcome[1].complete);
  EXPECT_NE(batch.outcome[1].failure.find("max_impulses"), std::string::npos);
  EXPECT_EQ(batch.outcome[1].rows, 51);  // up to 0.5 s; the impact is a little later
  EXPECT_FALSE(std::isnan(batch.q(201 + 50, 0)));
  EXPECT_TRUE(std::isnan(batch.q(201 + 51, 0)));
  EXPECT_LT(batch.energy_error()[1], 1e-4);
}

TEST(Batch, OnRequestTheFirstFailureByIndexIsThrown) {
  const Model model = cradle({.balls = 3});
  std::vector<State> starts = cradle_starts(model, 40);
  BatchOptions options{.run = {.step = {.h = 0.01, .max_impulses = 1}},
                       .on_failure = OnFailure::stop};
  // run 1 fails after 50 steps, run 20 at once
  starts[20] = overlapping(model);
  for (const int threads : {1, 2, 8, 40}) {
    options.threads = threads;
    try {
      simulate_batch(model, starts, 2, options);
      ADD_FAILURE() << "nothing thrown";
    } catch (const JammedError& error) {
      EXPECT_EQ(std::string(error.what()).rfind("run 1: ", 0), 0u) << error.what();
      EXPECT_GT(error.t, 0.4);
    }
  }
  starts.erase(starts.begin(), starts.begin() + 20);
  EXPECT_THROW(simulate_batch(model, starts, 2, options), ModelError);
}

TEST(Batch, ProgressIsToldByTheCallingThreadAndCanStopAll) {
  const Model model = cradle({.balls = 3});
  const std::vector<State> starts = cradle_starts(model, 5);
  const auto caller = std::this_thread::get_id();
  double last = 0;
  BatchOptions options{.run = {.step = {.h = 1e-5}, .record_every = 1000}, .threads = 2};
  options.run.progress = [&](double done) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    EXPECT_GE(done, last);
    EXPECT_LE(done, 1);
    last = done;
    return done < 5e-6;  // 2500 of 5e8 steps
  };
  const BatchTrajectory batch = simulate_batch(model, starts, 1000, options);
  EXPECT_GE(last, 5e-6);
  EXPECT_TRUE(batch.failures().empty());
  for (int i = 0; i < 5; ++i) {
    EXPECT_FALSE(batch.outcome[i].complete);
    EXPECT_EQ(batch.run(i).q.row(0).transpose(), starts[i].q);
  }
  EXPECT_GT(std::max(batch.outcome[0].rows, batch.outcome[1].rows), 1);
  EXPECT_EQ(batch.outcome[4].rows, 1);
  EXPECT_TRUE(std::isnan(batch.energy_error()[4]));  // never begun

  options.run.progress = [](double) -> bool { throw std::runtime_error("in progress"); };
  EXPECT_THROW(simulate_batch(model, starts, 1000, options), std::runtime_error);
}

TEST(Batch, ProgressEndsWithAllDone) {
  const Model model = cradle({.balls = 3});
  const std::vector<State> starts{overlapping(model), model.state()};
  double last = 0;
  BatchOptions options;
  options.run.progress = [&](double done) {
    last = done;
    return true;
  };
  simulate_batch(model, starts, 1, options);
  EXPECT_EQ(last, 1);
}

TEST(Batch, StartsFromArraysAreThoseOfTheModel) {
  const Model model = cradle({.balls = 2});
  const MatX q = MatX::Random(3, 4), v = MatX::Random(3, 4);
  const std::vector<State> all = states(model, q, v, 0.5);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[1], model.state(VecX(q.row(1)), VecX(v.row(1)), 0.5));
}

TEST(Batch, BadArraysAreNamed) {
  const Model model = cradle({.balls = 2});
  const auto of = [&](const MatX& q, const MatX& v) {
    return message_of([&] { states(model, q, v); });
  };
  MatX good = MatX::Zero(3, 4), bad = good;
  EXPECT_NE(of(MatX::Zero(3, 5), good).find("q has shape (3, 5)"), std::string::npos);
  EXPECT_NE(of(good, MatX::Zero(2, 4)).find("q has 3 rows and v has 2"), std::string::npos);
  bad(2, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(of(bad, good), "q[2, \"sway_0\"] = nan is not finite");
  EXPECT_EQ(of(good, bad), "v[2, \"sway_0\"] = nan is not finite");
}

TEST(Batch, BadStartsAndNumbersAreNamedBeforeAnythingRuns) {
  const Model model = cradle({.balls = 2});
  bool ran = false;
  const auto of = [&](const std::vector<State>& starts, BatchOptions options = {},
                      double duration = 1) {
    options.run.progress = [&](double) { return ran = true; };
    return message_of([&] { simulate_batch(model, starts, duration, options); });
  };
  const auto expect = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  const State good = model.state();
  State bad = good;
  expect(of({}), "no starts");
  bad.q[2] = std::numeric_limits<double>::infinity();
  expect(of({good, bad}), "states[1].q[\"swing_1\"] = inf is not finite");
  bad = good;
  bad.p.resize(3);
  expect(of({good, good, bad}), "states[2].p has 3 entries; the model has 4");
  bad = good;
  bad.t = 2;
  expect(of({good, bad}), "states[1].t = 2 s, and states[0].t = 0 s");
  bad.t = std::nan("");
  expect(of({bad}), "states[0].t = nan is not finite");
  expect(of({good}, {.threads = -1}), "threads = -1; it must be at least 1");
  expect(of({good}, {.run = {.record_every = 0}}), "record_every = 0");
  expect(of({good}, {.run = {.step = {.max_impacts = 0}}}), "max_impacts = 0");
  expect(of({good}, {}, -1), "duration = -1");
  expect(of(std::vector<State>(100, good), {.run = {.step = {.h = 1e-6}}}, 10),
         "100 runs of 10000001 rows");
  EXPECT_FALSE(ran);
}

}  // namespace
}  // namespace saltus
