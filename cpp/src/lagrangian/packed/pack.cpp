// Which joint goes to which slot, and the constants of each slot.
#include <algorithm>
#include <map>

#include "lagrangian/packed/lane.hpp"
#include "lagrangian/packed/potentials.hpp"

namespace saltus {
namespace {

// Measured: elimination costs about 10 ns a pair of joints on a branch (7 ns in lanes of equal
// trees), the sweep 75 ns a joint (it has no lanes).
bool prefers_sweep(const std::vector<int>& level, bool in_lanes) {
  long pairs = 0;  // without the joints themselves
  for (const int each : level) pairs += each;
  return pairs > (in_lanes ? 10 : 7) * static_cast<long>(level.size());
}

/// The joints of one tree in preorder, and what must be equal for trees to share lanes.
struct Shape {
  std::vector<int> joints, parent, level;
  std::vector<int> reference_path, balls;
  bool branched = false;
  int depth = 0;

  std::vector<int> key() const {
    std::vector<int> out = parent;
    out.push_back(-2);
    out.insert(out.end(), reference_path.begin(), reference_path.end());
    out.push_back(-2);
    out.insert(out.end(), balls.begin(), balls.end());
    return out;
  }
};

/// Children of every joint; those of the world are at the end. Descending, for a stack.
std::vector<std::vector<int>> children_of(const Tree& tree) {
  const std::size_t n = tree.parent.size();
  std::vector<std::vector<int>> children(n + 1);
  for (int i = tree.joints() - 1; i >= 0; --i) {
    const int parent = tree.parent[i];
    children[parent < 0 ? n : static_cast<std::size_t>(parent)].push_back(i);
  }
  return children;
}

Shape shape_of(const Tree& tree, const std::vector<std::vector<int>>& children, int root,
               std::vector<int>& position) {
  Shape shape;
  std::vector<int> stack{root};
  while (!stack.empty()) {
    const int i = stack.back();
    stack.pop_back();
    const int k = static_cast<int>(shape.joints.size());
    const int parent = i == root ? -1 : position[tree.parent[i]];
    position[i] = k;
    shape.joints.push_back(i);
    shape.parent.push_back(parent);
    shape.level.push_back(parent < 0 ? 0 : shape.level[parent] + 1);
    shape.depth = std::max(shape.depth, shape.level.back() + 1);
    shape.branched = shape.branched || parent != k - 1;
    if (tree.joint[i].is_ball() && tree.joint[i].axis == 0) shape.balls.push_back(k);
    stack.insert(stack.end(), children[i].begin(), children[i].end());
  }
  for (int i = tree.reference[root]; i >= 0; i = tree.parent[i]) {
    shape.reference_path.push_back(position[i]);
  }
  return shape;
}

PackedGroup group_of(const Shape& shape, int trees, int first, TreeSolver solver) {
  PackedGroup g;
  g.first = first;
  g.positions = static_cast<int>(shape.joints.size());
  g.trees = trees;
  g.width = trees == 1 ? 1 : (trees + lanes - 1) / lanes * lanes;
  g.branched = shape.branched;
  g.depth = shape.depth;
  g.sweep = solver == TreeSolver::sweep ||
            (solver == TreeSolver::automatic && prefers_sweep(shape.level, trees > 1));
  g.parent = shape.parent;
  g.level = shape.level;
  g.reference_path = shape.reference_path;
  g.balls = shape.balls;
  g.placed.assign(g.parent.size(), 0);
  for (const int k : g.reference_path) g.placed[k] = 1;
  for (const int k : g.balls) g.placed[k + 1] = g.placed[k + 2] = g.placed[k];
  g.row.resize(g.parent.size());
  return g;
}

/// The trees, equal ones together, in order of the first of each; those that the sweep solves stay
/// alone, since it has no lanes.
std::vector<std::vector<Shape>> sort_trees(const Tree& tree, TreeSolver solver) {
  const auto children = children_of(tree);
  std::vector<int> position(tree.parent.size());
  std::vector<std::vector<Shape>> sorted;
  std::map<std::vector<int>, std::size_t> place_of;
  const auto& roots = children.back();
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) {
    Shape shape = shape_of(tree, children, *root, position);
    const bool alone = solver == TreeSolver::sweep ||
                       (solver == TreeSolver::automatic && prefers_sweep(shape.level, true));
    if (alone) {
      sorted.push_back({std::move(shape)});
      continue;
    }
    const auto [at_key, is_new] = place_of.try_emplace(shape.key(), sorted.size());
    if (is_new) sorted.emplace_back();
    sorted[at_key->second].push_back(std::move(shape));
  }
  return sorted;
}

void set_rows(bool sweep, PackedTree& t) {
  for (PackedGroup& g : t.groups) {
    if (g.sweep != sweep) continue;
    for (int k = 0; k < g.positions; ++k) {
      g.row[k] = t.row_blocks;
      const int entries = (g.level[k] + 1) * g.width;
      t.row_blocks += (entries + lanes - 1) / lanes;
    }
  }
}

void set_constants(const Tree& tree, const MassModel& mass, int i, PackedTree& t) {
  const int slot = t.slot[i];
  const Pose& X = tree.X_PJ[i];
  double* to = at(t.X, slot);
  for (int c = 0; c < 9; ++c) to[c * lanes] = X.R(c % 3, c / 3);
  for (int c = 0; c < 3; ++c) to[(9 + c) * lanes] = X.p[c];
  const Joint& joint = tree.joint[i];
  at(t.kind, slot)[0] = joint.turns() ? 1 : 0;
  at(t.kind, slot)[lanes] = joint.turns() ? joint.pitch : 1;
  const BodyInertia& body = mass.body[i];
  const Mat3& I = body.I_J;
  // a massless body has no inertia, whatever is written for it
  const double has = body.mass == 0 ? 0 : 1;
  const double numbers[] = {body.mass,     body.c_J.x(),  body.c_J.y(),  body.c_J.z(),
                            has * I(0, 0), has * I(0, 1), has * I(0, 2), has * I(1, 1),
                            has * I(1, 2), has * I(2, 2)};
  for (int c = 0; c < 10; ++c) at(t.body, slot)[c * lanes] = numbers[c];
  *at(t.weight, slot) = body.mass;
}

/// What coordinates have of their own.
void set_own(const Tree& tree, const MassModel& mass, PackedTree& t) {
  t.slot_of_velocity.assign(static_cast<std::size_t>(tree.n_v), -1);
  for (int i = 0; i < tree.joints(); ++i) {
    const Drive& drive = tree.drive[i];
    if (drive.multiplier == 1 && drive.offset == 0 && t.slot_of_velocity[drive.velocity] < 0) {
      t.slot_of_velocity[drive.velocity] = t.slot[i];
    }
  }
  const VecX* const parts[] = {&mass.armature, &mass.stiffness, &mass.rest};
  for (int part = 0; part < 3; ++part) {
    if (parts[part]->size() == 0 || parts[part]->isZero(0)) continue;
    if (t.own.empty()) t.own.resize(static_cast<std::size_t>(t.slots / lanes));
    for (int c = 0; c < tree.n_v; ++c) {
      at(t.own, t.slot_of_velocity[c])[part * lanes] = (*parts[part])[c];
    }
  }
}

/// R of the placements in the world's axes, where nothing turns above.
void place_in_world(const PackedGroup& g, PackedTree& t) {
  for (int k = 1; k < g.positions; ++k) {
    for (int lane = 0; lane < g.trees && g.placed[k]; ++lane) {
      double* X = at(t.X, g.slot(k) + lane);
      packed::store(X, 0,
                    packed::load9(at(t.X, g.slot(g.parent[k]) + lane), 0) * packed::load9(X, 0));
    }
  }
}

}  // namespace

