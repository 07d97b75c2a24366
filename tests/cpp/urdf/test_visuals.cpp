// What links look like: read, merged under other names, never a reason to fail.
#include <gtest/gtest.h>

#include "urdf/urdf_files.hpp"

namespace saltus {
namespace {

using namespace test;

class UrdfVisuals : public UrdfFiles {
 protected:
  static std::string visual(const std::string& shape, const std::string& more = "") {
    return "<visual name=\"skin\"><origin xyz=\"1 2 3\"/><geometry>" + shape + "</geometry>" +
           more + "</visual>";
  }
  std::string body(const std::string& visuals) {
    return write("r.urdf", one_joint("continuous", "", visuals));
  }
};

TEST_F(UrdfVisuals, HaveShapesPlacesAndColours) {
  const Model model =
      load(body(visual("<box size=\"2 4 6\"/>",
                       "<material name=\"red\"><color rgba=\"1 0 0 0.5\"/></material>") +
                visual("<sphere radius=\"2\"/>")));
  ASSERT_EQ(model.visuals().size(), 2u);
  const Visual& box = model.visuals()[0];
  EXPECT_EQ(visual_kind(box), "box");
  EXPECT_EQ(box.link, "body");
  EXPECT_EQ(box.name, "skin");
  EXPECT_EQ(box.rgba, (Rgba{1, 0, 0, 0.5}));
  expect_near(std::get<Box>(std::get<Shape>(box.shape)).half, {1, 2, 3});
  expect_near(box.X_LG.p, {1, 2, 3});
  EXPECT_EQ(model.visuals()[1].rgba, Visual::grey);
  EXPECT_TRUE(model->shapes.empty());
}

TEST_F(UrdfVisuals, OfAllFormatsAreTheirTriangles) {
  for (const auto& [file, content] :
       std::map<std::string, std::string>{{"a.stl", ascii_stl(tetrahedron())},
                                          {"b.stl", binary_stl(tetrahedron())},
                                          {"c.obj", obj(tetrahedron())},
                                          {"d.dae", dae(tetrahedron())}}) {
    write(file, content);
    const Model model = load(body(visual("<mesh filename=\"" + file + "\"/>")));
    ASSERT_EQ(model.visuals().size(), 1u) << file;
    EXPECT_EQ(visual_kind(model.visuals()[0]), "mesh");
    const Triangles& mesh = *std::get<TriangleMesh>(model.visuals()[0].shape).triangles;
    EXPECT_EQ(mesh.vertices.size(), 4u);
    ASSERT_EQ(mesh.faces.size(), 4u);
    double volume = 0;  // of what lies below the faces, so that all of them look outward
    for (const auto& [a, b, c] : mesh.faces) {
      volume += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c])) / 6;
    }
    EXPECT_NEAR(volume, 1 * 2 * 4 / 6.0, 1e-12) << file;
  }
}

TEST_F(UrdfVisuals, ThatAreBrokenAreLeftOutWithOneWarning) {
  write("a.stl", "garbage");
  const Model model = load(body(visual("<mesh filename=\"a.stl\"/>") + visual("<sphere/>") +
                                visual("<box size=\"1 1 1\"/>")));
  EXPECT_EQ(model.visuals().size(), 1u);
  ASSERT_EQ(model->warnings.size(), 1u);
  expect_warning(model, {"visual mesh, \"a.stl\", which is cut short", "; so are 1 others"});
  EXPECT_TRUE(load(body(visual("<mesh/>")), {.visuals = false}).visuals().empty());
}

TEST_F(UrdfVisuals, GoWithTheirLinksIntoOtherModels) {
  ModelBuilder all;
  const ModelDescription one = read_urdf(body(visual("<box size=\"2 4 6\"/>"))).description();
  all.add(one, {.prefix = "left_"}).add(one, {.prefix = "right_"});
  const Model model = all.build();
  ASSERT_EQ(model.visuals().size(), 2u);
  EXPECT_EQ(model.visuals()[0].link, "left_body");
  EXPECT_EQ(model.visuals()[1].link, "right_body");
}

TEST_F(UrdfVisuals, OfLinksThatAreNotThereAreErrors) {
  expect_error([] { ModelBuilder().add_visual({"hand", Sphere{1}}).build(); }, "link", "hand",
               {"a visual is put on link \"hand\", which does not exist"});
  expect_error([] { ModelBuilder().add_visual({"world", HalfSpace{}}); }, {"has no end"});
  expect_error([] { ModelBuilder().add_visual({"world", TriangleMesh{}}); }, {"without triangles"});
}

}  // namespace
}  // namespace saltus
