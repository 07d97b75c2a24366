// How a model's trees are solved: what the builder is told, and what becomes of it.
#include <gtest/gtest.h>

#include <cmath>

#include "kit/builders.hpp"

namespace saltus {
namespace {

using test::joint;
using test::some_body;

/// Adds `links` revolute joints below each other, the first below the world.
void add_chain(ModelBuilder& builder, const std::string& name, int links) {
  std::string parent = "world";
  for (int i = 0; i < links; ++i) {
    const std::string k = name + std::to_string(i);
    builder.add_link({k, some_body()});
    builder.add_joint(joint("joint_" + k, JointType::revolute, parent, k, {0, 0, -0.5}));
    parent = k;
  }
}

ModelBuilder chains(const std::vector<int>& links) {
  ModelBuilder builder("chains");
  for (std::size_t i = 0; i < links.size(); ++i) {
    add_chain(builder, "abcdef"[i] + std::string("_"), links[i]);
  }
  return builder;
}

std::string solvers(const Model& model) {
  std::string text;
  for (const TreeSolution& s : model.solvers()) {
    text += s.solver == TreeSolver::lu ? "lu" : s.solver == TreeSolver::sweep ? "sweep" : "?";
    text += " " + std::to_string(s.trees) + " of " + std::to_string(s.joints) + " deep " +
            std::to_string(s.depth) + "; ";
  }
  return text;
}

TEST(Solvers, AutomaticGoesByTheShapeOfEachTree) {
  EXPECT_EQ(solvers(chains({2, 30, 2, 3}).build()),
            "lu 2 of 2 deep 2; sweep 1 of 30 deep 30; lu 1 of 3 deep 3; ");
  EXPECT_EQ(solvers(chains({90, 90}).build()), "sweep 1 of 90 deep 90; sweep 1 of 90 deep 90; ");
}

TEST(Solvers, TheBuilderOverridesThemForAllTrees) {
  ModelBuilder builder = chains({2, 30, 2});
  EXPECT_EQ(solvers(builder.set_solver(TreeSolver::lu).build()),
            "lu 2 of 2 deep 2; lu 1 of 30 deep 30; ");
  EXPECT_EQ(solvers(builder.set_solver(TreeSolver::sweep).build()),
            "sweep 1 of 2 deep 2; sweep 1 of 30 deep 30; sweep 1 of 2 deep 2; ");
  EXPECT_EQ(solvers(chains({30, 30}).set_solver(TreeSolver::lu).build()), "lu 2 of 30 deep 30; ");
}

TEST(Solvers, JointsAreOfOneCoordinateAndDepthIsThatOfTheLongestBranch) {
  ModelBuilder builder;
  for (const std::string name : {"body", "left", "right"}) builder.add_link({name, some_body()});
  builder.add_joint(joint("free", JointType::floating, "world", "body"));
  builder.add_joint(joint("shoulder_left", JointType::revolute, "body", "left"));
  builder.add_joint(joint("shoulder_right", JointType::revolute, "body", "right"));
  EXPECT_EQ(solvers(builder.build()), "lu 1 of 8 deep 7; ");
}

TEST(Solvers, AModelWithoutJointsHasNone) { EXPECT_EQ(solvers(ModelBuilder().build()), ""); }

TEST(Solvers, VelocitiesDifferByRoundingOnly) {
  ModelBuilder builder = chains({12, 2, 2});
  const Model model = builder.build();
  VecX q(model.n_q()), v(model.n_q());
  for (int i = 0; i < model.n_q(); ++i) {
    q[i] = std::sin(i + 1.0);
    v[i] = std::cos(3.0 * i);
  }
  for (const TreeSolver solver : {TreeSolver::automatic, TreeSolver::lu, TreeSolver::sweep}) {
    const Model other = builder.set_solver(solver).build();
    EXPECT_LT((other.velocity(model.state(q, v)) - v).norm(), 1e-10 * v.norm());
  }
}

}  // namespace
}  // namespace saltus
