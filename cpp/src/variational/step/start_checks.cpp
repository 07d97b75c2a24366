// What a step does not start from: loops that are open, joints beyond their limits, overlap
// of parts that touch, and of whole shapes, whose parts may all lie on faces.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>

#include "saltus/model/close_loops.hpp"
#include "variational/step/stepper_impl.hpp"

namespace saltus {
namespace {

/// Touches (1e-10 of the shapes' size) that are an overlap: what a state written with 8 digits
/// loses is none.
constexpr double overlap_touches = 100;

constexpr std::size_t most_listed = 5;

/// By the names of links, which an exclusion takes; a shape of the world has its own.
std::string name_of(const ModelData& model, int shape) {
  const PlacedShape& placed = model.shapes[static_cast<std::size_t>(shape)];
  return placed.joint < 0 ? placed.name : model.links[static_cast<std::size_t>(placed.link)].name;
}

using Depths = std::map<std::pair<std::string, std::string>, double>;

void note(const ModelData& model, const Pair& pair, double phi, Depths& depths) {
  if (phi >= -overlap_touches * pair.touch) return;
  if (pair.is_stop()) return;  // check_limits has said so
  double& depth = depths[std::minmax(name_of(model, pair.a), name_of(model, pair.b))];
  depth = std::max(depth, -phi);
}

std::string list(const Depths& depths) {
  std::vector<std::pair<double, std::string>> deepest;
  for (const auto& [names, depth] : depths) {
    deepest.emplace_back(depth, names.first + " ~ " + names.second);
  }
  std::sort(deepest.rbegin(), deepest.rend());
  std::ostringstream text;
  for (std::size_t i = 0; i < std::min(deepest.size(), most_listed); ++i) {
    text << (i > 0 ? ", " : "") << deepest[i].second << " by " << deepest[i].first << " m";
  }
  if (deepest.size() > most_listed) {
    text << " and " << deepest.size() - most_listed << " pairs of links more";
  }
  return text.str();
}

/// A start beyond a joint's limit is told by joint, value and limit.
void check_limits(const ModelData& model, const VecX& q) {
  for (const JointLimit& limit : model.limits) {
    const double x = q[limit.coordinate], bound = limit.stop.bound;
    const double touch = relative_touch * std::max(1.0, std::abs(bound));
    if (limit.stop.side * (x - bound) >= -overlap_touches * touch) continue;
    const std::string& joint = model.coordinates[static_cast<std::size_t>(limit.coordinate)].joint;
    std::ostringstream text;
    text << std::setprecision(12) << "joint \"" << joint << "\" starts at " << x << ", beyond its "
         << (limit.stop.side > 0 ? "lower" : "upper") << " limit " << bound
         << "; start within its limits (neutral() is), or load the model without limits "
            "(effects)";
    throw ModelError(text.str(), "joint", joint);
  }
}

}  // namespace

void Stepper::Impl::check_overlap() {
  check_limits(scene.model, node.q);
  Depths depths;
  for (int i = 0; i < node.touching; ++i) {
    note(scene.model, pool[node.contacts[i].slot], node.contacts[i].phi, depths);
  }
  const Pair* solid = nullptr;
  for (const int number : node.broad.candidates) {
    const int slot = pool.slot_of(scene.model, number);
    if (pool.solid(slot) == solid) continue;
    solid = pool.solid(slot);
    if (solid == nullptr) continue;
    note(scene.model, *solid, pair_gap(scene.model.tree, node.kin, *solid).phi, depths);
  }
  if (depths.empty()) return;
  throw ModelError("bodies overlap at the start: " + list(depths) +
                   "; move them apart (resolve_overlap does), exclude the two links (add_exclusion "
                   "of a ModelBuilder, <exclude link1=... link2=.../> in a file), or step without "
                   "collisions");
}

/// Rounding of a state that was written with 8 digits is closed by the first arc.
void Stepper::Impl::check_loops() {
  constexpr double rounding = 1e-7;
  const NodeEqualities& loops = node.loops;
  const auto tell = [&](int row, const char* what, double value, const char* unit) {
    const std::string& name = equality_of(scene.model, row).name;
    std::ostringstream text;
    text << "loop \"" << name << "\" " << what << value << unit
         << " at the start; close_loops(model, q) finds the configuration and the velocities "
            "nearest to yours that keep it closed";
    throw ModelError(text.str(), "loop", name);
  };
  const double speed = typical_speed(scene, node) * std::sqrt(scene.total_mass);
  for (int k = 0; k < loops.values.h.size(); ++k) {
    const double h = std::abs(loops.values.h[k]);
    if (!(h <= rounding * loops.values.size[k])) tell(k, "is open by ", h, "");
    const bool is_told = equality_of(scene.model, k).type == LoopType::prescribed;
    if (is_told || loops.kick[k] <= rounding * speed + 1e-12) continue;
    tell(k, "opens at a rate of ", loops.rate[k], " a second");
  }
  const std::string weak = weak_loop();
  if (!weak.empty()) throw ModelError("the start is no good one" + weak + "; start beside it");
}

}  // namespace saltus
