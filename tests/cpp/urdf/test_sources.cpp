// Files, text and meshes: what is read, where it is looked for, and what is too much.
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <thread>

#include "urdf/urdf_files.hpp"

namespace saltus {
namespace {

using namespace test;
std::string with_mesh(const std::string& file, const std::string& element = "collision") {
  return one_joint(
      "continuous", "",
      "<" + element + "><geometry><mesh filename=\"" + file + "\"/></geometry></" + element + ">");
}

TEST_F(UrdfFiles, ErrorsBeginWithThePathAsGiven) {
  const std::string path = write("arm.urdf", one_joint("hinge"));
  expect_contains(message_of([&] { read_urdf(path); }),
                  path + ":4: joint \"j\" has type \"hinge\"");
}

TEST_F(UrdfFiles, AFileIsReadAsTextIs) {
  const std::string path = write("arm.urdf", "\xEF\xBB\xBF" + one_joint("continuous"));
  EXPECT_EQ(load(path).n_q(), 1);
  EXPECT_EQ(load("\xEF\xBB\xBF \n" + one_joint("continuous")).n_q(), 1);
}

TEST_F(UrdfFiles, MissingFile) {
  write("arm.urdf", "");
  write("leg.urdf", "");
  const std::string path = (folder_ / "amr.urdf").string();
  const std::string what = message_of([&] { read_urdf(path); });
  expect_contains(what, "no file \"" + path + "\"");
  expect_contains(what, "URDF files there are arm.urdf, leg.urdf");
}

TEST_F(UrdfFiles, MissingRelativeFileSaysWhatWasTried) {
  const std::string what = message_of([] { read_urdf("no/such/arm.urdf"); });
  expect_contains(what, "no file \"no/such/arm.urdf\"");
  expect_contains(what, "tried \"" + (fs::current_path() / "no/such/arm.urdf").string() + "\"");
  expect_contains(what, "no/such\" does not exist");
}

TEST_F(UrdfFiles, Directory) {
  write("arm.urdf", "");
  const std::string what = message_of([&] { read_urdf(folder_.string()); });
  expect_contains(what, "is a directory, not a URDF file");
  expect_contains(what, "arm.urdf");
}

TEST_F(UrdfFiles, EmptyFileAndEmptyString) {
  for (const char* text : {"", " \n\t "}) {
    const std::string path = write("arm.urdf", text);
    expect_contains(message_of([&] { read_urdf(path); }), path + ": the file is empty");
    expect_contains(message_of([&] { read_urdf(text); }), "empty string is neither");
  }
}

TEST_F(UrdfFiles, NoXml) {
  const std::string path = write("arm.urdf", "solid arm\n facet normal 0 0 1\n");
  expect_contains(message_of([&] { read_urdf(path); }), path + ":1: not XML: text outside");
  const std::string binary = write("arm.stl", std::string("solid\0arm", 9));
  expect_contains(message_of([&] { read_urdf(binary); }), binary + ": not a text file");
}

TEST_F(UrdfFiles, TextThatIsNoXmlIsShownShortened) {
  const std::string what = message_of([] { read_urdf("robot\n" + std::string(10000, 'x')); });
  expect_contains(what, "URDF text must begin with '<'");
  EXPECT_LT(what.size(), 1000u);
}

TEST_F(UrdfFiles, TooMuchText) {
  const std::string text = "<robot>" + std::string(std::size_t{65} << 20, ' ') + "</robot>";
  expect_contains(message_of([&] { read_urdf(text); }), "more than 64 MiB");
}

TEST_F(UrdfFiles, TooDeepNesting) {
  std::string text;
  for (int i = 0; i < 100000; ++i) text += "<robot>";
  expect_contains(message_of([&] { read_urdf(text); }), "nested more than");
}

TEST_F(UrdfFiles, EntitiesAreNotExpanded) {
  std::string bomb = "<!DOCTYPE robot [<!ENTITY a0 \"aaaaaaaaaa\">";
  for (int i = 1; i < 20; ++i) {
    bomb += "<!ENTITY a" + std::to_string(i) + " \"";
    for (int k = 0; k < 10; ++k) bomb += "&a" + std::to_string(i - 1) + ";";
    bomb += "\">";
  }
  bomb += "]>\n<robot name=\"&a19;\"><link name=\"&a19;\"/></robot>";
  EXPECT_EQ(load(bomb)->links[0].name, "&a19;");
}

TEST_F(UrdfFiles, MeshesAreFoundBesideTheFileAndInPackages) {
  const std::string mesh = write("pkg/meshes/a.stl", ascii_stl(tetrahedron()));
  struct Place {
    std::string urdf, uri;
    std::vector<std::string> package_dirs;
  };
  const std::string here = folder_.string();
  for (const Place& place :
       {Place{"pkg/meshes/r.urdf", "a.stl", {}}, Place{"pkg/urdf/r.urdf", "../meshes/a.stl", {}},
        Place{"r.urdf", "package://pkg/meshes/a.stl", {}},
        Place{"pkg/urdf/deep/r.urdf", "package://pkg/meshes/a.stl", {}},
        Place{"other/r.urdf", "model://pkg/meshes/a.stl", {}}, Place{"other/r.urdf", mesh, {}},
        Place{"other/r.urdf", "file://" + mesh, {}},
        Place{"other/r.urdf", "meshes/a.stl", {here + "/pkg"}}}) {
    const Model model =
        load(write(place.urdf, with_mesh(place.uri)), {.package_dirs = place.package_dirs});
    ASSERT_EQ(model->warnings.size(), 1u);
    expect_contains(model->warnings[0], "link \"body\" has a collision mesh");
    expect_contains(model->warnings[0], "\"" + place.uri + "\" (4 of its 4 vertices)");
    EXPECT_EQ(model->shapes.size(), 1u);
  }
  const std::string text = with_mesh("package://pkg/meshes/a.stl");
  for (const std::string& dir : {here, here + "/", here + "/pkg", here + "/pkg/./"}) {
    EXPECT_EQ(load(text, {.package_dirs = {dir}})->shapes.size(), 1u);
  }
}

TEST_F(UrdfFiles, MeshesThatAreNotFoundTellWhereTheyWereSought) {
  const std::string path = write("a/b/r.urdf", with_mesh("package://pkg/a.stl"));
  const Model model = load(path, {.package_dirs = {"/opt/robots"}});
  expect_warning(model, {path + ":3: link \"body\"", "package://pkg/a.stl", "not found; looked in",
                         "/opt/robots", (folder_ / "a/b").string(), folder_.string()});
}

TEST_F(UrdfFiles, VisualMeshesAreNamedOnceIfTheyAreMissing) {
  write("a.stl", binary_stl(tetrahedron()));
  EXPECT_TRUE(load(write("r.urdf", with_mesh("a.stl", "visual")))->warnings.empty());
  const std::string visual = "<visual><geometry><mesh filename=\"b.stl\"/></geometry></visual>";
  const Model model = load(write("r.urdf", one_joint("continuous", "", visual + visual + visual)));
  ASSERT_EQ(model->warnings.size(), 1u);
  expect_warning(model, {"visual mesh, \"b.stl\"", "not found", "so are 2 others"});
}

// urdfdom's messages go through one sink for the whole process.
TEST_F(UrdfFiles, ManyThreadsMayLoad) {
  const std::string good = one_joint("continuous"), bad = one_joint("hinge");
  std::vector<std::thread> threads;
  std::atomic<int> right = 0;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      for (int k = 0; k < 50; ++k) {
        right += load(good).n_q();
        try {
          read_urdf(bad);
        } catch (const ModelError&) {
          ++right;
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(right, 400);
}

}  // namespace
}  // namespace saltus
