// A stepper that forgets is as good as new: the same start gives the same bits, before and after
// impacts, contacts that rest, and steps that failed.
#include <gtest/gtest.h>

#include "scenes.hpp"

namespace saltus {
namespace {

using scenes::cradle;

TEST(Stepper, ForgetsWhateverItDidBefore) {
  ModelBuilder b("balls");
  for (int i = 0; i < 4; ++i) {
    scenes::add_bead(b, "z_" + std::to_string(i), Vec3(0.2 * (i % 2), 0, 0.1 + 0.25 * (i / 2)),
                     Vec3::UnitZ(), 1 + i, 0.1);
  }
  b.add_half_space("floor", Vec3::UnitZ());
  for (const Model& model : {b.build(), cradle({.balls = 4})}) {
    for (const ImpactLaw law : {ImpactLaw::nodal_energy, ImpactLaw::discrete_energy}) {
      Stepper stepper(model, {.h = 0.01, .law = law});
      const VecX up = VecX::LinSpaced(model.n_q(), 0.3, 0);
      const State start = model.state(up, VecX::Zero(model.n_q()));
      const auto run = [&](State state, int steps) {
        stepper.forget();
        for (int k = 0; k < steps; ++k) stepper.step(state);
        return state;
      };
      const State before = run(start, 150);
      // also where it ended just there
      EXPECT_EQ(run(before, 1), Stepper(model, stepper.options()).advance(before));
      run(model.state(), 20);  // rests
      EXPECT_ANY_THROW(run(model.state(VecX::Constant(model.n_q(), -0.1) + up, up), 1));
      run(model.state(up.reverse(), up), 77);
      EXPECT_EQ(run(start, 150), before);
    }
  }
}

}  // namespace
}  // namespace saltus
