// Materials and contacts in the block <saltus>.
#include <gtest/gtest.h>

#include "urdf/urdf_files.hpp"

namespace saltus {
namespace {

using test::between;

using namespace test;

/// Two balls that fly, a and b, and a floor.
std::string balls(const std::string& block) {
  const std::string ball = "<collision><geometry><sphere radius=\"0.1\"/></geometry></collision>";
  return robot("<link name=\"world\"/>" + ball_link("a", ball) + ball_link("b", ball) +
               joint("ja", "floating", "world", "a") + joint("jb", "floating", "world", "b") +
               "<saltus><half_space name=\"floor\"/>\n" + block + "</saltus>");
}

TEST(UrdfMaterials, BelongToPairs) {
  const Model model = load(
      balls("<material name=\"steel\" links=\"a b\"/><material name=\"clay\" links=\"world\"/>"
            "<contact material1=\"clay\" material2=\"steel\" restitution=\"0\" friction=\"0.5\"/>"
            "<contact restitution=\"0.25\"/>"));
  EXPECT_EQ(between(model, "a ~ floor"), (ContactProperties{0, 0.5}));
  EXPECT_EQ(between(model, "a ~ b"), (ContactProperties{0.25, 0}));
  EXPECT_EQ(between(load(balls("")), "a ~ b"), (ContactProperties{1, 0}));
}

TEST(UrdfMaterials, MistakesAreNamed) {
  const auto error = [](const std::string& block) {
    try {
      load(balls(block));
    } catch (const ModelError& e) {
      return std::string(e.what());
    }
    return std::string("none");
  };
  const auto expect = [&](const std::string& block, const std::string& part) {
    EXPECT_NE(error(block).find(part), std::string::npos) << error(block);
  };
  expect("<contact restitution=\"1.5\"/>", "restitution 1.5; it is in [0, 1]");
  expect("<contact friction=\"-1\"/>", "friction -1; it is not negative");
  expect("<contact material1=\"x\"/>", "names one material");
  expect("<material name=\"steel\" links=\"a\"/><contact material1=\"steel\" material2=\"stel\"/>",
         "material \"stel\", which does not exist; materials are steel");
  expect("<material name=\"x\" links=\"a\"/><material name=\"y\" links=\"a\"/>",
         "link \"a\", which is in material \"x\" already");
  expect("<material name=\"x\" links=\"c\"/>", "link \"c\", which does not exist");
  expect("<contact bounce=\"1\"/>", "unknown attribute, bounce");
}

TEST(UrdfMaterials, OptionsSetTheDefaultContactAndAddAFloor) {
  const std::string fall = "<collision><geometry><sphere radius=\"0.1\"/></geometry></collision>";
  const std::string lone = ball_link("a", fall);
  UrdfOptions options;
  options.root_joint = JointType::floating;
  options.floor = true;
  const ContactProperties said{0.2, 0.6};
  EXPECT_EQ(load_urdf(robot(lone), options)->warnings.size(), 1u);
  options.contact = said;
  const Model model = load_urdf(robot(lone), options);
  EXPECT_TRUE(model->warnings.empty());
  EXPECT_EQ(between(model, "a ~ floor"), said);
  // the file's default gives way, its floor and its contacts of materials stay
  const Model file = load_urdf(robot(lone + "<saltus><half_space name=\"ground\"/>"
                                            "<material name=\"steel\" links=\"a\"/>"
                                            "<contact restitution=\"0.9\"/></saltus>"),
                               options);
  ASSERT_EQ(file->pairs.size(), 1);
  EXPECT_EQ(between(file, "a ~ ground"), said);
  const Model lower = load_urdf(
      robot(lone + "<saltus><half_space name=\"floor\" offset=\"-1\"/></saltus>"), options);
  EXPECT_EQ(between(lower, "a ~ floor_"), said);
}

TEST(UrdfMaterials, LoadIsReadAndBuilt) {
  const std::string text = robot(ball_link("a", ""));
  UrdfOptions options;
  options.root_joint = JointType::floating;
  options.floor = true;
  options.contact = ContactProperties{0.2, 0.6};
  const Model loaded = load_urdf(text, options), built = read_urdf(text, options).build();
  EXPECT_EQ(loaded->source, text);
  EXPECT_EQ(loaded->shapes.size(), 1u);
  EXPECT_EQ(loaded->shapes.size(), built->shapes.size());
  EXPECT_EQ(loaded->joints[0].name, built->joints[0].name);
  EXPECT_EQ(loaded.mass_matrix(loaded.neutral()), built.mass_matrix(built.neutral()));
}

TEST(UrdfMaterials, TheMassOfTheRootCountsWhereItRides) {
  ModelBuilder builder;
  builder.add_body({.name = "cart", .shape = Sphere{1}, .mass = 1});
  const ModelBuilder base = read_urdf(robot(ball_link("base", "")));
  const double mass = base.description().links[0].inertia.mass;
  ASSERT_GT(mass, 0);
  const Model model = builder.add(base.description(), {.parent = "cart"}).build();
  EXPECT_DOUBLE_EQ(model.mass_matrix(model.state().q)(0, 0), 1 + mass);
}

}  // namespace
}  // namespace saltus
