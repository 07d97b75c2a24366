// A stepper that forgets is as good as new: the same start gives the same bits, before and after
// impacts, contacts that rest, and steps that failed.
#include <gtest/gtest.h>

#include "kit/scenes.hpp"

namespace saltus {
namespace {

using scenes::cradle;

/// Two stacks of two balls above a floor, side by side.
Model stacks() {
  ModelBuilder b("stacks");
  for (int i = 0; i < 4; ++i) {
    const Vec3 at(0.2 * (i % 2), 0, 0.1 + 0.2 * (i / 2));
    scenes::add_bead(b, "z_" + std::to_string(i), at, Vec3::UnitZ(), 1 + i, 0.1);
  }
  b.add_half_space("floor", Vec3::UnitZ());
  return b.build();
}

/// @param apart coordinates at which no bodies overlap; in the reverse order some do
void expect_forgetful(const Model& model, const VecX& apart, ImpactLaw law) {
  Stepper stepper(model, {.h = 0.01, .law = law});
  const VecX none = VecX::Zero(model.n_q());
  const auto run = [&](State state, int steps) {
    stepper.forget();
    for (int k = 0; k < steps; ++k) stepper.step(state);
    return state;
  };
  const State start = model.state(apart, none);
  const State end = run(start, 150);
  // also where the stepper ended just there
  EXPECT_EQ(run(end, 1), Stepper(model, stepper.options()).advance(end));
  run(model.state(), 20);  // rests
  EXPECT_THROW(run(model.state(VecX(apart.reverse()), none), 1), ModelError);
  try {
    run(model.state(apart, VecX(1e200 * apart)), 1);
  } catch (const StepError&) {  // of the cradle; stacks are linear
  }
  run(model.state(VecX(0.5 * apart), apart), 77);
  EXPECT_EQ(run(start, 150), end);
}

TEST(Stepper, ForgetsWhateverItDidBefore) {
  for (const ImpactLaw law : {ImpactLaw::nodal_energy, ImpactLaw::discrete_energy}) {
    expect_forgetful(stacks(), VecX::LinSpaced(4, 0, 0.3), law);
    expect_forgetful(cradle({.balls = 4}), VecX::LinSpaced(8, 0.3, 0), law);
  }
}

}  // namespace
}  // namespace saltus
