// Bodies that lie flat: always the same contacts, no drift, no energy out of nothing.
#include <gtest/gtest.h>

#include <set>

#include "kit/scenes.hpp"

namespace saltus {
namespace {

using scenes::touching;
using Names = std::set<std::string>;

constexpr double quarter = 0.5 * 3.14159265358979323846;

struct Body {
  std::string name;
  Shape shape;
  Vec3 half;  ///< [m] of the box that its inertia is taken from
  Vec3 at;
  Mat3 R = Mat3::Identity();
};

/// Free bodies of 1 kg over the floor z = 0.
Model scene(const std::vector<Body>& bodies, const Vec3& floor = Vec3::UnitZ()) {
  ModelBuilder b("scene");
  for (const Body& body : bodies) {
    b.add_link({body.name, solid_box(1, body.half)});
    b.add_joint({.name = body.name,
                 .type = JointType::floating,
                 .parent = "world",
                 .child = body.name,
                 .X_PJ = {body.R, body.at}});
    b.add_shape(body.name, body.shape);
  }
  return b.add_half_space("floor", floor).build();
}

Body box(const std::string& name, const Vec3& half, const Vec3& at, double yaw = 0) {
  return {name, Box{half}, half, at, rotation_from_rpy(0, 0, yaw)};
}

/// Rests for 2 s: the gaps that are within 1e-9 m of touching, the same at every step.
struct Rest {
  Names touching;
  double drift = 0;    ///< [m | rad] the most that a coordinate changed, but those in `free`
  double lowest = 0;   ///< [m] least gap of all
  int sustained = -1;  ///< held contacts in each step, -1 if not always as many
  int impacts = 0;
};

Rest rest(const Model& model, const State& start = {}) {
  State state = start.q.size() == 0 ? model.state() : start;
  const VecX q = state.q;
  Stepper stepper(model, {.h = 0.01});
  Rest out;
  out.touching = touching(model, state.q);
  for (int k = 0; k < 200; ++k) {
    stepper.step(state);
    const StepReport& report = stepper.report();
    out.impacts += static_cast<int>(report.impacts.size());
    if (k == 0) out.sustained = report.sustained;
    if (report.sustained != out.sustained) out.sustained = -1;
    if (k % 20 == 0) {
      EXPECT_EQ(touching(model, state.q), out.touching) << "t = " << state.t;
      out.lowest = std::min(out.lowest, model.gaps(state.q).phi.minCoeff());
    }
  }
  out.drift = (state.q - q).cwiseAbs().maxCoeff();
  return out;
}

// Rounding is 1e-17 a step; contacts are exact to 1e-13 (a thousandth of epsilon_phi).
constexpr double still = 1e-12;

TEST(Resting, ABoxIsFourContactsAlwaysTheSameFour) {
  const Rest r = rest(scene({box("block", {0.2, 0.15, 0.1}, {0, 0, 0.1}, 0.3)}));
  EXPECT_EQ(r.touching, (Names{"block[++-] ~ floor", "block[+--] ~ floor", "block[-+-] ~ floor",
                               "block[---] ~ floor"}));
  EXPECT_EQ(r.sustained, 4);
  EXPECT_EQ(r.impacts, 0);
  EXPECT_LE(r.drift, still);
}

/// What one body does is no affair of another that lies beside it, whose redundant corners share
/// its weight in arcs of any length.
TEST(Resting, ABoxLiesWhileAnotherTumbles) {
  for (int i = 0; i < 8; ++i) {
    ModelBuilder b("two");
    b.add_floor().set_default_contact({0.5, 0});
    b.add_body({.name = "thrown",
                .shape = Box{{0.1, 0.2, 0.3}},
                .mass = 1,
                .X = {Mat3::Identity(), {0, 0, 1}}});
    b.add_body({.name = "lies",
                .shape = Box{Vec3::Constant(0.5)},
                .mass = 1,
                .X = {Mat3::Identity(), {3, 0, 0.5}}});
    const Model model = b.build();
    State state = model.state(
        {},
        {{"thrown_vx", 1}, {"thrown_wx", 5 - i}, {"thrown_wy", 1 + i % 3}, {"thrown_wz", i - 4}});
    Stepper stepper(model, {.h = 0.005});
    for (int k = 0; k < 400; ++k) stepper.step(state);
    EXPECT_NEAR(state.q[9], 0, 1e-10);
    EXPECT_LE(model.velocity(state).tail<6>().cwiseAbs().maxCoeff(), 1e-10);
  }
}

TEST(Resting, ABoxSlidesAndTurnsOnItsFourCorners) {
  const Model model = scene({box("block", {0.2, 0.15, 0.1}, {0, 0, 0.1})});
  const State start = model.state({}, {{"block_vx", 1}, {"block_wz", 2}});
  Stepper stepper(model, {.h = 0.01});
  State state = start;
  for (int k = 0; k < 200; ++k) stepper.step(state);
  EXPECT_NEAR(state.q[model.coordinate("block_x")], 2, 1e-12);  // 1 m/s for 2 s, no friction
  EXPECT_NEAR(scenes::moved(model, state.q, "block_wz"), scenes::within_a_turn(4), 1e-12);
  EXPECT_LE(std::abs(state.q[model.coordinate("block_z")]), still);
  EXPECT_NEAR(model.kinetic_energy(state), model.kinetic_energy(start), 1e-12);
}

TEST(Resting, ABoxSlidesDownASlope) {
  const double slope = std::atan(0.1);
  Body block = box("block", {0.2, 0.15, 0.1}, 0.1 * Vec3(0.1, 0, 1).normalized());
  block.R = rotation_from_rpy(0, slope, 0);
  const Model model = scene({block}, {0.1, 0, 1});
  Stepper stepper(model, {.h = 0.01});
  State state = model.state();
  for (int k = 0; k < 50; ++k) stepper.step(state);
  // g sin(slope) t^2 / 2; the midpoint rule is exact for it
  EXPECT_NEAR(state.q[model.coordinate("block_x")], 9.81 * std::sin(slope) / 8, 1e-12);
  EXPECT_EQ(stepper.report().sustained, 4);
}

TEST(Resting, ARodLiesOnItsTwoEnds) {
  const Vec3 half(0.05, 0.05, 0.2);
  const Mat3 lying = rotation_from_rpy(quarter, 0, 0);
  const Rest r = rest(scene({{"rod", Capsule{0.05, 0.2}, half, {0, 0, 0.05}, lying}}));
  EXPECT_EQ(r.touching, (Names{"rod[+] ~ floor", "rod[-] ~ floor"}));
  EXPECT_EQ(r.sustained, 2);
  EXPECT_LE(r.drift, still);
}

/// Its second end touches down in an arc that already holds the first, which settled in it.
TEST(Resting, ARodThatSettlesOnItsTwoEndsSinksNowhere) {
  ModelBuilder b("rod");
  b.add_floor().set_default_contact({0.5, 0});
  b.add_body({.name = "rod", .shape = Capsule{0.1, 0.2}, .mass = 1});
  const Model model = b.build();
  VecX q(7);
  q << 0, 0, 0.100035, -0.129662, -0.695173, 0.267347, 0.654559;
  VecX v(6);
  v << 0, 0, 0.002389, 5.415141, 1.046169, 3.610756;
  State state = model.state(model.normalized(q), v);
  Stepper stepper(model, {.h = 0.005});
  for (int k = 0; k < 20; ++k) {
    stepper.step(state);
    EXPECT_GE(model.gaps(state.q).phi.minCoeff(), -1e-10) << k;
  }
}

/// A nearly flat spinning can, held on a rim, has arcs that are another motion (75 times its energy
/// at h = 5 ms): such a step is an error, and the state is what it was.
TEST(Resting, ARimNeverGainsEnergyWithoutAWord) {
  ModelBuilder b("can");
  b.add_floor().set_default_contact({0, 0});
  b.add_body({.name = "can", .shape = Cylinder{0.1, 0.1}, .mass = 1});
  const Model model = b.build();
  VecX q(7), v(6);
  q << 0, 0, .105539, -.956946, .289455, -.018799, .010798;
  v << 0, 0, -1.635133, 5.282512, 20.060432, -.55442;
  const State start = model.state(model.normalized(q), v);
  const double most = 1.001 * (model.kinetic_energy(start) + model.potential_energy(start.q));
  for (const double h : {0.01, 0.005, 0.0025, 0.001}) {
    State state = start;
    Stepper stepper(model, {.h = h});
    for (int k = 0; k < 20; ++k) {
      const State before = state;
      try {
        stepper.step(state);
      } catch (const StepError& error) {
        EXPECT_NE(std::string(error.what()).find("J, and contacts do no work"), std::string::npos);
        EXPECT_EQ(state, before);
        break;
      }
      EXPECT_LE(model.kinetic_energy(state) + model.potential_energy(state.q), most)
          << h << " " << k;
    }
  }
}

TEST(Resting, ACanStandsOnFourPointsAndLiesOnItsTwoRims) {
  const Vec3 half(0.05, 0.05, 0.1);
  const Cylinder can{0.05, 0.1};
  const Rest stands = rest(scene({{"can", can, half, {0, 0, 0.1}, Mat3::Identity()}}));
  EXPECT_EQ(stands.touching, (Names{"can[-0] ~ floor", "can[-90] ~ floor", "can[-180] ~ floor",
                                    "can[-270] ~ floor"}));
  EXPECT_LE(stands.drift, still);
  const Mat3 lying = rotation_from_rpy(quarter, 0, 0) * rotation_from_rpy(0, 0, 0.3);
  const Rest lies = rest(scene({{"can", can, half, {0, 0, 0.05}, lying}}));
  EXPECT_EQ(lies.touching, (Names{"can[rim+] ~ floor", "can[rim-] ~ floor"}));
  EXPECT_LE(lies.drift, still);
}

TEST(Resting, AStackOfEqualCubesEdgeOnEdge) {
  std::vector<Body> cubes;
  for (int i = 0; i < 4; ++i) {
    cubes.push_back(box("cube_" + std::to_string(i), Vec3::Constant(0.1), {0, 0, 0.1 + 0.2 * i}));
  }
  const Rest r = rest(scene(cubes));
  EXPECT_EQ(r.sustained, 4 + 3 * 8);  // four corners of each on the other
  EXPECT_EQ(r.impacts, 0);
  EXPECT_LE(r.drift, still);
}

TEST(Resting, AStackAskew) {
  std::vector<Body> cubes;
  for (int i = 0; i < 3; ++i) {
    cubes.push_back(box("cube_" + std::to_string(i), Vec3::Constant(0.1),
                        {0.02 * i, 0.01 * i, 0.1 + 0.2 * i}, 0.3 * i));
  }
  const Rest r = rest(scene(cubes));
  EXPECT_EQ(r.impacts, 0);
  EXPECT_LE(r.drift, still);
}

// No corner of either is over the other: the edges alone bear the load.
TEST(Resting, APlankAcrossAPlank) {
  const Rest r = rest(scene({box("low", {0.5, 0.05, 0.02}, {0, 0, 0.02}),
                             box("high", {0.05, 0.5, 0.02}, {0.1, 0, 0.06})}));
  Names edges;
  for (const std::string& name : r.touching) {
    if (name.find("floor") == std::string::npos) edges.insert(name);
  }
  EXPECT_EQ(edges, (Names{"low[x++] ~ high[+y-]", "low[x++] ~ high[-y-]", "low[x-+] ~ high[+y-]",
                          "low[x-+] ~ high[-y-]"}));
  EXPECT_EQ(r.sustained, 8);
  EXPECT_LE(r.drift, still);
}

}  // namespace
}  // namespace saltus
