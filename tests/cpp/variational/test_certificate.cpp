// What the angles between contacts tell of all impacts: unique, order dependent or jammed.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "kit/contact_problems.hpp"
#include "saltus/error.hpp"
#include "saltus/variational/certificate.hpp"

namespace saltus {
namespace {

using std::numbers::pi;

ImpactCertificate classify(const MatX& N, double e = 1) {
  return classify_impact(MatX::Identity(N.cols(), N.cols()), N, e);
}

TEST(Certificate, FiniteGroupsAreNamedWithTheirMirrors) {
  std::mt19937 random(1);
  for (const Diagram& diagram : finite_diagrams()) {
    std::vector<int> order(static_cast<std::size_t>(diagram.rank));
    std::iota(order.begin(), order.end(), 0);
    for (int trial = 0; trial < 5; ++trial) {
      std::shuffle(order.begin(), order.end(), random);
      const MatX N = normals(gram(diagram))(order, Eigen::all);
      const ImpactCertificate found = classify(N);
      EXPECT_EQ(found.kind, ImpactKind::unique) << diagram.type;
      EXPECT_EQ(found.type, diagram.type);
      EXPECT_EQ(found.impulses, diagram.impulses) << diagram.type;
      EXPECT_GT(found.interior, 0);
    }
  }
  EXPECT_EQ(classify(line(8)).type, "A7");
  EXPECT_EQ(classify(line(8)).impulses, 28);
}

TEST(Certificate, LargerDiagramsOfTheFamilies) {
  for (int n = 2; n < 13; ++n) {
    Diagram a{"A", n, {}, n * (n + 1) / 2}, b{"B", n, {}, n * n}, d{"D", n, {}, n * (n - 1)};
    for (int i = 0; i + 1 < n; ++i) a.edges.push_back({i, i + 1, 3});
    b.edges = d.edges = a.edges;
    b.edges.back()[2] = 4;
    if (n > 3) d.edges.back() = {n - 3, n - 1, 3};
    for (const Diagram& diagram : {a, b, d}) {
      if (diagram.type == "D" && n < 4) continue;
      const ImpactCertificate found = classify(normals(gram(diagram)));
      EXPECT_EQ(found.type, diagram.type + std::to_string(n));
      EXPECT_EQ(found.impulses, diagram.impulses);
    }
  }
}

TEST(Certificate, InfiniteDiagramsAreNotCertified) {
  // affine ones: a triangle of pi/3 (three walls of a prism), and the path 4 4
  MatX triangle(3, 2);
  triangle << 1, 0, -.5, std::sqrt(.75), -.5, -std::sqrt(.75);
  EXPECT_EQ(classify(triangle).kind, ImpactKind::jammed);
  MatX square(3, 2);
  square << 1, 0, -std::sqrt(.5), std::sqrt(.5), 0, -1;
  EXPECT_EQ(classify(square).kind, ImpactKind::jammed);
  EXPECT_EQ(classify(square).interior, 0);
  EXPECT_FALSE(classify(square).impulses);
}

TEST(Certificate, TwoContactsAreUniqueAtEveryPartOfAHalfTurn) {
  for (const int m : {2, 3, 4, 5, 6, 7, 12, 13, 31, 100}) {
    const ImpactCertificate found = classify(wedge(pi / m));
    EXPECT_EQ(found.kind, ImpactKind::unique) << m;
    EXPECT_EQ(found.impulses, m);
    const ImpactCertificate off = classify(wedge(pi / m * (1 + 1e-6)));
    EXPECT_EQ(off.kind, ImpactKind::order_dependent) << m;
    EXPECT_EQ(off.impulses, m);
    EXPECT_EQ(off.type, "");
  }
  EXPECT_EQ(classify(wedge(pi / 2)).type, "A1^2");
  EXPECT_EQ(classify(wedge(pi / 3)).type, "A2");
  EXPECT_EQ(classify(wedge(pi / 4)).type, "B2");
  EXPECT_EQ(classify(wedge(pi / 7)).type, "I2(7)");
  EXPECT_EQ(classify(wedge(2.)).impulses, 2);  // an obtuse wedge
  EXPECT_NEAR(classify(wedge(.3)).angles(0, 1), .3, 1e-15);
  EXPECT_NEAR(classify(wedge(.3)).interior, std::sin(.15), 1e-14);
  EXPECT_EQ(classify(bernoulli()).impulses, 2);  // cos theta = -1/4: 104.5 degrees
}

TEST(Certificate, MassesMakeTheAngle) {
  for (const int m : {4, 5, 6}) {
    const MatX M = vec({1, 1 / std::cos(pi / m) - 1, 1}).asDiagonal();
    const ImpactCertificate found = classify_impact(M, line(3));
    EXPECT_EQ(found.kind, ImpactKind::unique);
    EXPECT_EQ(found.impulses, m);
  }
  EXPECT_EQ(classify_impact(MatX(vec({1, .5, 1}).asDiagonal()), line(3)).kind,
            ImpactKind::order_dependent);
}

TEST(Certificate, GroupsThatDoNotFeelEachOther) {
  MatX N = MatX::Zero(6, 9);
  N.topLeftCorner(3, 4) = line(4);
  N.row(3)[4] = N.row(4)[5] = 1;
  N.row(5).tail(3) << 1, 2, 3;
  const ImpactCertificate found = classify(N);
  EXPECT_EQ(found.type, "A3 x A1^3");
  EXPECT_EQ(found.impulses, 9);
  N.row(5).tail(3) << 0, 0, 0;
  N.row(5)[4] = -1;  // between two walls
  EXPECT_EQ(classify(N).kind, ImpactKind::jammed);
  EXPECT_EQ(classify(MatX(0, 3)).impulses, 0);
}

TEST(Certificate, ANormalThatIsThereTwiceCountsOnce) {
  MatX N(3, 3);
  N << line(3), -2.5, 2.5, 0;
  const ImpactCertificate found = classify(N);
  EXPECT_EQ(found.type, "A2");
  EXPECT_EQ(found.impulses, 3);
  EXPECT_EQ(found.same, (std::vector<int>{0, 1, 0}));
  const VecX unlike = vec({1, 1, .5});  // whichever of the two comes first decides
  EXPECT_EQ(classify_impact(MatX::Identity(3, 3), N, unlike).kind, ImpactKind::order_dependent);
}

TEST(Certificate, RestitutionIsUniqueOnlyBetweenContactsThatDoNotFeelEachOther) {
  EXPECT_EQ(classify(line(3), .5).kind, ImpactKind::order_dependent);
  EXPECT_FALSE(classify(line(3), .5).impulses);
  EXPECT_EQ(classify(wedge(pi / 2), .5).type, "A1^2");
  EXPECT_EQ(classify(wedge(pi / 2), .5).impulses, 2);
  EXPECT_EQ(classify(line(3), 0).kind, ImpactKind::unique);
  EXPECT_EQ(classify(line(3), 0).type, "plastic");
  const MatX walls = (MatX(2, 1) << 1, -1).finished();
  EXPECT_EQ(classify(walls, 0).kind, ImpactKind::unique);
  EXPECT_EQ(classify(walls, .5).kind, ImpactKind::jammed);
}

TEST(Certificate, BadArgumentsAreNamed) {
  const MatX M = MatX::Identity(2, 2);
  EXPECT_THROW(classify_impact(M, line(2), 2.), ModelError);
  EXPECT_THROW(classify_impact(M, line(3)), ModelError);
  try {
    classify_impact(M, line(2), 1, {.tolerance = .5});
    FAIL();
  } catch (const ModelError& e) {
    EXPECT_STREQ(e.what(), "tolerance 0.5 of angles is outside (0, 1e-3]");
  }
}

}  // namespace
}  // namespace saltus
