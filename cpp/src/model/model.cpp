#include "saltus/model/model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "saltus/collision/contact.hpp"
#include "saltus/lagrangian/packed_matrix.hpp"
#include "saltus/model/frames.hpp"

namespace saltus {
namespace {

constexpr double most_dense = 134e6;  ///< numbers in 1 GiB

template <class Items>
std::vector<std::string> names_of(const Items& items) {
  std::vector<std::string> names;
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

int index_of(const std::vector<std::string>& names, const std::string& kind,
             const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  throw ModelError("no " + kind + " \"" + name + "\"; there are " + list_names(names), kind, name);
}

void set_by_name(const std::map<std::string, double>& values, const std::string& kind,
                 const std::vector<std::string>& names, VecX& x) {
  for (const auto& [name, value] : values) {
    if (!std::isfinite(value)) {
      throw ModelError(kind + " \"" + name + "\" = " + std::to_string(value) + " is not finite",
                       kind, name);
    }
    x[index_of(names, kind, name)] = value;
  }
}

void check_pair(int pair, const ModelData& model) {
  const int last = model.first_limit + static_cast<int>(model.limits.size());
  if (pair >= 0 && (pair < model.pairs.size() || (model.is_limit(pair) && pair < last))) return;
  throw ModelError("no pair " + std::to_string(pair) + "; the model has " +
                   std::to_string(model.pairs.size()) + ", and limits of joints from " +
                   std::to_string(model.first_limit) + " to " + std::to_string(last - 1));
}

}  // namespace

std::string list_names(const std::vector<std::string>& names) {
  constexpr std::size_t most = 20;
  if (names.empty()) return "none";
  std::string list;
  for (std::size_t i = 0; i < names.size() && i < most; ++i) list += (i ? ", " : "") + names[i];
  if (names.size() > most) list += ", ... (" + std::to_string(names.size()) + " in all)";
  return list;
}

std::string counted(long number, const std::string& noun) {
  std::string text = std::to_string(number) + " " + noun;
  if (number == 1) return text;
  if (text.back() != 'y') return text + "s";
  text.pop_back();
  return text + "ies";
}

void check_vector(const VecRef& x, int n, const std::string& what, const std::string& unit) {
  if (x.size() != n) {
    throw ModelError(what + " has " + counted(x.size(), "entry") + "; the model has " +
                     std::to_string(n) + " " + unit);
  }
  for (int i = 0; i < n; ++i) {
    if (std::isfinite(x[i])) continue;
    std::ostringstream text;
    text << what << "[" << i << "] = " << x[i] << " is not finite";
    throw ModelError(text.str());
  }
}

int Model::coordinate(const std::string& name) const {
  return index_of(names_of(data_->coordinates), "coordinate", name);
}

int Model::velocity_index(const std::string& name) const {
  return index_of(data_->velocity_names, "velocity", name);
}

int Model::link(const std::string& name) const {
  return index_of(names_of(data_->links), "link", name);
}

int Model::joint(const std::string& name) const {
  return index_of(names_of(data_->joints), "joint", name);
}

std::string Model::pair_name(int pair) const {
  check_pair(pair, *data_);
  if (data_->is_limit(pair)) return data_->limit(pair).name;
  return saltus::pair_name(data_->shapes, this->pair(pair));
}

Pair Model::pair(int pair) const {
  check_pair(pair, *data_);
  if (data_->is_limit(pair)) {
    const JointLimit& limit = data_->limit(pair);
    return make_stop(data_->tree, limit.joint, limit.stop);
  }
  const PairTable::Key key = data_->pairs.key(pair);
  return make_pair(data_->tree, data_->shapes, key.a, key.b, key.part);
}

std::map<std::pair<std::string, std::string>, int> Model::pair_kinds() const {
  std::map<std::pair<std::string, std::string>, int> kinds;
  const std::vector<PlacedShape>& shapes = data_->shapes;
  if (data_->pairs.empty()) return kinds;
  for (int i = 0; i < static_cast<int>(shapes.size()); ++i) {
    for (int j = i + 1; j < static_cast<int>(shapes.size()); ++j) {
      const int count = data_->pairs.count(i, j);
      if (count == 0) continue;
      kinds[std::minmax(shape_name(shapes[i].shape), shape_name(shapes[j].shape))] += count;
    }
  }
  return kinds;
}

std::vector<TreeSolution> Model::solvers() const {
  std::vector<TreeSolution> out;
  for (const PackedGroup& group : data_->packed.groups) {
    const TreeSolver solver = group.sweep ? TreeSolver::sweep : TreeSolver::lu;
    out.push_back({solver, group.trees, group.positions, group.depth});
  }
  return out;
}

ContactProperties ModelData::contact_properties(int pair) const {
  if (is_limit(pair)) return {limit(pair).restitution, 0};
  const PairTable::Key key = pairs.key(pair);
  return materials.between(key.a, key.b);
}

ContactProperties Model::contact_properties(int pair) const {
  check_pair(pair, *data_);
  return data_->contact_properties(pair);
}

State Model::state(const std::map<std::string, double>& q, const std::map<std::string, double>& v,
                   double t) const {
  VecX all_q = neutral(), all_v = VecX::Zero(n_v());
  set_by_name(q, "coordinate", names_of(data_->coordinates), all_q);
  set_by_name(v, "velocity", data_->velocity_names, all_v);
  return state(all_q, all_v, t);
}

State Model::state(const VecRef& q, const VecRef& v, double t) const {
  const VecX unit_q = checked_q(q, "q");
  check_vector(v, n_v(), "v", "velocities");
  if (!std::isfinite(t)) throw ModelError("t is not finite");
  return {t, unit_q, momenta(data_->tree, data_->packed, unit_q, v)};
}

VecX Model::velocity(const State& state) const {
  const VecX q = checked_q(state.q, "state.q");
  check_vector(state.p, n_v(), "state.p", "velocities");
  const Tree& tree = data_->tree;
  const PackedTree& packed = data_->packed;
  Packed w(packed);
  PackedMatrix M(tree, packed);
  set_coordinates(tree, packed, q, w);
  place(packed, w);
  mass_pass(packed, w);
  VecX v = state.p;
  if (!factorize(tree, packed, w, 0, M)) {
    throw StepError("the mass matrix is singular at this configuration", state.t, 0, 0);
  }
  solve(tree, packed, M, v);
  return v;
}

LagrangianPartials Model::lagrangian(const VecRef& q, const VecRef& v) const {
  LagrangianPartials out;
  lagrangian(q, v, out);
  return out;
}

void Model::lagrangian(const VecRef& q, const VecRef& v, LagrangianPartials& out) const {
  const VecX unit_q = checked_q(q, "q");
  check_vector(v, n_v(), "v", "velocities");
  const VecX own_v = v;  // it may be a part of `out`
  saltus::lagrangian(data_->tree, data_->packed, unit_q, own_v, out);
}

MatX Model::mass_matrix(const VecRef& q) const {
  return saltus::mass_matrix(data_->tree, data_->packed, checked_q(q, "q"));
}

double Model::kinetic_energy(const State& state) const {
  return 0.5 * state.p.dot(velocity(state));
}

double Model::potential_energy(const VecRef& q) const {
  Packed w(data_->packed);
  set_coordinates(data_->tree, data_->packed, checked_q(q, "q"), w);
  place(data_->packed, w);
  mass_pass(data_->packed, w);
  return saltus::potential_energy(data_->packed, w);
}

Pose Model::X_WL(const VecRef& q, int link) const {
  const AttachedFrame frame = link_frame(*this, link);
  return Frames(*this, q).pose(frame);
}

Gaps Model::gaps(const VecRef& q) const { return Frames(*this, q).gaps(); }

Gaps gaps_at(const Model& model, const Kinematics& kin) {
  const ModelData& m = *model;
  const auto rows = static_cast<Eigen::Index>(m.pairs.size());
  const int n_v = model.n_v();
  if (static_cast<double>(rows) * (n_v + 2.0) * n_v > most_dense) {
    throw ModelError("gaps of " + std::to_string(rows) + " pairs with Hessians of " +
                     std::to_string(n_v) + " velocities take more than 1 GiB; " +
                     "take gap(...) of two shapes at their poses, one by one");
  }
  Gaps out;
  out.phi.resize(rows);
  out.phi_q.setZero(rows, n_v);
  out.phi_qq.assign(static_cast<std::size_t>(rows), MatX::Zero(n_v, n_v));
  out.normal.resize(rows, 3);
  out.p_WA.resize(rows, 3);
  out.p_WB.resize(rows, 3);
  for (int i = 0; i < rows; ++i) {
    const Pair pair = model.pair(i);
    const Gap g = pair_gap(m.tree, kin, pair);
    const bool silent = is_silent(m.tree, kin, pair, g);
    out.names.push_back(saltus::pair_name(m.shapes, pair));
    out.phi[i] = silent ? std::numeric_limits<double>::infinity() : g.phi;
    out.normal.row(i) = g.n_W;
    out.p_WA.row(i) = g.p_WA;
    out.p_WB.row(i) = g.p_WB;
    VecX row = VecX::Zero(n_v);
    if (!silent) add_gap_gradient(m.tree, kin, pair, g, row);
    out.phi_q.row(i) = row;
    if (!silent) add_gap_hessian(m.tree, kin, pair, g, out.phi_qq[i]);
  }
  return out;
}

Model Model::without_collisions() const {
  ModelData copy = *data_;
  copy.pairs = {};
  return Model(std::move(copy));
}

}  // namespace saltus
