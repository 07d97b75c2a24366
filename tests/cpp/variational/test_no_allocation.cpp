// A step after the first allocates nothing, impacts included.
#include <gtest/gtest.h>

#include "count_allocations.hpp"
#include "scenes.hpp"

namespace saltus {
namespace {

using scenes::cradle;
using test::allocations;

TEST(Stepper, AStepAfterTheFirstAllocatesNothing) {
  const Model model = cradle({.balls = 5});
  Stepper stepper(model, {.h = 0.01});
  State state = model.state({{"swing_0", 0.3}, {"swing_1", 0.3}, {"sway_0", 0.05}});
  for (int k = 0; k < 60; ++k) stepper.step(state);  // past the first impact
  const long before = allocations;
  int impacts = 0;
  for (int k = 0; k < 300; ++k) {
    stepper.step(state);
    impacts += static_cast<int>(stepper.report().impacts.size());
  }
  EXPECT_EQ(allocations, before);
  EXPECT_GT(impacts, 2);
}

}  // namespace
}  // namespace saltus
