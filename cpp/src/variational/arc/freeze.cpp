#include "variational/arc/freeze.hpp"

#include "saltus/collision/slip.hpp"

namespace saltus {
namespace {

bool is_sharp(const Pair& pair) {
  return !pair.inward.empty() && !std::holds_alternative<HalfSpace>(pair.on_b.shape);
}

/// An end of a rod on a solid with faces.
bool is_rod_end(const ModelData& model, const Pair& pair) {
  return pair.kind == PairKind::corner &&
         std::holds_alternative<Capsule>(model.shapes[pair.a].shape) &&
         (std::holds_alternative<Box>(pair.on_b.shape) ||
          std::holds_alternative<Convex>(pair.on_b.shape));
}

/// True where the rod of an end rests on an edge of the same solid already.
bool rests_on_edge(int end, const Node& node) {
  for (int i = 0; i < node.touching; ++i) {
    const Contact& c = node.contacts[i];
    if (c.motion == Contact::Motion::rests && node.pool[c.slot].kind == PairKind::crossing &&
        node.pool.solid(c.slot) == node.pool.solid(end)) {
      return true;
    }
  }
  return false;
}

bool is_rolling_rim(const Row& row) {
  return std::holds_alternative<Rim>(row.pair->kind) && !row.is_point;
}

/// An edge of a solid with faces that crosses another's, at a point that has no size.
bool is_sharp_crossing(const Pair& pair) {
  const auto is_line = [](const Shape& shape) {
    const auto* edge = std::get_if<Capsule>(&shape);
    return edge != nullptr && !(edge->radius > 0);
  };
  return std::holds_alternative<Crossing>(pair.kind) && is_line(pair.on_a.shape) &&
         is_line(pair.on_b.shape);
}

/// sin of the angle between two edges below which they lie along each other: where they cross then
/// is anywhere on them after a little turn, and the normal there any that is across.
constexpr double nearly_parallel = 0.1;

bool lie_along(const ModelData& model, const Node& node, const Pair& pair) {
  const Mat3 R_a = node.kin.X_WJ(model.tree, pair.on_a.joint).R * pair.on_a.X_JG.R;
  const Mat3 R_b = node.kin.X_WJ(model.tree, pair.on_b.joint).R * pair.on_b.X_JG.R;
  return R_a.col(2).cross(R_b.col(2)).norm() < nearly_parallel;
}

Vec3 in_frame(const Pose& X_WJ, const Vec3& p_W) { return X_WJ.R.transpose() * (p_W - X_WJ.p); }

/// Where it touches at the node, in the frame of a's joint.
Vec3 start_on_a(const ModelData& model, const Node& node, const Row& row) {
  const Contact& c = contact_of(node, row);
  return in_frame(node.kin.X_WJ(model.tree, row.pair->on_a.joint), c.p_WB + c.phi * c.n_W);
}

/// Holds a rim at the point that touches at the node.
void freeze_point(const ModelData& model, const Node& node, Row& row) {
  freeze(model, node, row);
  row.is_point = true;
  row.frozen.on_a.shape = Sphere{0};
  row.frozen.on_a.X_JG = Pose{Mat3::Identity(), start_on_a(model, node, row)};
}

}  // namespace

bool is_held_in_plane(const ModelData& model, const Row& row, const Node& node) {
  return is_sharp(*row.pair) || (is_rod_end(model, *row.pair) && rests_on_edge(row.slot, node));
}

void hold_edges(const ModelData& model, const Node& node, Row& row) {
  if (is_sharp_crossing(*row.pair) && lie_along(model, node, *row.pair)) {
    freeze_point(model, node, row);
  }
}

bool is_held_crossing(const ModelData& model, const Row& row, const Node& node) {
  return row.is_point && std::holds_alternative<Crossing>(row.pair->kind) &&
         !lie_along(model, node, *row.pair);
}

void freeze(const ModelData& model, const Node& node, Row& row) {
  const Contact& contact = contact_of(node, row);
  const Pair& pair = *row.pair;
  row.is_frozen = true;
  row.is_point = !pair.inward.empty() && std::holds_alternative<Sphere>(pair.on_a.shape);
  row.frozen.kind = Whole{};
  row.frozen.on_a = pair.on_a;
  row.frozen.on_b.joint = pair.on_b.joint;
  row.frozen.chain = pair.chain;  // no allocation: room for the deepest is reserved
  row.frozen.touch = pair.touch;
  put_plane_on_b(model.tree, node.kin, contact.p_WB, contact.n_W, row.frozen);
  const Pose X_WJ = node.kin.X_WJ(model.tree, pair.on_b.joint);
  row.point_B = X_WJ.R.transpose() * (contact.p_WB - X_WJ.p);
  for (int k = 0; k < 2 && contact.friction > 0; ++k) {
    row.t_B[k] = X_WJ.R.transpose() * contact.t_W[k];
  }
}

bool level_rods(const Scene& scene, const VecX& q_end, const Node& node, Rows& rows,
                ArcScratch& s) {
  bool changed = false;
  for (int i = 0; i < rows.count; ++i) {
    Row& row = rows.row[i];
    if (row.is_joint() || row.is_frozen || !is_rod_end(scene.model, *row.pair)) continue;
    place_end(scene.model, q_end, s);
    const Gap whole = pair_gap_at_end(scene.model, *node.pool.solid(row.slot), s);
    if (whole.phi >= floor_of(node, row.slot)) continue;
    freeze(scene.model, node, row);
    changed = true;
  }
  return changed;
}

bool level_held_ends(const Scene& scene, const Node& node, Rows& rows) {
  bool changed = false;
  for (int i = 0; i < rows.count; ++i) {
    Row& row = rows.row[i];
    if (row.is_joint() || !row.is_active) continue;
    const bool turns = !row.is_frozen && is_sharp_crossing(*row.pair);
    if (turns || is_rolling_rim(row)) {
      freeze_point(scene.model, node, row);
    } else if (!row.is_frozen && is_rod_end(scene.model, *row.pair)) {
      freeze(scene.model, node, row);
    } else {
      continue;
    }
    changed = true;
  }
  return changed;
}

bool hold_rims_at_points(const Scene& scene, const VecX& q_end, const Node& node, Rows& rows,
                         ArcScratch& s) {
  const Tree& tree = scene.model.tree;
  bool changed = false, placed = false;
  for (const int i : rows.active) {
    Row& row = rows.row[i];
    if (row.is_joint() || !is_rolling_rim(row)) continue;
    if (!placed) place_end(scene.model, q_end, s);
    placed = true;
    const Gap g = pair_gap_at_end(scene.model, row.watched(), s);
    const Vec3 middle = row.pair->on_a.X_JG.p;
    const Vec3 end = in_frame(s.kin_end.X_WJ(tree, row.pair->on_a.joint), g.p_WA);
    if ((end - middle).dot(start_on_a(scene.model, node, row) - middle) > 0) continue;
    freeze_point(scene.model, node, row);
    changed = true;
  }
  return changed;
}

}  // namespace saltus
