// Swept balls, then sweep and prune along the axis of greatest spread.
//
// Reference: C. Ericson, Real-Time Collision Detection, sections 7.5.1-7.5.2 (2005), for the sweep.
// The balls, down the tree, with x_j = |ds_j| of joint j, c its origin from its parent's at q:
//
//   turned_j = turned_P + x_j                           (if j turns)
//   moved_j  = moved_P + sway(c) + x_j |slide per unit|
//   sway(c)  = min(turned_G, 2) |c| + min(x_P, 2) |c off P's axis|      G: the parent of P
//
// sway(c) is the most that the turning of P moves a point c fixed in it: a turn by t moves a unit
// vector by no more than min(t, 2), and P's own turn only what is off its axis.
#include "saltus/collision/broad_phase.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace saltus {
namespace {

constexpr std::size_t most_reserved = 1'000'000;

/// Relative to coordinates in the world; positions are summed over joints with 1e-16 each. Added
/// to every ball so that rounding drops no pair that just touches.
constexpr double rounding = 1e-14;

/// A new axis must spread the shapes this much more, or the order would be sorted anew for little.
constexpr double better_axis = 2;

bool is_unbounded(const PlacedShape& shape) {
  return std::holds_alternative<HalfSpace>(shape.shape);
}

double change(const Tree& tree, const VecRef& dq, int joint) {
  const Drive& drive = tree.drive[joint];
  return std::abs(drive.multiplier * dq[drive.coordinate]);
}

/// The most a point at `c_W` from joint frame P's origin moves because P turns.
double sway(const Tree& tree, const Kinematics& kin, const VecRef& dq, const BroadPhase& bp, int P,
            const Vec3& c_W) {
  if (P < 0) return 0;
  double own = 0;
  if (tree.joint[P].turns()) {
    own = std::fmin(change(tree, dq, P), 2) * c_W.cross(kin.joint[P].R.col(2)).norm();
  }
  const int G = tree.parent[P];
  return own + (G < 0 ? 0 : std::fmin(bp.turned[G], 2) * c_W.norm());
}

void bound_joints(const Tree& tree, const Kinematics& kin, const VecRef& dq, BroadPhase& bp) {
  for (int j = 0; j < tree.joints(); ++j) {
    const int P = tree.parent[j];
    const double x = change(tree, dq, j);
    const Joint& joint = tree.joint[j];
    bp.turned[j] = (P < 0 ? 0 : bp.turned[P]) + (joint.turns() ? x : 0);
    bp.moved[j] = x * (joint.turns() ? std::abs(joint.pitch) : 1);
    if (P < 0) continue;
    bp.moved[j] += bp.moved[P] + sway(tree, kin, dq, bp, P, kin.joint[j].p - kin.joint[P].p);
  }
}

void place_balls(const Tree& tree, const Kinematics& kin, const VecRef& dq, double margin,
                 BroadPhase& bp) {
  for (const int i : bp.bounded) {
    const BroadPhase::Ball& ball = bp.ball[i];
    const int j = ball.joint;
    // most balls sit in their joint's origin: then R need not come from far memory
    const bool turned = j >= 0 && !ball.p_JG.isZero(0);
    const Vec3 c_W = turned ? Vec3(kin.joint[j].R * ball.p_JG) : ball.p_JG;
    bp.center[i] = j < 0 ? c_W : Vec3(kin.origin[tree.root[j]] + kin.joint[j].p + c_W);
    const double motion = j < 0 ? 0 : bp.moved[j] + sway(tree, kin, dq, bp, j, c_W);
    // half the margin a ball: margin a pair
    const double radius = ball.size + motion + margin / 2;
    bp.reach[i] = radius + rounding * (bp.center[i].cwiseAbs().maxCoeff() + radius);
    if (!std::isfinite(bp.center[i].sum() + bp.reach[i])) {  // q or dq is not: met by all
      bp.center[i].setZero();
      bp.reach[i] = std::numeric_limits<double>::infinity();
    }
  }
}

/// Along which the squares of the centres' distances from their mean have the greatest sum.
void choose_axis(BroadPhase& bp) {
  Vec3 mean = Vec3::Zero(), square = Vec3::Zero();
  const double n = static_cast<double>(bp.order.size());
  for (const int i : bp.bounded) mean += bp.center[i] / n;
  for (const int i : bp.bounded) square += (bp.center[i] - mean).cwiseAbs2();
  int best = 0;
  if (square.maxCoeff(&best) > better_axis * square[bp.axis]) bp.axis = best;
}

/// Insertion sort, given up for a full sort where the order has changed too much for it.
void sort_by_lower(BroadPhase& bp) {
  std::vector<int>& order = bp.order;
  const auto before = [&](int i, int j) { return bp.lower[i] < bp.lower[j]; };
  std::size_t moves_left = 8 * order.size();  // about what a full sort costs
  for (std::size_t k = 1; k < order.size(); ++k) {
    const int i = order[k];
    std::size_t hole = k;
    for (; hole > 0 && before(i, order[hole - 1]); --hole) order[hole] = order[hole - 1];
    order[hole] = i;
    if (k - hole > moves_left) return std::sort(order.begin(), order.end(), before);
    moves_left -= k - hole;
  }
}

/// Adds the pairs of two shapes, if there are any.
void add_candidates(const PairTable& pairs, int i, int j, BroadPhase& bp) {
  const int count = pairs.count(i, j);
  if (count == 0) return;
  const int first = pairs.first(i, j);
  for (int k = 0; k < count; ++k) bp.candidates.push_back(first + k);
}

bool balls_meet(const BroadPhase& bp, int i, int j) {
  const double touching = bp.reach[i] + bp.reach[j];
  return (bp.center[i] - bp.center[j]).squaredNorm() <= touching * touching;
}

/// @return false where more balls overlap along the axis than a tree would look at.
bool sweep(const PairTable& pairs, BroadPhase& bp) {
  std::size_t looks_left = 16 * bp.order.size();
  for (std::size_t k = 0; k < bp.order.size(); ++k) {
    const int i = bp.order[k];
    const double upper = bp.center[i][bp.axis] + bp.reach[i];
    for (std::size_t m = k + 1; m < bp.order.size() && bp.lower[bp.order[m]] <= upper; ++m) {
      if (looks_left-- == 0) return false;
      const int j = bp.order[m];
      if (balls_meet(bp, i, j)) add_candidates(pairs, i, j, bp);
    }
  }
  return true;
}

/// The sweep, or where it looks at too many pairs, the tree: for some calls without trying.
void meet_bounded(const PairTable& pairs, BroadPhase& bp) {
  constexpr int calls = 64;
  if (bp.rest > 0) {
    --bp.rest;
  } else {
    choose_axis(bp);
    for (const int i : bp.order) bp.lower[i] = bp.center[i][bp.axis] - bp.reach[i];
    sort_by_lower(bp);
    if (sweep(pairs, bp)) return;
    bp.candidates.clear();
    bp.rest = calls;
    build(bp.order, bp.center, bp.tree);
  }
  refit(bp.center, bp.reach, bp.tree);
  for_each_overlap(bp.tree, [&](int i, int j) { add_candidates(pairs, i, j, bp); });
}

/// Pairs with a half-space z <= 0, which does not move and adds its half of the margin here.
void meet_unbounded(const Tree& tree, const std::vector<PlacedShape>& shapes,
                    const PairTable& pairs, const Kinematics& kin, double margin, BroadPhase& bp) {
  for (const int i : bp.unbounded) {
    const Pose X_WG = kin.X_WJ(tree, shapes[i].joint) * shapes[i].X_JG;
    const double beyond = margin / 2 + rounding * X_WG.p.cwiseAbs().maxCoeff();
    for (const int j : bp.order) {
      const Vec3 c = bp.center[j] - X_WG.p;
      if (X_WG.R.col(2).dot(c) <= bp.reach[j] + beyond) add_candidates(pairs, i, j, bp);
    }
  }
}

}  // namespace

