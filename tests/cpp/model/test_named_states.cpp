// States and sensors by name.
#include <gtest/gtest.h>

#include "kit/ask.hpp"
#include "kit/builders.hpp"
#include "saltus/model/named_state.hpp"

namespace saltus {
namespace {

using test::arm;
using test::expect_error;
using test::two_balls;

TEST(NamedStates, AreFoundByName) {
  ModelBuilder builder = arm();
  builder.add_state({"home", {{"elbow", {0.5}}}, {{"shoulder", {-2}}}}).add_state({"rest"});
  const Model model = builder.build();
  EXPECT_EQ(state_names(model), (std::vector<std::string>{"home", "rest"}));
  const State home = named_state(model, "home", 3);
  EXPECT_EQ(home, model.state({{"elbow", 0.5}}, {{"shoulder", -2}}, 3));
  EXPECT_EQ(named_state(model, "rest"), model.state());
  expect_error([&] { named_q(model, "up"); }, "state", "up",
               {"no state \"up\"; there are home, rest"});
}

TEST(NamedStates, ThatNoneAreAreRefusedAndNotAdded) {
  ModelBuilder builder = arm();
  const auto refused = [&](const StateSpec& state, const std::string& words) {
    expect_error([&] { builder.add_state(state); }, "state", state.name, {words});
  };
  refused({"a", {{"wrist", {1}}}}, "joint \"wrist\", which does not exist");
  refused({"a", {{"elbow", {1, 2}}}}, "has 2 numbers in q[\"elbow\"]; the joint takes 1 number");
  refused({"a", {}, {{"elbow", {}}}}, "has 0 numbers in v[\"elbow\"]");
  refused({""}, "a state has no name");
  EXPECT_TRUE(builder.description().states.empty());
}

TEST(Sensors, AreOfWhatIsThere) {
  ModelBuilder builder = arm();
  builder.add_sensor({"angle", SensorKind::jointpos, "elbow"});
  const auto refused = [&](const SensorSpec& sensor, const std::string& words) {
    expect_error([&] { builder.add_sensor(sensor); }, "sensor", sensor.name, {words});
  };
  refused({"angle", SensorKind::jointvel, "elbow"}, "two sensors are named");
  refused({"a", SensorKind::gyro, "elbow"}, "is of link \"elbow\", which does not exist");
  refused({"a", SensorKind::gyro, "upper", "lower"}, "only touch and contactforce");
  refused({"a", SensorKind::touch, "upper", "ground"}, "links and half-spaces are");
  EXPECT_EQ(builder.build()->description->sensors.size(), 1u);
}

TEST(NamedStates, GetThePrefixOfWhatIsAdded) {
  ModelBuilder builder = arm();
  builder.add_state({"home", {{"elbow", {0.5}}}});
  builder.add_sensor({"angle", SensorKind::jointpos, "elbow"});
  const Model whole = ModelBuilder("hall").add(builder.description(), {.prefix = "a_"}).build();
  EXPECT_EQ(named_q(whole, "a_home"), named_q(builder.build(), "home"));
  EXPECT_EQ(whole->description->sensors[0].of, "a_elbow");
  ModelBuilder twice = arm();
  twice.add_state({"b_home"});
  const ModelDescription other = ModelBuilder(two_balls()).add_state({"home"}).description();
  expect_error([&] { twice.add(other, {.prefix = "b_"}); }, "state", "b_home",
               {"both", "state \"b_home\"; a prefix makes names differ"});
}

}  // namespace
}  // namespace saltus
