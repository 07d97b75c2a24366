#include "saltus/variational/options.hpp"

#include <cmath>
#include <sstream>

#include "saltus/variational/report.hpp"
#include "variational/terms/check_options.hpp"

namespace saltus {
namespace {

[[noreturn]] void fail(const std::string& name, double value, const std::string& range) {
  std::ostringstream text;
  text << name << " = " << value << "; it must be " << range;
  throw ModelError(text.str());
}

}  // namespace

std::string law_name(ImpactLaw law) {
  switch (law) {
    case ImpactLaw::nodal_energy:
      return "nodal_energy";
    case ImpactLaw::discrete_energy:
      return "discrete_energy";
    case ImpactLaw::shadow_energy:
      return "shadow_energy";
    case ImpactLaw::compensated:
      return "compensated";
    case ImpactLaw::custom:
      return "custom";
  }
  return "unknown";
}

std::string rung_name(Rung rung) { return rung == Rung::halved ? "halved" : "unknown"; }

void check_options(const StepOptions& o) {
  if (!(o.h > 0) || !std::isfinite(o.h)) fail("h", o.h, "positive and finite [s]");
  if (o.max_iterations < 1) fail("max_iterations", o.max_iterations, "at least 1");
  if (o.max_impacts < 1) fail("max_impacts", o.max_impacts, "at least 1");
  if (o.max_halvings < 0 || o.max_halvings > 20) fail("max_halvings", o.max_halvings, "in [0, 20]");
  if (o.max_impulses < 1) fail("max_impulses", o.max_impulses, "at least 1");
  if (!(o.rest >= 0 && o.rest < 1)) fail("rest", o.rest, "in [0, 1)");
  if (!(o.simultaneous >= 0 && o.simultaneous < 1)) {
    fail("simultaneous", o.simultaneous, "in [0, 1)");
  }
  if ((o.law == ImpactLaw::custom) == static_cast<bool>(o.custom)) return;
  throw ModelError(o.custom
                       ? "a custom law is given, but law = " + law_name(o.law) +
                             "; set law = ImpactLaw::custom"
                       : "law = custom without a function: give the function itself as the law "
                         "(in C++ as StepOptions::custom)");
}

}  // namespace saltus