BroadPhase::BroadPhase(const Tree& model_tree, const std::vector<PlacedShape>& shapes,
                       const PairTable& pairs)
    : center(shapes.size()),
      reach(shapes.size()),
      lower(shapes.size()),
      moved(model_tree.parent.size()),
      turned(model_tree.parent.size()) {
  candidates.reserve(std::min(static_cast<std::size_t>(pairs.size()), most_reserved));
  for (int i = 0; i < static_cast<int>(shapes.size()); ++i) {
    ball.push_back({shapes[i].joint, shapes[i].X_JG.p, bounding_radius(shapes[i].shape)});
    if (pairs.is_used(i)) (is_unbounded(shapes[i]) ? unbounded : bounded).push_back(i);
  }
  order = bounded;
  reserve(order.size(), tree);
}

void find_candidates(const Tree& tree, const std::vector<PlacedShape>& shapes,
                     const PairTable& pairs, const Kinematics& kin, const VecRef& dq, double margin,
                     BroadPhase& bp) {
  bp.candidates.clear();
  bound_joints(tree, kin, dq, bp);
  place_balls(tree, kin, dq, margin, bp);
  meet_bounded(pairs, bp);
  meet_unbounded(tree, shapes, pairs, kin, margin, bp);
  std::sort(bp.candidates.begin(), bp.candidates.end());
}

void start_anew(BroadPhase& bp) {
  bp.axis = 0;
  bp.rest = 0;
  bp.order = bp.bounded;
}

}  // namespace saltus
