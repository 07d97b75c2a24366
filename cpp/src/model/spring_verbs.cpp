// ModelBuilder's verbs for springs, compensation of gravity, and functions.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "model/assembly.hpp"
#include "model/force_checks.hpp"

namespace saltus {
namespace {

[[noreturn]] void fail(const std::string& element, const std::string& name,
                       const std::string& what) {
  throw ModelError(element + " " + quoted(name) + " " + what, element, name);
}

std::string show(double x) {
  std::ostringstream text;
  text << x;
  return text.str();
}

template <class Items>
void check_new(const Items& items, const std::string& element, const std::string& name) {
  if (name.empty()) throw ModelError("a " + element + " has no name", element, name);
  for (const auto& other : items) {
    if (other.name == name) {
      throw ModelError("two " + element + "s are named " + quoted(name), element, name);
    }
  }
}

}  // namespace

void check_curve(const JointSpec& joint) {
  const std::vector<double>&x = joint.curve_x, &f = joint.curve_f;
  if (x.empty() && f.empty()) return;
  const auto refuse = [&](const std::string& what) { fail("joint", joint.name, what); };
  if (joint.stiffness != 0) refuse("has a spring with a stiffness and one with a curve");
  if (x.size() != f.size() || x.size() < 2) {
    refuse("has a spring's curve of " + std::to_string(x.size()) + " displacements and " +
           std::to_string(f.size()) + " forces; it has equally many, two at least");
  }
  for (std::size_t k = 0; k < x.size(); ++k) {
    for (const double number : {x[k], f[k]}) {
      if (is_force_number(number, true)) continue;
      refuse("has a spring's curve with (" + show(x[k]) + ", " + show(f[k]) + ") at " +
             std::to_string(k) + ", with " + refused_number(number, true));
    }
    if (k == 0 || x[k] > x[k - 1]) continue;
    refuse("has a spring's curve whose displacement " + show(x[k]) + " follows " + show(x[k - 1]) +
           "; they ascend");
  }
  if (!joint.curve_slopes) return;
  for (const double slope : *joint.curve_slopes) {
    if (is_force_number(slope, true)) continue;
    refuse("has a spring's curve with end slope " + refused_number(slope, true));
  }
}

void check_spring(const SpringSpec& spring) {
  const auto check = [&](double number, const char* what) {
    if (is_force_number(number, false)) return;
    fail("spring", spring.name, std::string("has ") + what + " " + refused_number(number, false));
  };
  check(spring.stiffness, "stiffness");
  check(spring.length, "length");
  check(spring.damping, "damping");
  for (const At* end : {&spring.a, &spring.b}) {
    if (end->X_LA.p.allFinite()) continue;
    fail("spring", spring.name,
         "is fixed to a point of link " + quoted(end->link) + " that is not finite");
  }
}

ModelBuilder& ModelBuilder::add_spring(const SpringSpec& spring) {
  check_new(d_.springs, "spring", spring.name);
  check_spring(spring);
  for (const At* end : {&spring.a, &spring.b}) {
    named(d_.links, "link", end->link, "spring " + quoted(spring.name) + " asks for it; links");
  }
  d_.springs.push_back(spring);
  return *this;
}

ModelBuilder& ModelBuilder::add_joint_spring(const std::string& name, std::vector<double> x,
                                             std::vector<double> f,
                                             const std::optional<std::array<double, 2>>& slopes) {
  JointSpec& sprung = joint(name);
  JointSpec changed = sprung;
  changed.stiffness = changed.rest = 0;
  changed.curve_x = std::move(x);
  changed.curve_f = std::move(f);
  changed.curve_slopes = slopes;
  if (changed.curve_x.empty() && changed.curve_f.empty())
    fail("joint", name, "has a spring's curve of no points");
  check_forces(changed);
  sprung = std::move(changed);
  return *this;
}

ModelBuilder& ModelBuilder::set_gravity_compensation(const std::string& name, double part) {
  LinkSpec& link = named(d_.links, "link", name, "links");
  if (!is_force_number(part, true)) {
    fail("link", name, "has gravity compensation " + refused_number(part, true));
  }
  link.compensation = part;
  return *this;
}

ModelBuilder& ModelBuilder::add_force(const ForceSpec& force) {
  check_new(d_.forces, "force", force.name);
  if (!force.function) fail("force", force.name, "has no function");
  for (std::size_t k = 0; k < force.coordinates.size(); ++k) {
    const auto begin = force.coordinates.begin(), at_k = begin + static_cast<std::ptrdiff_t>(k);
    if (std::find(begin, at_k, *at_k) == at_k) continue;
    fail("force", force.name, "names coordinate " + quoted(*at_k) + " twice");
  }
  d_.forces.push_back(force);
  return *this;
}

ModelBuilder& ModelBuilder::add_potential(const PotentialFunction& potential) {
  check_new(d_.potentials, "potential", potential.name);
  if (!potential.value || !potential.gradient || !potential.hessian) {
    fail("potential", potential.name, "lacks its value, its gradient or its Hessian");
  }
  d_.potentials.push_back(potential);
  return *this;
}

}  // namespace saltus
