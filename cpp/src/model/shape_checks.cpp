#include "model/shape_checks.hpp"

#include "collision/shapes/facts.hpp"
#include "saltus/error.hpp"

namespace saltus {

void check_shape(const Shape& shape, const std::string& link) {
  const std::string what = flaw(shape), name = shape_name(shape);
  if (what.empty()) return;
  const bool vowel = std::string("aeiou").find(name[0]) != std::string::npos;
  throw ModelError("link \"" + link + "\" has " + (vowel ? "an " : "a ") + name + " " + what,
                   "link", link);
}

}  // namespace saltus
