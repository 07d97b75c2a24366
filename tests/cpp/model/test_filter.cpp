// Which links are let pass through each other.
#include <gtest/gtest.h>

#include "kit/ask.hpp"
#include "kit/builders.hpp"

namespace saltus {
namespace {

using test::joint;
using test::some_body;

using Names = std::vector<std::string>;

/// A floor, and a chain of links a, b, c with a ball on each, and d welded to c.
ModelBuilder beads() {
  ModelBuilder builder("beads");
  builder.add_half_space("floor", Vec3::UnitZ(), -9);
  std::string last = "world";
  for (const std::string name : {"a", "b", "c", "d"}) {
    builder.add_link({name, some_body()}).add_shape(name, Sphere{0.1});
    const JointType type = name == "d" ? JointType::fixed : JointType::revolute;
    builder.add_joint(joint("to_" + name, type, last, name, {0, 0, -1}));
    last = name;
  }
  return builder;
}

/// Without those of the floor unless asked for.
Names pair_names(const ModelBuilder& builder, bool of_floor = false) {
  const Model model = builder.build();
  Names names;
  for (int i = 0; i < model->pairs.size(); ++i) {
    const std::string name = model.pair_name(i);
    if ((name.find("floor") != std::string::npos) == of_floor) names.push_back(name);
  }
  return names;
}

TEST(Filter, AdjacentLinksAreExcludedUnlessSaidOtherwise) {
  const Names apart{"a ~ c", "a ~ d"};
  EXPECT_EQ(pair_names(beads()), apart);
  EXPECT_EQ(pair_names(beads().set_adjacent_links(AdjacentLinks::excluded)), apart);
  EXPECT_EQ(pair_names(beads().set_adjacent_links(AdjacentLinks::watched)),
            (Names{"a ~ b", "a ~ c", "a ~ d", "b ~ c", "b ~ d"}));
}

TEST(Filter, ExcludedBodiesStillFall) {
  EXPECT_EQ(pair_names(beads().add_body_exclusion("d", "a")), Names{"a ~ c"});
  EXPECT_EQ(pair_names(beads().add_body_exclusion("world", "a"), true).size(), 4u);
  EXPECT_EQ(pair_names(beads().add_exclusion("world", "a"), true).size(), 3u);
}

TEST(Filter, GroupsPassThroughEachOther) {
  EXPECT_EQ(pair_names(beads().set_group("a", "x").set_group("c", "y")).size(), 2u);
  EXPECT_EQ(
      pair_names(beads().set_group("a", "x").set_group("c", "y").add_group_exclusion("y", "x")),
      Names{"a ~ d"});
  EXPECT_EQ(
      pair_names(beads().set_group("a", "x").set_group("d", "x").add_group_exclusion("x", "x")),
      Names{"a ~ c"});
  EXPECT_EQ(pair_names(beads().set_group("a", "x").set_group("d", "x")).size(), 2u);
  // the last word holds
  EXPECT_EQ(
      pair_names(
          beads().set_group("a", "x").set_group("d", "x").set_group("d", "z").add_group_exclusion(
              "x", "x"))
          .size(),
      2u);
  EXPECT_EQ(
      pair_names(beads().set_group("a", "x").set_group("world", "w").add_group_exclusion("w", "x"),
                 true)
          .size(),
      3u);
}

void expect_error(const ModelBuilder& builder, const std::string& element, const std::string& name,
                  const std::string& part) {
  test::expect_error([&] { builder.check(); }, element, name, {part});
}

TEST(Filter, MistakesAreNamed) {
  expect_error(beads().set_group("e", "x"), "group", "x",
               "group \"x\" names link \"e\", which does not exist; links are world, a, b, c, d");
  expect_error(beads().set_group("a", "x").add_group_exclusion("x", "z"), "group", "z",
               "an exclusion names group \"z\", which no link is in; groups are x");
  expect_error(beads().add_group_exclusion("x", "x"), "group", "x", "groups are none");
  expect_error(beads().add_body_exclusion("a", "e"), "link", "e", "an exclusion names link \"e\"");
  EXPECT_THROW(beads().set_group("a", ""), ModelError);
}

}  // namespace
}  // namespace saltus