PackedTree pack(const Tree& tree, const MassModel& mass, TreeSolver solver) {
  PackedTree t;
  t.one_to_one = tree.one_to_one;
  t.gravity = mass.gravity;
  const std::vector<std::vector<Shape>> sorted = sort_trees(tree, solver);
  t.slot.resize(tree.parent.size());
  t.tree.resize(tree.parent.size());
  for (const std::vector<Shape>& equal : sorted) {
    const PackedGroup g = group_of(equal.front(), static_cast<int>(equal.size()), t.slots, solver);
    for (std::size_t lane = 0; lane < equal.size(); ++lane) {
      for (int k = 0; k < g.positions; ++k) {
        t.slot[equal[lane].joints[k]] = g.slot(k) + static_cast<int>(lane);
        t.tree[equal[lane].joints[k]] = static_cast<int>(t.trees.size());
      }
      t.trees.push_back({static_cast<int>(t.groups.size()), static_cast<int>(lane)});
    }
    t.slots += (g.positions * g.width + lanes - 1) / lanes * lanes;
    t.groups.push_back(g);
  }
  t.joint.assign(static_cast<std::size_t>(t.slots), -1);
  for (int i = 0; i < tree.joints(); ++i) t.joint[t.slot[i]] = i;
  for (int i = 0; i < tree.joints() && tree.one_to_one; ++i) {
    if (!tree.joint[i].is_ball()) t.displacements.push_back({t.slot[i], tree.coordinate[i]});
  }
  for (const Ball& ball : tree.balls) {
    const int* slot = &t.slot[ball.joint];
    t.balls.push_back({{slot[0], slot[1], slot[2]}, ball.velocity, ball.coordinate});
  }
  set_rows(false, t);
  t.lu_row_blocks = t.row_blocks;
  set_rows(true, t);

  const std::size_t blocks = static_cast<std::size_t>(t.slots / lanes);
  t.X.resize(blocks);
  t.kind.resize(blocks);
  t.body.resize(blocks);
  t.weight.resize(blocks);
  for (auto& block : t.X) {
    for (const int c : {0, 4, 8}) std::fill_n(block.x[c], lanes, 1.0);
  }
  for (int i = 0; i < tree.joints(); ++i) set_constants(tree, mass, i, t);
  set_own(tree, mass, t);
  for (const PackedGroup& g : t.groups) {
    packed::add_up<1>(g, t.weight, 0);
    place_in_world(g, t);
  }
  packed::set_potentials(tree, mass.potentials, t);
  return t;
}

}  // namespace saltus
