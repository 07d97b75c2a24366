#include "saltus/variational/options.hpp"

#include <cmath>
#include <sstream>

#include "saltus/variational/report.hpp"
#include "variational/terms/check_options.hpp"

namespace saltus {
namespace {

constexpr LawEntry laws[] = {
    {ImpactLaw::nodal_energy, "nodal_energy",
     "H(q, p+) = H(q, p-) at the impact, lambda = -2u/G in closed form; always solvable."},
    {ImpactLaw::discrete_energy, "discrete_energy",
     "that of the arcs on both sides, (11c); the step is exactly symplectic."},
    {ImpactLaw::shadow_energy, "shadow_energy",
     "H - h^2 kappa / 24 at both ends of the step, which steps without impacts conserve."},
    {ImpactLaw::compensated, "compensated",
     "(11c) of arcs with L + (h^2 - tau^2) kappa / 24; exactly symplectic, energy of order h^4."},
    {ImpactLaw::custom, "custom", "a function that was given as the law."},
};

[[noreturn]] void fail(const std::string& name, double value, const std::string& range) {
  std::ostringstream text;
  text << name << " = " << value << "; it must be " << range;
  throw ModelError(text.str());
}

}  // namespace

std::span<const LawEntry> impact_laws() { return laws; }

std::string law_name(ImpactLaw law) {
  for (const LawEntry& each : laws) {
    if (each.law == law) return each.name;
  }
  return "unknown";
}

std::string rung_name(Rung rung) {
  switch (rung) {
    case Rung::halved:
      return "halved";
    case Rung::unlocated:
      return "unlocated";
    case Rung::stopped:
      return "stopped";
  }
  return "unknown";
}

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
