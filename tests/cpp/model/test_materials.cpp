// What shapes are made of, and what happens where they meet.
#include <gtest/gtest.h>

#include "kit/ask.hpp"
#include "kit/builders.hpp"

namespace saltus {
namespace {

using test::between;
using test::message_of;
using test::two_balls;

/// Balls a and b, and a floor.
ModelBuilder scene() { return two_balls().add_half_space("floor", Vec3::UnitZ(), -5); }

TEST(Materials, ContactsAreElasticAndSmoothUnlessSaidOtherwise) {
  EXPECT_EQ(between(scene().build(), "a ~ b"), (ContactProperties{1, 0}));
  EXPECT_EQ(between(scene().set_default_contact({0.5, 0.2}).build(), "a ~ b"),
            (ContactProperties{0.5, 0.2}));
}

TEST(Materials, BelongToPairsOfMaterials) {
  ModelBuilder builder = scene();
  builder.set_material("a", "steel").set_material("world", "clay");
  builder.set_contact("clay", "steel", {0, 0.7}).set_default_contact({0.9, 0});
  const Model model = builder.build();
  EXPECT_EQ(between(model, "a ~ floor"), (ContactProperties{0, 0.7}));
  EXPECT_EQ(between(model, "b ~ floor"), (ContactProperties{0.9, 0}));
  EXPECT_EQ(between(model, "a ~ b"), (ContactProperties{0.9, 0}));
}

TEST(Materials, TheLastWordHoldsInAnyOrder) {
  ModelBuilder builder = scene();
  builder.set_material("a", "steel").set_material("b", "wood");
  builder.set_contact("steel", "wood", {0.1, 0}).set_contact("wood", "steel", {0.2, 0});
  builder.set_contact("steel", "steel", {0.3, 0});
  EXPECT_EQ(between(builder.build(), "a ~ b").restitution, 0.2);
  builder.set_material("b", "steel").set_contact("steel", "steel", {0.4, 0});
  const std::string error =
      message_of([&] { builder.build(); });  // nothing is of wood now, and a contact names it
  EXPECT_NE(error.find("\"wood\", which no link has"), std::string::npos) << error;
}

TEST(Materials, ErrorsNameCulpritValueAndAlternatives) {
  EXPECT_THROW(scene().set_default_contact({1.5, 0}), ModelError);
  EXPECT_THROW(scene().set_default_contact({-0.1, 0}), ModelError);
  EXPECT_THROW(scene().set_contact("x", "y", {1, -1}), ModelError);
  EXPECT_THROW(scene().set_contact("x", "y", {NAN, 0}), ModelError);
  EXPECT_THROW(scene().set_contact("x", "y", {1, INFINITY}), ModelError);
  EXPECT_THROW(scene().set_material("a", ""), ModelError);
  EXPECT_EQ(message_of([&] {
              scene().set_material("a", "steel").set_contact("steel", "stel", {}).build();
            }),
            "a contact names material \"stel\", which no link has; materials are steel");
  EXPECT_NE(message_of([&] {
              scene().set_material("c", "steel").build();
            }).find("\"c\", which does not exist"),
            std::string::npos);
}

}  // namespace
}  // namespace saltus
