// What a URDF may contain, as one table; the checks, the warnings and the rewriting walk it.
#pragma once

#include <string>
#include <vector>

namespace saltus::reader {

/// An attribute that holds numbers.
struct NumberRule {
  const char* name;
  std::size_t count = 1;
  bool required = false;
  bool positive = false;  ///< a size: every number above 0
  bool may_be_infinite = false;
};

struct TextRule {
  const char* name;
  bool required = false;
};

enum class Occurs { any, at_most_once, once };

struct ElementRule {
  const char* name;
  Occurs occurs = Occurs::any;
  std::vector<NumberRule> numbers = {};
  std::vector<TextRule> texts = {};
  std::vector<ElementRule> children = {};
  std::vector<const char*> skipped = {};  ///< known to other readers; not looked into
  bool strict = false;                    ///< what is not known is an error, not a warning

  const ElementRule* child(const std::string& child_name) const;
  std::vector<std::string> attribute_names() const;
  std::vector<std::string> child_names() const;  ///< the skipped ones last
};

/// The rules of `<robot>`.
const ElementRule& schema();

}  // namespace saltus::reader
