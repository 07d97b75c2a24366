// As much of a JSON reader as the data of the tests need: no escapes in strings, no error messages
// beyond the place.
#pragma once

#include <cctype>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "saltus/spatial/spatial.hpp"

namespace saltus::test {

/// A value; numbers, true, false and null are kept as their text, like strings.
struct Json {
  std::string text;
  std::vector<Json> items;
  std::map<std::string, Json> members;

  const Json& operator[](const std::string& name) const { return members.at(name); }
  const Json& operator[](std::size_t i) const { return items.at(i); }

  double number() const {
    char* end = nullptr;
    const double x = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0') throw std::runtime_error("no number: '" + text + "'");
    return x;
  }
  VecX vector() const {
    VecX x(static_cast<Eigen::Index>(items.size()));
    for (int i = 0; i < x.size(); ++i) x[i] = items[static_cast<std::size_t>(i)].number();
    return x;
  }
  MatX matrix() const {
    MatX x(static_cast<Eigen::Index>(items.size()),
           static_cast<Eigen::Index>(items.at(0).items.size()));
    for (int i = 0; i < x.rows(); ++i) x.row(i) = items[static_cast<std::size_t>(i)].vector();
    return x;
  }
};

class JsonReader {
 public:
  explicit JsonReader(std::string text) : text_(std::move(text)) {}

  Json read() {
    Json out;
    if (take('{')) {
      while (!take('}')) {
        const std::string name = read().text;
        expect(':');
        out.members[name] = read();
        take(',');
      }
    } else if (take('[')) {
      while (!take(']')) {
        out.items.push_back(read());
        take(',');
      }
    } else if (take('"')) {
      while (text_.at(at_) != '"') out.text += text_[at_++];
      ++at_;
    } else {
      while (at_ < text_.size() && (std::isalnum(text_[at_]) || is_sign_or_point(text_[at_]))) {
        out.text += text_[at_++];
      }
      if (out.text.empty()) fail();
    }
    return out;
  }

 private:
  static bool is_sign_or_point(char c) { return c == '+' || c == '-' || c == '.'; }
  [[noreturn]] void fail() const {
    throw std::runtime_error("JSON: unexpected text at " + std::to_string(at_));
  }
  bool take(char c) {
    while (at_ < text_.size() && std::isspace(text_[at_])) ++at_;
    if (at_ >= text_.size()) fail();
    if (text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!take(c)) fail();
  }

  std::string text_;
  std::size_t at_ = 0;
};

inline Json read_json(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot open " + path);
  std::ostringstream text;
  text << file.rdbuf();
  return JsonReader(text.str()).read();
}

}  // namespace saltus::test
