// Links and joints of a builder that are said anew, and what models say of theirs.
#include <gtest/gtest.h>

#include <cmath>

#include "kit/ask.hpp"
#include "kit/builders.hpp"

namespace saltus {
namespace {

using test::arm;
using test::expect_error;

TEST(Changes, ABuildersPartsAreReadByName) {
  const ModelBuilder builder = arm();
  EXPECT_EQ(builder.link_spec("upper").inertia.mass, 2);
  EXPECT_EQ(builder.joint_spec("elbow").child, "lower");
  expect_error([&] { builder.link_spec("hand"); }, "link", "hand",
               {"no link \"hand\"; there are world, upper, lower"});
  expect_error([&] { builder.joint_spec("wrist"); }, "joint", "wrist",
               {"no joint \"wrist\"; there are shoulder, elbow"});
}

TEST(Changes, AMassKeepsTheCentreAndScalesTheInertia) {
  ModelBuilder builder = arm();
  const BodyInertia before = builder.link_spec("upper").inertia;
  const Model old = builder.build();
  builder.set_mass("upper", 6);
  const BodyInertia now = builder.build()->links[1].inertia;
  EXPECT_EQ(now.mass, 6);
  EXPECT_EQ(now.c_J, before.c_J);
  EXPECT_LT((now.I_J - 3 * before.I_J).norm(), 1e-15);
  EXPECT_EQ(old->links[1].mass, 2);
  // the mass matrix is linear in what each link weighs
  const VecX q = VecX::Zero(2);
  const MatX lower = builder.set_mass("upper", 2).build().mass_matrix(q);
  EXPECT_LT((lower - old.mass_matrix(q)).norm(), 1e-15);
}

TEST(Changes, AMassOfNothingGetsNoInertia) {
  ModelBuilder builder = arm();
  builder.add_link({"tag"}).add_joint(test::joint("glue", JointType::fixed, "lower", "tag"));
  builder.set_mass("tag", 0.5);
  EXPECT_EQ(builder.link_spec("tag").inertia.mass, 0.5);
  EXPECT_EQ(builder.link_spec("tag").inertia.I_J.norm(), 0);
}

TEST(Changes, AreCheckedAsWhatIsAdded) {
  ModelBuilder builder = arm();
  builder.set_source("text");
  expect_error([&] { builder.set_mass("upper", -1); }, "link", "upper", {"has mass -1"});
  expect_error([&] { builder.set_mass("upper", NAN); }, "link", "upper", {"has mass nan"});
  expect_error(
      [&] { builder.change_joint("elbow", [](JointSpec& j) { j.lower = 1, j.upper = 0; }); },
      "joint", "elbow", {"lower limit 1 and upper limit 0"});
  expect_error([&] { builder.change_joint("elbow", [](JointSpec& j) { j.axis.setZero(); }); },
               "joint", "elbow", {"zero axis"});
  expect_error([&] { builder.change_joint("elbow", [](JointSpec& j) { j.name = "knee"; }); },
               "joint", "elbow", {"cannot become \"knee\""});
  expect_error([&] { builder.change_link("upper", [](LinkSpec& l) { l.name = "arm"; }); }, "link",
               "upper", {"cannot become \"arm\""});
  EXPECT_EQ(builder.link_spec("upper").inertia.mass, 2);
  EXPECT_EQ(builder.joint_spec("elbow").axis, Vec3::UnitY());
  EXPECT_EQ(builder.build()->source, "text");  // nothing was changed
}

TEST(Changes, ForgetTheTextThatSaysSomethingElse) {
  ModelBuilder builder = arm();
  builder.set_source("text").change_joint("elbow", [](JointSpec& j) { j.upper = 1; });
  EXPECT_EQ(builder.build()->source, "");
}

TEST(ModelParts, KeepWhatTheirAuthorSaid) {
  ModelBuilder builder = arm();
  JointSpec screw = test::joint("screw", JointType::helical, "lower", "bolt", {1, 2, 3}, {0, 3, 4});
  screw.pitch = 0.25;
  screw.lower = -1;
  screw.upper = 2;
  builder.add_link({"bolt", test::some_body()}).add_joint(screw);
  JointSpec follower = test::joint("follower", JointType::revolute, "world", "slave");
  follower.mimic = Mimic{"elbow", 2, 0.5};
  builder.add_link({"slave", test::some_body()}).add_joint(follower);
  builder.add_link({"tag"}).add_joint(test::joint("glue", JointType::fixed, "lower", "tag"));
  const Pose X_LG{Mat3(Eigen::AngleAxisd(0.3, Vec3::UnitX()).toRotationMatrix()), {4, 5, 6}};
  builder.add_shape("tag", Sphere{0.1}, X_LG);
  const Model model = builder.build();
  const JointInfo& joint = model->joints[static_cast<std::size_t>(model.joint("screw"))];
  EXPECT_EQ(joint.index, model.joint("screw"));
  EXPECT_EQ(joint.X_PJ.p, Vec3(1, 2, 3));
  EXPECT_LT((joint.axis.value() - Vec3(0, 0.6, 0.8)).norm(), 1e-15);
  EXPECT_EQ(joint.pitch, 0.25);
  EXPECT_EQ(joint.lower, -1);
  EXPECT_EQ(joint.upper, 2);
  EXPECT_EQ(joint.mimics, "");
  EXPECT_FALSE(model->joints[static_cast<std::size_t>(model.joint("glue"))].axis);
  EXPECT_EQ(model->joints[static_cast<std::size_t>(model.joint("follower"))].mimics, "elbow");
  for (int i = 0; i < std::ssize(model->links); ++i) {
    const Link& link = model->links[static_cast<std::size_t>(i)];
    EXPECT_EQ(link.index, i);
    EXPECT_EQ(link.inertia.mass, link.mass);
  }
  EXPECT_EQ(model->shapes[0].X_LG.p, X_LG.p);
  EXPECT_EQ(model->shapes[0].X_LG.R, X_LG.R);
  expect_error([&] { model.joint("nail"); }, "joint", "nail", {"no joint \"nail\"; there are"});
}

}  // namespace
}  // namespace saltus
