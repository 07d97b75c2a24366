// Collision meshes: three formats, their hulls, what the file and the options say, what is broken.
#include <gtest/gtest.h>

#include "urdf/urdf_files.hpp"

namespace saltus {
namespace {

using namespace test;

class UrdfMeshes : public UrdfFiles {
 protected:
  static std::string mesh(const std::string& file, const std::string& scale = "") {
    const std::string attributes = scale.empty() ? "" : " scale=\"" + scale + "\"";
    return "<collision><origin xyz=\"1 2 3\" rpy=\"0 0 0.5\"/><geometry>\n<mesh filename=\"" +
           file + "\"" + attributes + "/></geometry></collision>";
  }

  /// The file, and a robot beside it.
  std::string robot_with(const std::string& file, const std::string& content,
                         const std::string& scale = "") {
    write(file, content);
    return write("r.urdf", one_joint("continuous", "", mesh(file, scale)));
  }

  static std::vector<Vec3> vertices(const Model& model, std::size_t shape = 0) {
    return std::get<Convex>(model->shapes.at(shape).shape).hull->vertices;
  }

  void expect_error(const std::string& file, const std::string& content,
                    const std::vector<std::string>& parts, const std::string& scale = "") {
    const std::string path = robot_with(file, content, scale);
    const std::string what = message_of([&] { read_urdf(path, {.strict = true}); });
    EXPECT_EQ(what.rfind(path + ":4: link \"body\" has a collision mesh, \"" + file, 0), 0u)
        << what;
    EXPECT_EQ(what.find(path, 1), std::string::npos) << what;  // the place is told once
    for (const std::string& part : parts) expect_contains(what, part);
  }
};

void expect_points(std::vector<Vec3> found, std::vector<Vec3> expected) {
  const auto before = [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  std::sort(found.begin(), found.end(), before);
  std::sort(expected.begin(), expected.end(), before);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) expect_near(found[i], expected[i], 1e-6);
}

TEST_F(UrdfMeshes, OfAllFormatsAreTheirHulls) {
  Mesh solid = tetrahedron();
  solid.points.push_back({0.1, 0.1, 0.1});  // inside
  solid.triangles.push_back({0, 1, 4});
  for (const auto& [file, content] :
       std::map<std::string, std::string>{{"a.stl", ascii_stl(solid)},
                                          {"b.stl", binary_stl(solid)},
                                          {"c.stl", binary_stl(solid, "solid that is none")},
                                          {"d.STL", binary_stl(solid)},
                                          {"e.obj", obj(solid)},
                                          {"f.dae", dae(solid)},
                                          {"g.Dae", dae(solid)}}) {
    const Model model = load(robot_with(file, content));
    ASSERT_EQ(model->shapes.size(), 1u) << file;
    expect_points(vertices(model), tetrahedron().points);
    const Pose X_JL = model->links[static_cast<std::size_t>(model.link("body"))].X_JL;
    const Pose X_LG = X_JL.inverse() * model->shapes[0].X_JG;
    expect_near(X_LG.p, {1, 2, 3});
    expect_near(X_LG.R, rotation_from_rpy(0, 0, 0.5), 4e-16);
    expect_warning(model, {"r.urdf:4: link \"body\" has a collision mesh, used as its convex hull",
                           "\"" + file + "\" (4 of its 5 vertices)"});
  }
}

TEST_F(UrdfMeshes, AreScaled) {
  std::vector<Vec3> expected = tetrahedron().points;
  for (Vec3& p : expected) p = p.cwiseProduct(Vec3(0.001, -2, 3));
  expect_points(vertices(load(robot_with("a.stl", binary_stl(tetrahedron()), "0.001 -2 3"))),
                expected);
}

TEST_F(UrdfMeshes, OfColladaKeepTheirAxesAndHaveUnitsAndTransforms) {
  std::vector<Vec3> expected = tetrahedron().points;
  for (Vec3& p : expected) p = 0.01 * (p + Vec3(5, 6, 7));
  for (const std::string axis : {"X_UP", "Y_UP", "Z_UP"}) {
    const std::string text = dae(
        tetrahedron(), "<unit name=\"centimeter\" meter=\"0.01\"/><up_axis>" + axis + "</up_axis>",
        "<translate>5 6 7</translate>");
    expect_points(vertices(load(robot_with("a.dae", text))), expected);
  }
}

TEST_F(UrdfMeshes, OfTheSameFileAndScaleShareAHull) {
  write("a.obj", obj(tetrahedron()));
  write("sub/b.obj", obj(tetrahedron()));
  const Model model = load(write(
      "r.urdf", one_joint("continuous", "",
                          mesh("a.obj") + mesh("a.obj", "2 2 2") + mesh("sub/../a.obj", "1 1 1") +
                              mesh("sub/b.obj") + mesh("a.obj", "2 2 2"))));
  std::vector<const Hull*> hulls;
  for (const PlacedShape& shape : model->shapes) {
    hulls.push_back(std::get<Convex>(shape.shape).hull.get());
  }
  ASSERT_EQ(hulls.size(), 5u);
  EXPECT_EQ(hulls[0], hulls[2]);
  EXPECT_EQ(hulls[1], hulls[4]);
  EXPECT_NE(hulls[0], hulls[1]);
  EXPECT_NE(hulls[0], hulls[3]);
  ASSERT_EQ(model->warnings.size(), 1u);  // one line for all of them
  expect_warning(model, {"3 collision meshes are used as their convex hulls",
                         "hulls: a.obj (4 of its 4 vertices), a.obj", "b.obj (4 of"});
}

TEST_F(UrdfMeshes, ThatAreMissingAreOneWarning) {
  write("a.obj", obj(tetrahedron()));
  const Model model = load(write(
      "r.urdf",
      one_joint("continuous", "", mesh("x.stl") + mesh("a.obj") + mesh("y.stl") + mesh("z.stl"))));
  EXPECT_EQ(model->shapes.size(), 1u);
  EXPECT_EQ(model->warnings.size(), 2u);
  expect_warning(model,
                 {"r.urdf:4: link \"body\" has a collision mesh, \"x.stl\", which is not found",
                  "looked in " + folder_.string(), "so are 2 others"});
}

TEST_F(UrdfMeshes, AreNotUsedIfTheOptionOrTheFileSaysSo) {
  write("a.obj", obj(tetrahedron()));
  const auto text = [&](const std::string& block) {
    return write("r.urdf", robot("<link name=\"base\"/>" + ball_link("a", mesh("a.obj")) +
                                 ball_link("b", mesh("a.obj") + mesh("lost.stl")) +
                                 joint("ja", "floating", "base", "a") +
                                 joint("jb", "floating", "base", "b") + block));
  };
  const auto names = [](const Model& model) {
    std::vector<std::string> found;
    for (const PlacedShape& shape : model->shapes) found.push_back(shape.name);
    return found;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(load(text(""))), (Names{"a", "b"}));
  const Model without = load(text(""), {.meshes = MeshUse::none});
  EXPECT_EQ(names(without), Names{});
  EXPECT_TRUE(without->warnings.empty());
  EXPECT_EQ(names(load(text("<saltus><mesh link=\"a\" use=\"none\"/></saltus>"))), Names{"b"});
  const std::string both = "<saltus><mesh link=\"a\" use=\"hull\"/></saltus>";
  EXPECT_EQ(names(load(text(both), {.meshes = MeshUse::none})), Names{"a"});
}

TEST_F(UrdfMeshes, HaveNoOtherUse) {
  const auto what = [](const std::string& elements) {
    return message_of(
        [&] { read_urdf(robot("<link name=\"base\"/><saltus>\n" + elements + "\n</saltus>")); });
  };
  expect_contains(what("<mesh link=\"base\" use=\"box\"/>"),
                  "URDF text:3: <mesh> has use=\"box\"; known are hull, none");
  expect_contains(what("<mesh link=\"bas\" use=\"none\"/>"),
                  "<mesh> names link \"bas\", which does not exist; links are base");
  expect_contains(what("<mesh link=\"base\"/>"), "<mesh> is without attribute \"use\"");
  expect_contains(what("<mesh link=\"base\" use=\"none\"/><mesh link=\"base\" use=\"hull\"/>"),
                  "<mesh> is the second for link \"base\"");
}

TEST_F(UrdfMeshes, ThatAreBrokenAreErrors) {
  const std::string good = binary_stl(tetrahedron()), text = ascii_stl(tetrahedron());
  expect_error("a.stl", "",
               {"which is empty", "found at " + (folder_ / "a.stl").string(),
                "<mesh link=\"body\" use=\"none\"/> in <saltus> does without it"});
  expect_error("a.stl", good.substr(0, 200),
               {"is cut short: it has 200 bytes, and a binary STL of 4 facets has 284"});
  expect_error("a.stl", good.substr(0, 40), {"is cut short: it has 40 bytes"});
  expect_error("a.stl", text.substr(0, text.size() / 2), {"is cut short: an ASCII STL ends with"});
  expect_error("a.stl", text.substr(0, text.size() - 15), {"is cut short"});
  expect_error("a.stl", "solid", {"is cut short"});
  expect_error("a.stl", "solid it\nendsolid it\n", {"which "});
  expect_error("a.stl", "version https://git-lfs.github.com/spec/v1\n", {"a pointer of Git LFS"});
  expect_error("a.obj", "", {"is empty"});
  expect_error("a.obj", "<html>404, there is no such mesh</html>\n", {"has no vertices"});
  expect_error("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", {"cannot be read: "});
  expect_error("a.dae", dae(tetrahedron()).substr(0, 400), {"cannot be read: "});
  expect_error("a.dae", "<COLLADA/>", {"cannot be read: "});
  expect_error("a.ply", "ply\n", {"unknown format, \".ply\"; known are .stl, .obj, .dae"});
  expect_error("mesh", good, {"unknown format, \"\""});
}

TEST_F(UrdfMeshes, WithoutAHullAreErrors) {
  Mesh flat = tetrahedron();
  for (Vec3& p : flat.points) p[2] = 0;
  expect_error("a.stl", binary_stl(flat),
               {"which has no convex hull: 3 points; a convex solid needs 4"});
  flat.points[3] = {5, 5, 0};
  expect_error("a.stl", binary_stl(flat),
               {"which has no convex hull: 4 points that lie in a plane"});
  Mesh bad = tetrahedron();
  bad.points[2][1] = std::nan("");
  expect_error("a.stl", binary_stl(bad), {"has a vertex that is not finite"});
  for (const std::string scale : {"0 1 1", "1 1 0", "0 0 0"}) {
    expect_error("a.stl", binary_stl(tetrahedron()),
                 {"with scale=\"" + scale + "\": a scale of zero"}, scale);
  }
}

}  // namespace
}  // namespace saltus
