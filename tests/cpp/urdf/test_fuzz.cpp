// Broken files end in a model or a ModelError, never in a crash, another exception or a hang.
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>

#include "urdf/mistakes.hpp"

namespace saltus {
namespace {

using namespace test;

std::string file_text(const std::string& name) {
  std::ostringstream text;
  text << std::ifstream(std::string(SALTUS_URDF_DIR) + "/" + name).rdbuf();
  return text.str();
}

/// @return whether a model could be made
bool survives(const std::string& text) {
  try {
    load(text.empty() || text[0] != '<' ? "<" + text : text);
    return true;
  } catch (const ModelError& error) {
    EXPECT_GT(std::string(error.what()).size(), 10u);
    return false;
  }
}

TEST(UrdfFuzz, Truncated) {
  const std::string text = good_file;
  for (std::size_t length = 0; length < text.size(); ++length) {
    const bool complete = length >= text.rfind("</robot>") + 8;
    EXPECT_EQ(survives(text.substr(0, length)), complete) << "at " << length;
  }
  const std::string arm = file_text("arm.urdf");
  ASSERT_GT(arm.size(), 1000u);
  for (std::size_t length = 0; length + 10 < arm.size(); length += 97) {
    EXPECT_FALSE(survives(arm.substr(0, length))) << "at " << length;
  }
}

class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  std::string operator()(std::string text) {
    const int edits = below(3) + 1;
    for (int k = 0; k < edits; ++k) edit(text);
    return text;
  }

 private:
  int below(std::size_t n) {
    return static_cast<int>(std::uniform_int_distribution<std::size_t>(0, n - 1)(random_));
  }

  void edit(std::string& text) {
    static const std::vector<std::string> words = {
        "nan",      "-inf",      "1e999",      "-1",     "0",     "1e-320",   "1e308",
        "",         "<",         ">",          "\"",     "/>",    "<!--",     "&#0;",
        "&#xD800;", "<![CDATA[", "floating",   "planar", "mesh",  "box",      "link",
        "joint",    "base",      "upper",      "lower",  "elbow", "<saltus>", "</link>",
        "\xFF\xFE", "\n",        "99999999999"};
    const int at = below(text.size()), length = 1 + below(20);
    switch (below(5)) {
      case 0:
        text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(below(text.size()), text.substr(at, 5 * length));
        break;
      case 3:
        text.insert(at, words[below(words.size())]);
        break;
      default:
        replace_value(text, at, words[below(words.size())]);
    }
    if (text.empty()) text = " ";
  }

  /// Of the first attribute after this place.
  static void replace_value(std::string& text, std::size_t at, const std::string& word) {
    const std::size_t begin = text.find('"', at);
    const std::size_t end = begin == std::string::npos ? begin : text.find('"', begin + 1);
    if (end != std::string::npos) text.replace(begin + 1, end - begin - 1, word);
  }

  std::mt19937 random_;
};

TEST(UrdfFuzz, Mutated) {
  Mutator mutate(7);
  int models = 0;
  for (int k = 0; k < 4000; ++k) models += survives(mutate(good_file));
  EXPECT_GT(models, 200);  // else nothing behind the first checks was tried
  EXPECT_LT(models, 3000);
}

TEST(UrdfFuzz, MutatedArm) {
  Mutator mutate(11);
  const std::string arm = file_text("arm.urdf");
  for (int k = 0; k < 300; ++k) survives(mutate(arm));
}

TEST(UrdfFuzz, LongChainsAndManyLinks) {
  std::string links = "<link name=\"l0\"/>", joints;
  for (int i = 1; i <= 1000; ++i) {
    const std::string name = "l" + std::to_string(i);
    links += ball_link(name);
    joints += joint("j" + std::to_string(i), "continuous", "l" + std::to_string(i - 1), name,
                    "<origin xyz=\"0 0 1\"/>");
  }
  EXPECT_EQ(load_urdf(robot(links + joints)).n_q(), 1000);
}

}  // namespace
}  // namespace saltus
