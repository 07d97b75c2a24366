#include "urdf/warnings.hpp"

namespace saltus::reader {

void Warnings::add(const std::string& kind, const std::string& text) {
  const auto [at, is_new] = line_of_kind_.emplace(kind, lines_.size());
  if (is_new) lines_.push_back({text});
  ++lines_[at->second].count;
}

void Warnings::add_flaw(const std::string& kind, const std::string& text,
                        const std::string& reading, const Owner& owner) {
  if (strict_) throw ModelError(text, owner.element, owner.name);
  add(kind, text + reading);
}

std::vector<std::string> Warnings::lines() const {
  std::vector<std::string> out;
  for (const Line& line : lines_) {
    const std::string more = " (and " + std::to_string(line.count - 1) + " more like it)";
    out.push_back(line.text + (line.count > 1 ? more : ""));
  }
  return out;
}

}  // namespace saltus::reader
