// What is read all the same, or not used: said in warnings, of each kind once.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "urdf/document.hpp"

namespace saltus::reader {

class Warnings {
 public:
  explicit Warnings(bool strict) : strict_(strict) {}

  /// What is not used. Those of one `kind` become one line: the first, and how many more.
  void add(const std::string& kind, const std::string& text);

  /// What is wrong and read all the same, as other readers do: `text` says it, `reading` how it is
  /// read ("; its limits are not used").
  /// @throws ModelError with the text where reading is strict.
  void add_flaw(const std::string& kind, const std::string& text, const std::string& reading,
                const Owner& owner = {});

  bool has(const std::string& kind) const { return line_of_kind_.count(kind) > 0; }

  std::vector<std::string> lines() const;

 private:
  struct Line {
    std::string text;
    int count = 0;
  };
  bool strict_;
  std::vector<Line> lines_;
  std::map<std::string, std::size_t> line_of_kind_;
};

}  // namespace saltus::reader
