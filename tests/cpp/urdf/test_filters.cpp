// Which pairs are watched, from the block <saltus> and from SRDF.
#include <gtest/gtest.h>

#include "urdf/urdf_files.hpp"

namespace saltus {
namespace {

using namespace test;
using Names = std::vector<std::string>;

/// A floor in line 5, and balls a, b, c, d: b hangs on a, the others fly.
std::string balls(const std::string& block = "", const std::string& more = "") {
  const std::string ball = "<collision><geometry><sphere radius=\"0.1\"/></geometry></collision>";
  std::string text = "<link name=\"world\"/>";
  for (const std::string name : {"a", "b", "c", "d"}) text += ball_link(name, ball);
  text += joint("ja", "floating", "world", "a") + joint("jb", "continuous", "a", "b") +
          joint("jc", "floating", "world", "c") + joint("jd", "floating", "world", "d");
  return robot(text + more + "<saltus>\n" + block + "</saltus>");
}

Names pairs(const std::string& block, const std::optional<std::string>& srdf = {},
            const std::string& more = "") {
  const Model model = load(balls(block, more), {.srdf = srdf});
  return model.gaps(model.neutral()).names;
}

const Names all = {"a ~ c", "a ~ d", "b ~ c", "b ~ d", "c ~ d"};

TEST(UrdfFilters, GroupsPassThroughEachOther) {
  EXPECT_EQ(pairs(""), all);
  const std::string groups =
      "<group name=\"x\" links=\"a b\"/><group name=\"y\" links=\" c\td \"/>";
  EXPECT_EQ(pairs(groups), all);
  EXPECT_EQ(pairs(groups + "<exclude group1=\"x\" group2=\"y\"/>"), Names{"c ~ d"});
  EXPECT_EQ(pairs("<exclude group1=\"y\" group2=\"y\"/>" + groups),
            (Names{"a ~ c", "a ~ d", "b ~ c", "b ~ d"}));
  EXPECT_EQ(pairs(groups + "<exclude group1=\"x\" group2=\"x\"/>"), all);
}

TEST(UrdfFilters, HalfSpacesAreInTheGroupOfTheRootLink) {
  const std::string text =
      "<half_space name=\"floor\"/><group name=\"x\" links=\"a\"/><group name=\"w\" "
      "links=\"world\"/><exclude group1=\"w\" group2=\"x\"/>";
  Names expected = all;
  for (const std::string ball : {"b", "c", "d"}) expected.push_back(ball + " ~ floor");
  Names found = pairs(text);
  std::sort(found.begin(), found.end());
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(found, expected);
}

TEST(UrdfFilters, AdjacentLinksMayBeWatched) {
  EXPECT_EQ(pairs("<adjacent_links gaps=\"excluded\"/>"), all);
  EXPECT_EQ(pairs("<adjacent_links gaps=\"watched\"/>"),
            (Names{"a ~ b", "a ~ c", "a ~ d", "b ~ c", "b ~ d", "c ~ d"}));
  EXPECT_EQ(pairs("<adjacent_links gaps=\"watched\"/><exclude link1=\"b\" link2=\"a\"/>"), all);
  // welded together they cannot collide
  EXPECT_EQ(
      pairs("<adjacent_links gaps=\"watched\"/>", {},
            ball_link("e", "<collision><geometry><sphere radius=\"1\"/></geometry></collision>") +
                joint("je", "fixed", "d", "e") + "\n")
          .size(),
      6u + 3u);
}

TEST(UrdfFilters, MistakesAreErrors) {
  const auto what = [](const std::string& block) {
    return message_of([&] { read_urdf(balls(block)); });
  };
  const std::string x = "<group name=\"x\" links=\"a b\"/>";
  expect_contains(
      what("<group name=\"x\" links=\"a e\"/>"),
      "group \"x\" names link \"e\", which does not exist; links are world, a, b, c, d");
  expect_contains(what("<group links=\"a\"/>"), "<group> is without attribute \"name\"");
  expect_contains(what("<group name=\"x\"/>"), "group \"x\" is without attribute \"links\"");
  expect_contains(what(x + "\n" + x), "group \"x\" has the name of another group");
  expect_contains(what(x + "<group name=\"y\" links=\"b\"/>"),
                  "group \"y\" names link \"b\", which is in group \"x\" already");
  expect_contains(what(x + "<exclude group1=\"x\" group2=\"y\"/>"),
                  "<exclude> names group \"y\", which does not exist; groups are x");
  expect_contains(what("<exclude group1=\"x\" group2=\"y\"/>"), "groups are none");
  expect_contains(what(x + "<exclude group1=\"x\"/>"), "<exclude> is without attribute \"group2\"");
  expect_contains(what(x + "<exclude group1=\"x\" group2=\"x\" link1=\"a\"/>"),
                  "<exclude> names links and groups");
  expect_contains(what("<exclude/>"), "<exclude> is without attribute \"link1\"");
  expect_contains(what("<adjacent_links gaps=\"on\"/>"),
                  "<adjacent_links> has gaps=\"on\"; known are excluded, watched");
}

TEST(Srdf, SaysWhichLinksNeverCollide) {
  const std::string disable = "<disable_collisions link1=\"c\" link2=\"a\" reason=\"Never\"/>";
  EXPECT_EQ(pairs("", "<robot name=\"r\">" + disable + "</robot>"),
            (Names{"a ~ d", "b ~ c", "b ~ d", "c ~ d"}));
  // other elements are not looked at
  EXPECT_EQ(pairs("", "<robot><group name=\"arm\"><chain base_link=\"x\"/></group>" + disable +
                          "<virtual_joint/></robot>")
                .size(),
            4u);
}

TEST(Srdf, DefaultsHaveExceptions) {
  const std::string defaults = "<disable_default_collisions link=\"c\"/>";
  EXPECT_EQ(pairs("", "<robot>" + defaults + "</robot>"), (Names{"a ~ d", "b ~ d"}));
  const std::string enable = "<enable_collisions link1=\"c\" link2=\"b\"/>";
  EXPECT_EQ(pairs("", "<robot>" + defaults + enable + "</robot>"),
            (Names{"a ~ d", "b ~ c", "b ~ d"}));
  EXPECT_EQ(pairs("", "<robot>" + defaults + enable +
                          "<disable_collisions link1=\"b\" link2=\"c\"/></robot>"),
            (Names{"a ~ d", "b ~ d"}));
}

TEST(Srdf, LeavesHalfSpaces) {
  const Names found = pairs("<half_space name=\"floor\"/>",
                            "<robot><disable_collisions link1=\"world\" link2=\"a\"/></robot>");
  EXPECT_EQ(found.size(), all.size() + 4);
}

TEST(Srdf, LinksThatTheRobotHasNotAreOneWarning) {
  const Model model =
      load(balls(), {.srdf = "<robot>\n<disable_collisions link1=\"a\" link2=\"x\"/>"
                             "<disable_collisions link1=\"a\" link2=\"c\"/>"
                             "<disable_collisions link1=\"y\" link2=\"x\"/></robot>"});
  EXPECT_EQ(model->pairs.size(), 4);
  ASSERT_EQ(model->warnings.size(), 1u);
  expect_warning(
      model, {"SRDF text:2: <disable_collisions> and below: links that the robot has not", "x, y",
              "links are world, a, b, c, d"});
}

TEST(Srdf, MistakesAreErrors) {
  const auto what = [](const std::string& srdf) {
    return message_of([&] { read_urdf(balls(), {.srdf = srdf}); });
  };
  expect_contains(what("<robot>\n<disable_collisions link1=\"a\"/></robot>"),
                  "SRDF text:2: <disable_collisions> is without attribute \"link2\"");
  expect_contains(what("<srdf/>"), "SRDF text:1: no <robot> element");
  expect_contains(what("<robot"), "SRDF text:1: not XML");
  expect_contains(what("nowhere.srdf"), "no file \"nowhere.srdf\"");
  expect_contains(what(""), "neither the path of an SRDF file nor SRDF text");
}

class SrdfFiles : public UrdfFiles {};

TEST_F(SrdfFiles, AreReadAndTellTheirName) {
  const std::string path =
      write("r.srdf", "<robot>\n<disable_collisions link1=\"a\" link2=\"c\"/></robot>");
  EXPECT_EQ(pairs("", path).size(), 4u);
  expect_contains(message_of([&] { read_urdf(balls(), {.srdf = folder_.string()}); }),
                  "is a directory, not an SRDF file; SRDF files there are r.srdf");
  const std::string bad = write("bad.srdf", "<robot>\n\n<enable_collisions/></robot>");
  expect_contains(message_of([&] { read_urdf(balls(), {.srdf = bad}); }), bad + ":3: ");
}

TEST(UrdfExtension, EllipsoidsAreShapes) {
  const Model model =
      load(robot(ball_link("a") + "<saltus><ellipsoid link=\"a\" radii=\"0.1 0.2 0.3\"><origin "
                                  "xyz=\"1 2 3\"/></ellipsoid></saltus>"));
  ASSERT_EQ(model->shapes.size(), 1u);
  EXPECT_EQ(std::get<Ellipsoid>(model->shapes[0].shape).radii, Vec3(0.1, 0.2, 0.3));
  expect_near(model->shapes[0].X_JG.p, {1, 2, 3});
  const auto what = [](const std::string& attributes) {
    return message_of([&] {
      read_urdf(robot("<link name=\"a\"/><saltus><ellipsoid " + attributes + "/></saltus>"));
    });
  };
  expect_contains(what("link=\"a\" radii=\"1 2 0\""),
                  "<ellipsoid> has radii=\"1 2 0\": a size must be positive");
  expect_contains(what("link=\"a\" radii=\"1 2\""), "3 numbers are needed");
  expect_contains(what("link=\"a\""), "<ellipsoid> is without attribute \"radii\"");
  expect_contains(what("link=\"b\" radii=\"1 2 3\""), "<ellipsoid> names link \"b\"");
}

}  // namespace
}  // namespace saltus
