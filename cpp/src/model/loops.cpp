// Loops and couplings: the builder's verbs, and what build() makes of them.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "model/assembly.hpp"
#include "model/shape_checks.hpp"
#include "saltus/lagrangian/curve.hpp"

namespace saltus {
namespace {

std::string coupling_name(const std::string& joint) { return joint + " coupling"; }

[[noreturn]] void fail(const std::string& loop, const std::string& what) {
  throw ModelError("loop " + quoted(loop) + " " + what, "loop", loop);
}

void check_loop(const LoopSpec& loop) {
  if (loop.name.empty()) throw ModelError("a loop has no name", "loop", "");
  if (loop.type == LoopType::coupling || loop.type == LoopType::prescribed) {
    fail(loop.name, "is of type " + loop_type_name(loop.type) +
                        "; add_coupling and set_prescribed make these");
  }
  if (loop.a.link == loop.b.link) {
    fail(loop.name, "has both ends on link " + quoted(loop.a.link) + "; they are on two links");
  }
  const bool has_distance = loop.type == LoopType::distance;
  if (has_distance ? std::isfinite(loop.distance) && loop.distance > 0 : loop.distance == 0) return;
  std::ostringstream text;
  text << "has distance " << loop.distance << "; it is positive of type distance"
       << (has_distance ? "" : " and 0 of all others");
  fail(loop.name, text.str());
}

void check_coupling(const CouplingSpec& coupling) {
  const auto wrong = [&](const std::string& what) {
    throw ModelError("the coupling of joint " + quoted(coupling.joint) + " " + what, "joint",
                     coupling.joint);
  };
  if (coupling.joint == coupling.of) wrong("is to itself; it is to another joint");
  if (coupling.polynomial.empty()) wrong("has no polynomial; (0, 1) makes the two equal");
  for (const double each : coupling.polynomial) {
    if (!std::isfinite(each)) wrong("has a coefficient that is not finite");
  }
}

}  // namespace

ModelBuilder& ModelBuilder::add_loop(const std::string& name, LoopType type, const At& a,
                                     const At& b, double distance) {
  LoopSpec loop{name, type, a, b, distance};
  check_loop(loop);
  for (At* end : {&loop.a, &loop.b}) end->X_LA = checked_pose(end->X_LA, "loop", name);
  for (const LoopSpec& other : d_.loops) {
    if (other.name == name) {
      throw ModelError("two loops are named " + quoted(name), "loop", name);
    }
  }
  d_.loops.push_back(loop);
  return *this;
}

ModelBuilder& ModelBuilder::add_coupling(const std::string& joint, const std::string& of,
                                         const std::vector<double>& polynomial) {
  const CouplingSpec coupling{joint, of, polynomial};
  check_coupling(coupling);
  for (const CouplingSpec& other : d_.couplings) {
    if (other.joint != joint) continue;
    throw ModelError("joint " + quoted(joint) + " has two couplings", "joint", joint);
  }
  d_.couplings.push_back(coupling);
  return *this;
}

namespace {

void check_prescribed(const PrescribedSpec& spec) {
  const auto wrong = [&](const std::string& what) {
    throw ModelError("the prescribed motion of joint " + quoted(spec.joint) + " " + what, "joint",
                     spec.joint);
  };
  if (spec.function) return;
  if (spec.times.size() != spec.values.size() || spec.times.size() < 2) {
    wrong("has " + std::to_string(spec.times.size()) + " times and " +
          std::to_string(spec.values.size()) + " values; it has equally many, two at least");
  }
  for (std::size_t k = 0; k < spec.times.size(); ++k) {
    if (!std::isfinite(spec.times[k]) || !std::isfinite(spec.values[k])) {
      wrong("has a time or value " + std::to_string(k) + " that is not finite");
    }
    if (k > 0 && !(spec.times[k] > spec.times[k - 1])) {
      wrong("has time " + std::to_string(k) + " that is not after the one before");
    }
  }
}

/// Of masses and moments; 1 where there are none.
double largest_inertia(const std::vector<Link>& links) {
  double most = 0;
  for (const Link& link : links) {
    most = std::max({most, link.mass, link.inertia.I_J.cwiseAbs().maxCoeff()});
  }
  return most > 0 ? most : 1;
}

}  // namespace

ModelBuilder& ModelBuilder::set_prescribed(const std::string& joint, std::vector<double> times,
                                           std::vector<double> values) {
  return set_prescribed(PrescribedSpec{joint, std::move(times), std::move(values)});
}

ModelBuilder& ModelBuilder::set_prescribed(const std::string& joint,
                                           std::function<PrescribedMotion(double)> function) {
  return set_prescribed(PrescribedSpec{joint, {}, {}, std::move(function)});
}

ModelBuilder& ModelBuilder::set_prescribed(const PrescribedSpec& spec) {
  check_prescribed(spec);
  for (const PrescribedSpec& other : d_.prescribed) {
    if (other.joint != spec.joint) continue;
    throw ModelError("joint " + quoted(spec.joint) + " has two prescribed motions", "joint",
                     spec.joint);
  }
  d_.prescribed.push_back(spec);
  return *this;
}

Equality::End Assembly::end_of(const At& at, const std::string& loop) const {
  const int link = link_index(at.link, "loop " + quoted(loop) + " holds", "loop", loop);
  const Place& place = place_[static_cast<std::size_t>(link)];
  return {place.joint, place.X_JF * at.X_LA};
}

void Assembly::add_loops() {
  EqualityModel& out = m_.equalities;
  const auto add = [&](Equality each) {
    each.first = out.rows;
    out.rows += rows_of(each.type);
    out.all.push_back(std::move(each));
  };
  for (const LoopSpec& loop : d_.loops) {
    const Equality::End a = end_of(loop.a, loop.name), b = end_of(loop.b, loop.name);
    if (a.joint == b.joint) {
      fail(loop.name, "holds links " + quoted(loop.a.link) + " and " + quoted(loop.b.link) +
                          " together, which are fixed to each other");
    }
    add({loop.name, loop.type, a, b, loop.distance, {}});
  }
  for (const CouplingSpec& coupling : d_.couplings) {
    const std::string user = "a coupling moves";
    const int driven = moved_frame(coupling.joint, user), by = moved_frame(coupling.of, user);
    if (base_[joint_.at(coupling.joint)] == base_[joint_.at(coupling.of)]) {
      throw ModelError("a coupling ties joint " + quoted(coupling.joint) + " to joint " +
                           quoted(coupling.of) + "; one of them mimics the other already",
                       "joint", coupling.joint);
    }
    Equality tie{coupling_name(coupling.joint), LoopType::coupling, {driven, {}}, {by, {}}};
    tie.polynomial = coupling.polynomial;
    add(tie);
  }
  const double lock = d_.prescribed.empty() ? 0 : largest_inertia(m_.links);
  for (const PrescribedSpec& spec : d_.prescribed) {
    Equality told{spec.joint + " prescribed",
                  LoopType::prescribed,
                  {moved_frame(spec.joint, "set_prescribed moves"), {}}};
    told.lock = lock;
    told.motion = spec.function;
    if (!told.motion) {
      told.motion = [curve = make_curve(spec.times, spec.values)](double t) {
        const CurveValue at = curve(t);
        return PrescribedMotion{at.f, at.slope, at.second};
      };
    }
    add(told);
  }
}

/// The frame that a joint of one coordinate moves.
int Assembly::moved_frame(const std::string& joint, const std::string& user) const {
  const JointSpec& spec = d_.joints[static_cast<std::size_t>(joint_index(joint, user))];
  if (has_one_coordinate(spec.type)) {
    return named(m_.joints, "joint", spec.name).frames.front();
  }
  throw ModelError(user + " joint " + quoted(joint) + ", which has not one coordinate", "joint",
                   joint);
}

}  // namespace saltus
