// Materials and contacts in the block <saltus>.
#include <gtest/gtest.h>

#include "urdf/urdf_files.hpp"

namespace saltus {
namespace {

using namespace test;

/// Two balls that fly, a and b, and a floor.
std::string balls(const std::string& block) {
  const std::string ball = "<collision><geometry><sphere radius=\"0.1\"/></geometry></collision>";
  return robot("<link name=\"world\"/>" + ball_link("a", ball) + ball_link("b", ball) +
               joint("ja", "floating", "world", "a") + joint("jb", "floating", "world", "b") +
               "<saltus><half_space name=\"floor\"/>\n" + block + "</saltus>");
}

ContactProperties between(const Model& model, const std::string& name) {
  for (int k = 0; k < model->pairs.size(); ++k) {
    if (model.pair_name(k) == name) return model.contact_properties(k);
  }
  throw ModelError("no pair " + name);
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

}  // namespace
}  // namespace saltus
