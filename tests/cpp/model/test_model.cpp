// What a model answers: states by name, velocities, energies, poses, gaps; and what it refuses.
#include "saltus/model/model.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <type_traits>

#include "kit/ask.hpp"
#include "kit/builders.hpp"
#include "numeric.hpp"

namespace saltus {
namespace {

using test::arm;
using test::joint;
using test::message_of;
using test::relative_error;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

TEST(Model, IsConstAndItsCopiesShare) {
  const Model model = arm().build();
  const Model copy = model;
  EXPECT_EQ(&*copy, &*model);
  EXPECT_EQ(sizeof(Model), sizeof(std::shared_ptr<int>));
  static_assert(std::is_const_v<std::remove_reference_t<decltype(*model)>>);
  static_assert(
      std::is_const_v<std::remove_pointer_t<decltype(std::declval<Model&>().operator->())>>);
}

TEST(Model, OutlivesItsBuilder) {
  const Model model = [] { return arm().set_source("text").set_gravity({1, 2, 3}).build(); }();
  EXPECT_EQ(model->name, "arm");
  EXPECT_EQ(model->source, "text");
  EXPECT_EQ(model->mass.gravity, Vec3(1, 2, 3));
}

TEST(Model, ABuilderCanGoOn) {
  ModelBuilder builder = arm();
  const Model two = builder.build();
  builder.add_link({"hand", test::some_body()});
  builder.add_joint(joint("wrist", JointType::revolute, "lower", "hand"));
  builder.check();
  const Model three = builder.build();
  EXPECT_EQ(two.n_q(), 2);
  EXPECT_EQ(three.n_q(), 3);
}

TEST(Model, IsBuiltAgainOfItsDescription) {
  const Model model = test::two_balls()
                          .set_gravity({1, 2, 3})
                          .set_solver(TreeSolver::lu)
                          .set_default_contact({0.5, 0.25})
                          .add_warning("a warning")
                          .build();
  const Model again = ModelBuilder(*model->description).build();
  std::mt19937_64 random(1);
  const VecX q = model.random_configuration(random);
  const VecX v = VecX::LinSpaced(model.n_v(), -1, 1);
  EXPECT_EQ(again.state(q, v), model.state(q, v));
  EXPECT_EQ(again.gaps(q).phi, model.gaps(q).phi);
  EXPECT_EQ(again.pair_name(0), model.pair_name(0));
  EXPECT_EQ(again.contact_properties(0), model.contact_properties(0));
  EXPECT_EQ(again->warnings, model->warnings);
  EXPECT_EQ(model.without_collisions()->description, model->description);
}

TEST(State, FromNamesAndFromArrays) {
  const Model model = arm().build();
  const State a = model.state({{"elbow", 0.3}}, {{"shoulder", 2.0}}, 1.5);
  EXPECT_EQ(a.t, 1.5);
  EXPECT_EQ(a.q, VecX(Eigen::Vector2d(0, 0.3)));
  EXPECT_LT((a.p - 2 * model.mass_matrix(a.q).col(0)).norm(), 1e-14);
  EXPECT_EQ(a, model.state(Eigen::Vector2d(0, 0.3), Eigen::Vector2d(2, 0), 1.5));
  const State rest = model.state();
  EXPECT_EQ(rest.q, VecX(VecX::Zero(2)));
  EXPECT_EQ(rest.p, VecX(VecX::Zero(2)));
  EXPECT_EQ(rest.t, 0);
  EXPECT_FALSE(a == rest);
  State later = a;
  later.t = 2;
  EXPECT_FALSE(later == a);
}

TEST(State, MistakesAreNamed) {
  const Model model = arm().build();
  EXPECT_EQ(message_of([&] { model.state({{"elbw", 0.3}}); }),
            "no coordinate \"elbw\"; there are shoulder, elbow");
  EXPECT_EQ(message_of([&] { model.state({}, {{"wrist", 0.3}}); }),
            "no velocity \"wrist\"; there are shoulder, elbow");
  EXPECT_EQ(message_of([&] { model.state({{"elbow", nan}}); }),
            "coordinate \"elbow\" = nan is not finite");
  EXPECT_EQ(message_of([&] { model.state({}, {{"shoulder", inf}}); }),
            "velocity \"shoulder\" = inf is not finite");
  EXPECT_EQ(message_of([&] { model.state({}, {}, nan); }), "t is not finite");
  EXPECT_EQ(message_of([&] { model.state(Eigen::Vector2d(0, nan), VecX::Zero(2)); }),
            "q[1] = nan is not finite");
  EXPECT_EQ(message_of([&] { model.state(VecX::Zero(3), VecX::Zero(2)); }),
            "q has 3 entries; the model has 2 coordinates");
  EXPECT_EQ(message_of([&] { model.state(VecX::Zero(2), VecX::Zero(1)); }),
            "v has 1 entry; the model has 2 velocities");
}

// Every door checks its arrays, so that no index is ever out of range behind it.
TEST(Model, ChecksEveryArray) {
  const Model model = arm().build();
  const VecX good = VecX::Zero(2), shorter = VecX::Zero(1), bad = Eigen::Vector2d(0, -inf);
  for (const VecX& x : {shorter, bad}) {
    const std::string problem =
        x.size() == 1 ? " has 1 entry; the model has 2 coordinates" : "[1] = -inf is not finite";
    EXPECT_EQ(message_of([&] { model.lagrangian(x, good); }), "q" + problem);
    const std::string rates =
        x.size() == 1 ? " has 1 entry; the model has 2 velocities" : "[1] = -inf is not finite";
    EXPECT_EQ(message_of([&] { model.lagrangian(good, x); }), "v" + rates);
    EXPECT_EQ(message_of([&] { model.mass_matrix(x); }), "q" + problem);
    EXPECT_EQ(message_of([&] { model.gaps(x); }), "q" + problem);
    EXPECT_EQ(message_of([&] { model.potential_energy(x); }), "q" + problem);
    EXPECT_EQ(message_of([&] { model.X_WL(x, 0); }), "q" + problem);
    EXPECT_EQ(message_of([&] { model.velocity({0, x, good}); }), "state.q" + problem);
    EXPECT_EQ(message_of([&] { model.velocity({0, good, x}); }), "state.p" + rates);
    EXPECT_EQ(message_of([&] { model.kinetic_energy({0, x, good}); }), "state.q" + problem);
  }
  EXPECT_NO_THROW(check_vector(good, 2, "q"));
  EXPECT_NO_THROW(check_vector(VecX(), 0, "q"));
}

TEST(Model, FindsByName) {
  const Model model = arm().build();
  EXPECT_EQ(model.coordinate("elbow"), 1);
  EXPECT_EQ(model.link("world"), 0);
  EXPECT_EQ(model.link("lower"), 2);
  EXPECT_EQ(message_of([&] { model.link("lowr"); }),
            "no link \"lowr\"; there are world, upper, lower");
  try {
    model.coordinate("x");
  } catch (const ModelError& error) {
    EXPECT_EQ(error.element, "coordinate");
    EXPECT_EQ(error.name, "x");
  }
  EXPECT_EQ(message_of([] { ModelBuilder("empty").build().coordinate("x"); }),
            "no coordinate \"x\"; there are none");
}

TEST(Names, ListsStayShort) {
  EXPECT_EQ(list_names({}), "none");
  EXPECT_EQ(list_names({"a"}), "a");
  EXPECT_EQ(list_names({"a", "b", "c"}), "a, b, c");
  std::vector<std::string> names(20, "n");
  const std::string twenty = list_names(names);
  EXPECT_EQ(twenty.find("all"), std::string::npos);
  names.push_back("last");
  EXPECT_EQ(list_names(names), twenty + ", ... (21 in all)");
}

TEST(Model, VelocityInvertsMomentum) {
  for (const bool mimic : {false, true}) {
    ModelBuilder builder = arm();
    if (mimic) {
      builder.add_link({"hand", test::some_body()});
      JointSpec wrist = joint("wrist", JointType::revolute, "lower", "hand", {0, 0, -1});
      wrist.mimic = Mimic{"elbow", -2, 0.3};
      builder.add_joint(wrist);
    }
    const Model model = builder.build();
    const VecX q = Eigen::Vector2d(0.3, -1.2), v = Eigen::Vector2d(0.8, -2.5);
    const State state = model.state(q, v);
    EXPECT_LT(relative_error(model.velocity(state), v), 1e-13);  // condition of M
    const double T = 0.5 * v.dot(model.mass_matrix(q) * v);
    EXPECT_NEAR(model.kinetic_energy(state), T, 1e-13 * T);
    const LagrangianPartials L = model.lagrangian(q, v);
    EXPECT_NEAR(L.value, T - model.potential_energy(q), 1e-13 * T);
    // dV/dq = -L_q at rest
    const VecX V_q = test::gradient([&](const VecX& x) { return model.potential_energy(x); }, q);
    EXPECT_LT(relative_error(VecX(-model.lagrangian(q, VecX::Zero(2)).L_q), V_q), 1e-11);
  }
}

TEST(Model, PotentialEnergyByHand) {
  ModelBuilder builder("ball");
  builder.add_link({"ball", solid_sphere(2, 0.1)});
  builder.add_joint(joint("lift", JointType::prismatic, "world", "ball", {0, 0, 1}, Vec3::UnitZ()));
  const Model model = builder.build();
  EXPECT_NEAR(model.potential_energy(VecX::Constant(1, 0.5)), 2 * 9.81 * 1.5, 1e-14 * 30);
  EXPECT_EQ(model.mass_matrix(VecX::Zero(1))(0, 0), 2);
  EXPECT_EQ(solid_sphere(2, 0.1).I_J, Mat3(0.4 * 2 * 0.1 * 0.1 * Mat3::Identity()));
}

// Gaps are dense and named; their partials against numeric twins, through a mimic joint as well.
TEST(Model, GapsHaveTheirDerivatives) {
  ModelBuilder builder = arm().add_link({"hand", test::some_body()});
  JointSpec wrist = joint("wrist", JointType::revolute, "lower", "hand", {0.1, 0, -0.5});
  wrist.mimic = Mimic{"elbow", 0.7, 0.2};
  builder.add_joint(wrist).add_half_space("floor", Vec3(0.1, 0, 1), -2);
  builder.add_shape("hand", Sphere{0.05}, {Mat3::Identity(), {0.1, 0.02, -0.3}});
  builder.add_shape("upper", Sphere{0.05}, {Mat3::Identity(), {0.1, 0.02, 0.2}});
  const Model model = builder.build();
  const VecX q = Eigen::Vector2d(0.3, -1.2);
  const Gaps gaps = model.gaps(q);
  ASSERT_EQ(gaps.names.size(), 3u);
  const MatX phi_q = test::jacobian([&](const VecX& x) { return model.gaps(x).phi; }, q);
  EXPECT_LT(relative_error(gaps.phi_q, phi_q), 1e-11);  // see derivative()
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    EXPECT_EQ(gaps.names[i], model.pair_name(static_cast<int>(i)));
    const auto gradient = [&](const VecX& x) { return VecX(model.gaps(x).phi_q.row(row)); };
    EXPECT_LT(relative_error(gaps.phi_qq[i], test::jacobian(gradient, q), 1), 1e-11);
    const Vec3 between = gaps.p_WA.row(row) - gaps.p_WB.row(row);
    EXPECT_LT((between - gaps.phi[row] * Vec3(gaps.normal.row(row))).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace saltus
