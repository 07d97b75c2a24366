#include "urdf/joint_elements.hpp"

#include <limits>
#include <set>

#include "urdf/attributes.hpp"

namespace saltus::reader {

bool are_crossed(const XMLElement& limit) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double lower = number(limit, "lower", -infinity), upper = number(limit, "upper", infinity);
  return lower > upper || lower == infinity || upper == -infinity;
}

std::optional<double> locked_displacement(const Document& document, const XMLElement& joint) {
  double factor = 1, sum = 0;
  const XMLElement* at = &joint;
  for (std::set<const XMLElement*> seen; seen.insert(at).second;) {
    const XMLElement* mimic = at->FirstChildElement("mimic");
    if (mimic == nullptr) return {};
    sum += factor * number(*mimic, "offset", 0);
    factor *= number(*mimic, "multiplier", 1);
    at = document.find("joint", attribute(*mimic, "joint"));
    if (at == nullptr) return {};
    if (attribute(*at, "type") == "fixed") return sum;
  }
  return {};
}

}  // namespace saltus::reader
