// Mistakes in the XML, in names, in the tree and in joints: each message has the place, the culprit
// and what would be right.
#include "urdf/mistakes.hpp"

namespace saltus {
namespace {

using namespace test;

class UrdfStructureErrors : public testing::TestWithParam<Mistake> {};

TEST_P(UrdfStructureErrors, NamePlaceCulpritAndAlternatives) { expect_error(GetParam()); }

const Mistake xml_mistakes[] = {
    {"EndsTooEarly", "</robot>\n", "", 36, {"not XML", "ends before all elements are closed"}},
    {"WrongEndTag", "</link>", "</lnik>", 3, {"not XML", "closed", "<link>"}},
    {"NoQuotes", R"(value="1")", "value=1", 6, {"not XML", "quotes", "<mass>"}},
    {"AttributeTwice", R"(value="1")", R"(value="1" value="2")", 6, {"not XML", "twice"}},
    {"CommentNeverEnds", "<collision>", "<!-- <collision>", 9, {"not XML", "comment"}},
    {"TextAfterwards", "</robot>\n", "</robot>\njunk", 38, {"not XML", "text outside"}},
    {"TwoRobots", "</robot>\n", "</robot>\n<robot name=\"b\"/>", 38, {"second <robot>", "line 1"}},
    {"Xacro",
     R"(<link name="base"/>)",
     R"(<link name="base"/><xacro:arm/>)",
     2,
     {"<xacro:arm>", "xacro file", "expand"}},
};
INSTANTIATE_TEST_SUITE_P(Xml, UrdfStructureErrors, testing::ValuesIn(xml_mistakes), kind);

const Mistake names_mistakes[] = {
    {"UnknownParent",
     R"(<parent link="upper"/>)",
     R"(<parent link="uper"/>)",
     26,
     {R"(joint "elbow" names parent link "uper", which does not exist)",
      "links are base, upper, lower"},
     "joint",
     "elbow"},
    {"UnknownChild",
     R"(<child link="lower"/>)",
     R"(<child link="lowr"/>)",
     27,
     {R"(joint "elbow" names child link "lowr")", "links are base, upper, lower"},
     "joint",
     "elbow"},
    {"NoParent",
     R"(<parent link="upper"/>)",
     "",
     25,
     {R"(joint "elbow" has no <parent>)"},
     "joint",
     "elbow"},
    {"EmptyParent",
     R"(<parent link="upper"/>)",
     "<parent/>",
     26,
     {R"(joint "elbow" has <parent> without attribute "link")"},
     "joint",
     "elbow"},
    {"TwoLinksOfAName",
     R"(<link name="lower">)",
     R"(<link name="upper">)",
     13,
     {R"(two links are named "upper")", "line 3"},
     "link",
     "upper"},
    {"TwoJointsOfAName",
     R"(<joint name="elbow")",
     R"(<joint name="shoulder")",
     25,
     {R"(two joints are named "shoulder")", "line 19"},
     "joint",
     "shoulder"},
    {"LinkWithoutName",
     R"(<link name="lower">)",
     "<link>",
     13,
     {R"(<link> is without attribute "name")"}},
    {"EmptyName",
     R"(<joint name="elbow")",
     R"(<joint name="")",
     25,
     {R"(<joint> is without attribute "name")"}},
    {"UnknownMimic",
     R"(mimic joint="shoulder")",
     R"(mimic joint="sholder")",
     30,
     {R"(joint "elbow" mimics joint "sholder", which does not exist)", "shoulder"},
     "joint",
     "elbow"},
    {"MimicOfItself",
     R"(mimic joint="shoulder")",
     R"(mimic joint="elbow")",
     25,
     {R"(joint "elbow")", "cycle"},
     "joint",
     "elbow"},
    {"MimicOfAFixedJoint",
     R"(type="revolute")",
     R"(type="fixed")",
     30,
     {R"(joint "elbow" mimics joint "shoulder", which is fixed)"},
     "joint",
     "elbow"},
    {"MimicOfALargeJoint",
     R"(type="revolute")",
     R"(type="floating")",
     25,
     {R"(joint "elbow" mimics joint "shoulder")", "one coordinate"},
     "joint",
     "elbow"},
    {"MimicByALargeJoint",
     R"(type="continuous")",
     R"(type="spherical")",
     25,
     {R"(joint "elbow" mimics)", "one coordinate"},
     "joint",
     "elbow"},
};
INSTANTIATE_TEST_SUITE_P(Names, UrdfStructureErrors, testing::ValuesIn(names_mistakes), kind);

const Mistake tree_mistakes[] = {
    {"TwoRoots",
     R"(<link name="base"/>)",
     R"(<link name="base"/><link name="alone"/>)",
     2,
     {R"(link "alone" has no joint above it)", "one root", "base, alone"},
     "link",
     "alone"},
    {"CycleBesideTheRoot",
     R"(<parent link="base"/>)",
     R"(<parent link="lower"/>)",
     19,
     {R"(joint "shoulder" closes a cycle of links: upper -> lower -> upper)"},
     "joint",
     "shoulder"},
    {"CycleOfOne",
     R"(<parent link="upper"/>)",
     R"(<parent link="lower"/>)",
     25,
     {R"(joint "elbow" closes a cycle of links: lower -> lower)"},
     "joint",
     "elbow"},
    {"TwoParents",
     R"(<child link="lower"/>)",
     R"(<child link="upper"/>)",
     25,
     {R"(joint "elbow" gives link "upper" a second parent)", R"(joint "shoulder" in line 19)"},
     "joint",
     "elbow"},
};
INSTANTIATE_TEST_SUITE_P(Tree, UrdfStructureErrors, testing::ValuesIn(tree_mistakes), kind);

const Mistake joints_mistakes[] = {
    {"ZeroAxis",
     R"(<axis xyz="0 1 0"/>)",
     R"(<axis xyz="0 0 0"/>)",
     22,
     {R"(joint "shoulder" has zero axis)"},
     "joint",
     "shoulder"},
    {"AxisWithoutXyz",
     R"(<axis xyz="0 1 0"/>)",
     "<axis/>",
     22,
     {R"(joint "shoulder" has <axis> without attribute "xyz")"},
     "joint",
     "shoulder"},
    {"UnknownType",
     R"(type="continuous")",
     R"(type="hinge")",
     25,
     {R"(joint "elbow" has type "hinge")", "types are revolute, continuous", "ball"},
     "joint",
     "elbow"},
    {"NoType",
     R"(type="continuous")",
     "",
     25,
     {R"(joint "elbow" is without attribute "type")"},
     "joint",
     "elbow"},
    {"RevoluteWithoutLimit",
     R"(<limit lower="-1" upper="1" effort="10" velocity="1"/>)",
     "",
     19,
     {R"(joint "shoulder" is revolute and has no <limit>)", "continuous"},
     "joint",
     "shoulder"},
    {"PrismaticWithoutLimit",
     R"(type="continuous")",
     R"(type="prismatic")",
     25,
     {R"(joint "elbow" is prismatic and has no <limit>)"},
     "joint",
     "elbow"},
    {"LimitsExchanged",
     R"(lower="-1")",
     R"(lower="3")",
     23,
     {R"(joint "shoulder")", "lower limit 3", "upper limit 1"},
     "joint",
     "shoulder"},
    {"TwoOrigins",
     R"(<origin xyz="0 0 1"/>)",
     R"(<origin xyz="0 0 1"/><origin/>)",
     28,
     {R"(joint "elbow" has a second <origin>)", "line 28"},
     "joint",
     "elbow"},
    {"TwoRotations",
     R"(<origin xyz="0 0 1"/>)",
     R"(<origin rpy="0 0 1" quat_xyzw="0 0 0 1"/>)",
     28,
     {R"(joint "elbow")", "both rpy and quat_xyzw"},
     "joint",
     "elbow"},
    {"ZeroQuaternion",
     R"(<origin xyz="0 0 1"/>)",
     R"(<origin quat_xyzw="0 0 0 0"/>)",
     28,
     {R"(joint "elbow")", "zero quat_xyzw"},
     "joint",
     "elbow"},
};
INSTANTIATE_TEST_SUITE_P(Joints, UrdfStructureErrors, testing::ValuesIn(joints_mistakes), kind);

const Mistake masses_mistakes[] = {
    {"MasslessLeaf",
     R"(  <joint name="shoulder")",
     "  <link name=\"tip\"/><joint name=\"tip_joint\" type=\"continuous\"><parent "
     "link=\"lower\"/><child link=\"tip\"/></joint>\n  <joint name=\"shoulder\"",
     19,
     {R"(joint "tip_joint" moves no mass)"},
     "joint",
     "tip_joint"},
};
INSTANTIATE_TEST_SUITE_P(Masses, UrdfStructureErrors, testing::ValuesIn(masses_mistakes), kind);

TEST(UrdfErrors, TheFileItselfIsGood) {
  const Model model = load(good_file);
  EXPECT_EQ(model.n_q(), 1);
  EXPECT_EQ(model->shapes.size(), 3u);
}

// The joints are in neither order of the cycle, and the root is no part of it.
TEST(UrdfErrors, ACycleIsNamed) {
  const std::string text =
      robot("<link name=\"base\"/>" + ball_link("a") + ball_link("b") + ball_link("c") +
            joint("bc", "continuous", "b", "c") + joint("ab", "continuous", "a", "b") +
            joint("ca", "continuous", "c", "a"));
  const std::string what = message_of([&] { read_urdf(text); });
  expect_contains(what, "closes a cycle of links: ");
  const bool named = what.find("a -> b -> c -> a") != std::string::npos ||
                     what.find("b -> c -> a -> b") != std::string::npos ||
                     what.find("c -> a -> b -> c") != std::string::npos;
  EXPECT_TRUE(named) << what;
}

TEST(UrdfErrors, NoLinkAndNoRobot) {
  expect_contains(message_of([] { read_urdf("<robot name=\"r\"/>"); }),
                  "URDF text:1: the robot has no <link>");
  expect_contains(message_of([] { read_urdf("<sdf>\n<model/></sdf>"); }),
                  "URDF text:1: no <robot> element: the root element is <sdf>");
  expect_contains(message_of([] { read_urdf("<!-- nothing -->"); }), "no <robot> element");
}

}  // namespace
}  // namespace saltus
