// Every mistake in a description is found, and the message names the culprit and the alternatives.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <ostream>

#include "kit/ask.hpp"
#include "kit/builders.hpp"

namespace saltus {
namespace {

using test::arm;
using test::joint;
using test::some_body;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

struct Mistake {
  std::string label;
  std::string element, name;          ///< of the error
  std::vector<std::string> mentions;  ///< all of them in the message
  std::function<void()> make;
};
void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.label; }

class MistakeTest : public testing::TestWithParam<Mistake> {};

TEST_P(MistakeTest, IsNamed) {
  const Mistake& mistake = GetParam();
  test::expect_error(mistake.make, mistake.element, mistake.name, mistake.mentions);
}

std::string label_of(const testing::TestParamInfo<Mistake>& info) { return info.param.label; }

/// A joint that is right but for what `spoil` does, added to the arm.
Mistake bad_joint(const std::string& label, const std::vector<std::string>& mentions,
                  const std::function<void(JointSpec&)>& spoil) {
  return {label, "joint", "wrist", mentions, [spoil] {
            JointSpec spec = joint("wrist", JointType::revolute, "lower", "hand");
            spoil(spec);
            arm().add_link({"hand", some_body()}).add_joint(spec);
          }};
}

std::vector<Mistake> joint_mistakes() {
  return {
      bad_joint("ZeroAxis", {"\"wrist\"", "zero axis"},
                [](JointSpec& j) { j.axis = Vec3::Zero(); }),
      bad_joint("NaNAxis", {"\"wrist\"", "axis", "not finite"},
                [](JointSpec& j) { j.axis[1] = nan; }),
      bad_joint("NaNPlacement", {"\"wrist\"", "placement", "not finite"},
                [](JointSpec& j) { j.X_PJ.p[0] = nan; }),
      bad_joint("NoRotation", {"\"wrist\"", "no rotation"},
                [](JointSpec& j) { j.X_PJ.R(0, 0) = 1.1; }),
      bad_joint("Reflection", {"\"wrist\"", "no rotation"},
                [](JointSpec& j) { j.X_PJ.R = -Mat3::Identity(); }),
      bad_joint("NaNPitch", {"\"wrist\"", "pitch"},
                [](JointSpec& j) { j.type = JointType::helical, j.pitch = nan; }),
      bad_joint("PitchOfNoScrew", {"\"wrist\"", "pitch", "not helical"},
                [](JointSpec& j) { j.pitch = 0.1; }),
      bad_joint("LimitsCrossed", {"\"wrist\"", "lower limit 2", "upper limit -1"},
                [](JointSpec& j) { j.lower = 2, j.upper = -1; }),
      bad_joint("NaNLimit", {"\"wrist\"", "limit"}, [](JointSpec& j) { j.upper = nan; }),
      bad_joint("NaNDamping", {"\"wrist\"", "damping"}, [](JointSpec& j) { j.damping = nan; }),
      bad_joint("NaNEffort", {"\"wrist\"", "limit"}, [](JointSpec& j) { j.effort = nan; }),
      bad_joint("InfiniteMimic", {"\"wrist\"", "mimic"},
                [](JointSpec& j) { j.mimic = Mimic{"elbow", inf, 0}; }),
      bad_joint("InfiniteMimicOffset", {"\"wrist\"", "mimic"},
                [](JointSpec& j) { j.mimic = Mimic{"elbow", 1, inf}; }),
      {"TwoJointsOfOneName",
       "joint",
       "elbow",
       {"two joints", "\"elbow\""},
       [] { arm().add_joint(joint("elbow", JointType::fixed, "lower", "hand")); }},
      {"JointWithoutName",
       "joint",
       "",
       {"joint", "no name"},
       [] { arm().add_joint(joint("", JointType::fixed, "lower", "hand")); }},
  };
}

/// A moving link with an inertia that no body has.
Mistake bad_link(const std::string& label, const std::vector<std::string>& mentions,
                 const BodyInertia& inertia) {
  return {label, "link", "hand", mentions, [inertia] {
            const JointSpec wrist = joint("wrist", JointType::revolute, "lower", "hand");
            arm().add_link({"hand", inertia}).add_joint(wrist).build();
          }};
}

std::vector<Mistake> link_mistakes() {
  Mat3 skew = Mat3::Identity(), with_nan = Mat3::Identity();
  skew(0, 1) = 1e-6;
  with_nan(2, 2) = nan;
  const Vec3 o = Vec3::Zero();
  return {
      bad_link("NegativeMass", {"\"hand\"", "mass -1", "not negative"}, {-1, o, Mat3::Zero()}),
      bad_link("NaNMass", {"\"hand\"", "mass"}, {nan, o, Mat3::Zero()}),
      bad_link("InfiniteMass", {"\"hand\"", "mass inf"}, {inf, o, Mat3::Zero()}),
      bad_link("NaNCentre", {"\"hand\"", "centre of mass"}, {1, {0, nan, 0}, Mat3::Identity()}),
      bad_link("NaNInertia", {"\"hand\"", "inertia", "not finite"}, {1, o, with_nan}),
      bad_link("AsymmetricInertia", {"\"hand\"", "not symmetric"}, {1, o, skew}),
      bad_link("NegativeMoment", {"\"hand\"", "principal moments", "-0.1"},
               {1, o, Vec3(1, 1, -0.1).asDiagonal()}),
      bad_link("TriangleBroken", {"\"hand\"", "principal moments", "sum of the other two"},
               {1, o, Vec3(1, 1, 2.1).asDiagonal()}),
      bad_link("InertiaWithoutMass", {"\"hand\"", "no mass"}, {0, o, Mat3::Identity()}),
      {"TwoLinksOfOneName",
       "link",
       "lower",
       {"two links", "\"lower\""},
       [] { arm().add_link({"lower", {}}); }},
      {"LinkNamedLikeTheRoot", "link", "world", {"\"world\""}, [] { arm().add_link({"world"}); }},
      {"LinkWithoutName", "link", "", {"link", "no name"}, [] { arm().add_link({""}); }},
      {"NaNGravity", "", "", {"gravity", "nan"}, [] { arm().set_gravity({0, 0, nan}); }},
  };
}

Mistake bad_shape(const std::string& label, const std::vector<std::string>& mentions,
                  const Shape& shape) {
  return {label, "link", "lower", mentions, [shape] { arm().add_shape("lower", shape); }};
}

/// A tetrahedron that is right but for what `spoil` does.
Mistake bad_hull(const std::string& label, const std::vector<std::string>& mentions,
                 const std::function<void(Hull&)>& spoil) {
  return {label, "link", "lower", mentions, [spoil] {
            Hull hull = convex_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
            spoil(hull);
            arm().add_shape("lower", Convex{std::make_shared<const Hull>(hull)});
          }};
}

std::vector<Mistake> shape_mistakes() {
  const Pose no_pose{2 * Mat3::Identity(), Vec3::Zero()};
  return {
      bad_shape("SphereOfNoRadius", {"\"lower\"", "sphere", "positive"}, Sphere{0}),
      bad_shape("SphereOfNaN", {"sphere"}, Sphere{nan}),
      bad_shape("SphereInfinite", {"sphere"}, Sphere{inf}),
      bad_shape("CapsuleNegative", {"capsule"}, Capsule{0.1, -1}),
      bad_shape("CapsuleOfNoRadius", {"capsule"}, Capsule{0, 1}),
      bad_shape("BoxFlat", {"box", "(1 0 1)"}, Box{{1, 0, 1}}),
      bad_shape("BoxFlatInZ", {"box"}, Box{{1, 1, 0}}),
      bad_shape("CylinderFlat", {"cylinder"}, Cylinder{0.1, 0}),
      bad_shape("EllipsoidFlat", {"\"lower\" has an ellipsoid of size (1 0 1)"},
                Ellipsoid{{1, 0, 1}}),
      bad_shape("EllipsoidOfNaN", {"ellipsoid"}, Ellipsoid{{1, 1, nan}}),
      bad_shape("ConvexOfNothing", {"\"lower\" has a convex without a hull", "convex_hull"},
                Convex{}),
      bad_hull("HullWithoutFaces", {"bad hull: 4 vertices, 6 edges and 0 faces make no polytope"},
               [](Hull& hull) { hull.faces.clear(); }),
      bad_hull("HullOfNaN", {"a vertex is not finite: (nan 0 0)"},
               [](Hull& hull) { hull.vertices[0] = Vec3(nan, 0, 0); }),
      bad_hull("HullWithALongNormal", {"a face has normal", "no unit vector"},
               [](Hull& hull) { hull.faces[1].normal *= 2; }),
      bad_hull("HullWithACornerTooMany", {"the corners of a face", "4 vertices"},
               [](Hull& hull) { hull.faces[1].corners.push_back(4); }),
      bad_hull("HullInsideOut", {"its center", "not below a face"},
               [](Hull& hull) { hull.faces[2].offset = -9; }),
      bad_hull("HullWithAnEdgeTooFar", {"an edge names"},
               [](Hull& hull) { hull.edges[3].right = 4; }),
      bad_hull("HullWithoutNeighbours", {"lists of neighbours"},
               [](Hull& hull) { hull.neighbour.pop_back(); }),
      bad_shape("HalfSpaceMoving", {"\"lower\"", "half-space", "\"world\""}, HalfSpace{}),
      {"ShapePlacement",
       "link",
       "lower",
       {"\"lower\"", "no rotation"},
       [no_pose] { arm().add_shape("lower", Sphere{1}, no_pose); }},
      {"HalfSpaceZeroNormal",
       "half_space",
       "floor",
       {"\"floor\"", "normal (0 0 0)"},
       [] { arm().add_half_space("floor", Vec3::Zero()); }},
      {"HalfSpaceNaNOffset",
       "half_space",
       "floor",
       {"\"floor\"", "offset nan"},
       [] { arm().add_half_space("floor", Vec3::UnitZ(), nan); }},
      {"TwoHalfSpacesOfOneName",
       "half_space",
       "floor",
       {"two half-spaces", "\"floor\""},
       [] { arm().add_half_space("floor", Vec3::UnitZ()).add_half_space("floor", Vec3::UnitX()); }},
  };
}

INSTANTIATE_TEST_SUITE_P(Joints, MistakeTest, testing::ValuesIn(joint_mistakes()), label_of);
INSTANTIATE_TEST_SUITE_P(Links, MistakeTest, testing::ValuesIn(link_mistakes()), label_of);
INSTANTIATE_TEST_SUITE_P(Shapes, MistakeTest, testing::ValuesIn(shape_mistakes()), label_of);

// What is on the boundary of the rules and lies within them.
TEST(CheckInertia, AcceptsPointsRodsPlatesAndSixDigits) {
  for (const Vec3& moments :
       {Vec3(0, 0, 0), Vec3(1, 1, 0), Vec3(1, 1, 2), Vec3(2, 1, 1),
        Vec3(0.333333, 0.333333, 0.666667), Vec3(1, 1, -1e-6), Vec3(-1e-20, 0, 1e-20)}) {
    const BodyInertia hand{1, Vec3(1, 1, 1), moments.asDiagonal()};
    const JointSpec wrist = joint("wrist", JointType::revolute, "lower", "hand");
    const Model model = arm().add_link({"hand", hand}).add_joint(wrist).build();
    EXPECT_TRUE(model->warnings.empty());
  }
  EXPECT_NO_THROW(check_inertia({}, "link"));
  EXPECT_NO_THROW(check_inertia(some_body(), "link"));
}

// Robots' files have place holders of 1e-6 kg with any moments, fixed to what has a true mass.
TEST(CheckInertia, WarnsOfALinkThatIsImpossibleAloneOnly) {
  const BodyInertia holder{1e-6, Vec3::Zero(), Vec3(0, 0, 3e-6).asDiagonal()};
  for (const std::string carrier : {"lower", "world"}) {
    const JointSpec fixed = joint("holding", JointType::fixed, carrier, "holder");
    const Model model = arm().add_link({"holder", holder}).add_joint(fixed).build();
    ASSERT_EQ(model->warnings.size(), 1u);
    EXPECT_NE(model->warnings[0].find("\"holder\" has principal moments"), std::string::npos);
  }
}

// A rotation written with six digits is made orthonormal; one to rounding is left as it is.
TEST(Placements, AreMadeOrthonormal) {
  const Mat3 R = rotation_from_rpy(0.3, -0.4, 1.2);
  const Mat3 written = (R * 1e7).array().round() / 1e7;
  for (const Mat3& given : {R, written}) {
    JointSpec spec = joint("j", JointType::fixed, "lower", "hand");
    spec.X_PJ.R = given;
    const Model model = arm().add_link({"hand", some_body()}).add_joint(spec).build();
    const Mat3 used = model->links[static_cast<std::size_t>(model.link("hand"))].X_JL.R;
    EXPECT_LT((used.transpose() * used - Mat3::Identity()).norm(), 3e-15);
    EXPECT_LT((model.X_WL(VecX::Zero(2), model.link("hand")).R - R).norm(), 1e-6);
  }
}

}  // namespace
}  // namespace saltus
