// Swept balls; a list of near pairs that is kept while no ball leaves a larger one.
//
// Reference: L. Verlet, Physical Review 159, 98 (1967), for the list. The balls, down the tree,
// with x_j = |ds_j| of joint j, c its origin from its parent's at q:
//
//   turned_j = turned_P + x_j                           (if j turns)
//   moved_j  = moved_P + sway(c) + x_j |slide per unit|
//   sway(c)  = min(turned_G, 2) |c| + min(x_P, 2) |c off P's axis|      G: the parent of P
//
// A ball is one joint, its third, with x the angle that it turns by and any axis; its first two
// are at rest.
//
// sway(c) is the most that the turning of P moves a point c fixed in it: a turn by t moves a unit
// vector by no more than min(t, 2), and P's own turn only what is off its axis.
#include "saltus/collision/broad_phase.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace saltus {
namespace {

constexpr std::size_t most_reserved = 1'000'000;

/// Relative to coordinates in the world; positions are summed over joints with 1e-16 each. Added
/// to every ball so that rounding drops no pair that just touches.
constexpr double rounding = 1e-14;

/// For how many calls near pairs are to serve, if shapes go on as they went.
constexpr double calls_to_serve = 12;

/// Bounds on the skin, of a shape's size: what trembles is not gathered in every call, and what
/// flies not with all that it could meet in many.
constexpr double thinnest = 0.05, thickest = 0.5;

/// Radius of the ball that holds a half-space.
constexpr double plane = std::numeric_limits<double>::infinity();

double change(const Tree& tree, const VecRef& dq, int joint) {
  const Drive& drive = tree.drive[joint];
  const Joint& j = tree.joint[joint];
  if (j.is_ball()) return j.axis == 2 ? dq.segment<3>(drive.velocity - 2).norm() : 0;
  return std::abs(drive.multiplier * dq[drive.velocity]);
}

/// The most a point at `c_W` from joint frame P's origin moves because P turns.
double sway(const Tree& tree, const Kinematics& kin, const VecRef& dq, const BroadPhase& bp, int P,
            const Vec3& c_W) {
  if (P < 0) return 0;
  double own = 0;
  if (tree.joint[P].turns()) {
    const double off =
        tree.joint[P].is_ball() ? c_W.norm() : c_W.cross(kin.joint[P].R.col(2)).norm();
    own = std::fmin(change(tree, dq, P), 2) * off;
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
    bp.motion[i] = j < 0 ? 0 : motion + std::fmin(bp.turned[j], 2) * ball.size;
    // half the margin a ball: margin a pair
    const double radius = ball.size + motion + margin / 2;
    bp.reach[i] = radius + rounding * (bp.center[i].cwiseAbs().maxCoeff() + radius);
    if (!std::isfinite(bp.center[i].sum() + bp.reach[i])) {  // q or dq is not: met by all
      bp.center[i].setZero();
      bp.reach[i] = bp.motion[i] = std::numeric_limits<double>::infinity();
    }
  }
}

/// True while every ball is within the one that it was gathered with.
bool is_gathered(const BroadPhase& bp) {
  return std::all_of(bp.bounded.begin(), bp.bounded.end(), [&](int i) {
    const double room = bp.held_reach[i] - bp.reach[i];
    return room >= 0 && (bp.center[i] - bp.held_center[i]).squaredNorm() <= room * room;
  });
}

void hold_balls(BroadPhase& bp) {
  for (const int i : bp.bounded) {
    const double size = bp.ball[i].size;
    double skin = bp.ball[i].joint < 0 ? 0 : thinnest * size;
    if (skin > 0 && bp.held_reach[i] >= 0) {
      const double went = (bp.center[i] - bp.held_center[i]).norm() / bp.age;
      skin = std::clamp(calls_to_serve * went, skin, thickest * size);
    }
    bp.held_center[i] = bp.center[i];
    bp.held_reach[i] = bp.reach[i] + skin;
    bp.held_reach[i] += rounding * (bp.center[i].cwiseAbs().maxCoeff() + bp.held_reach[i]);
  }
  bp.age = 0;
}

/// A counting sort by the earlier shape, then by the later: the order of the pairs' numbers.
void sort_meetings(BroadPhase& bp) {
  std::fill(bp.row.begin(), bp.row.end(), 0);
  for (const BroadPhase::Meeting& m : bp.met) ++bp.row[m.i + 1];
  std::partial_sum(bp.row.begin(), bp.row.end(), bp.row.begin());
  bp.near.resize(bp.met.size());
  for (const BroadPhase::Meeting& m : bp.met) bp.near[bp.row[m.i]++] = {m.i, m.j, {}};
  auto from = bp.near.begin();
  for (std::size_t i = 0; i + 1 < bp.row.size(); ++i) {  // row[i] is its end now
    const auto to = bp.near.begin() + bp.row[i];
    std::sort(from, to, [](const auto& x, const auto& y) { return x.j < y.j; });
    from = to;
  }
}

/// Writes bp.near: the pairs of all shapes whose held balls overlap, and of all half-spaces.
void gather(const PairTable& pairs, BroadPhase& bp) {
  constexpr int calls = 16;  // a tree stays good for longer than balls stay where they are held
  const auto add = [&](int i, int j) { bp.met.push_back({std::min(i, j), std::max(i, j)}); };
  hold_balls(bp);
  if (bp.calls_left-- == 0) {
    build(bp.bounded, bp.center, bp.tree);
    bp.calls_left = calls - 1;
  }
  refit(bp.held_center, bp.held_reach, bp.tree);
  bp.met.clear();
  for_each_overlap(bp.tree, add);
  for (const int i : bp.unbounded) {
    for (const int j : bp.bounded) add(i, j);
  }
  sort_meetings(bp);
  for (BroadPhase::Near& near : bp.near) near.numbers = pairs.range(near.i, near.j);
  const auto unwatched = [](const BroadPhase::Near& near) { return near.numbers.count == 0; };
  bp.near.erase(std::remove_if(bp.near.begin(), bp.near.end(), unwatched), bp.near.end());
}

/// The planes z = 0 of the half-spaces; they do not move, and add their half of the margin here.
void place_planes(const Tree& tree, const std::vector<PlacedShape>& shapes, const Kinematics& kin,
                  double margin, BroadPhase& bp) {
  for (const int i : bp.unbounded) {
    const Pose X_WG = kin.X_WJ(tree, shapes[i].joint) * shapes[i].X_JG;
    bp.center[i] = X_WG.p;
    bp.normal[i] = X_WG.R.col(2);
    bp.reach[i] = margin / 2 + rounding * X_WG.p.cwiseAbs().maxCoeff();
    bp.motion[i] = shapes[i].joint < 0 ? 0 : plane;  // far out it moves without bound
  }
}

bool meet(const BroadPhase& bp, int i, int j) {
  const double touching = bp.reach[i] + bp.reach[j];
  const Vec3 c = bp.center[j] - bp.center[i];
  if (bp.ball[i].size == plane) return bp.normal[i].dot(c) <= touching;
  if (bp.ball[j].size == plane) return -bp.normal[j].dot(c) <= touching;
  return c.squaredNorm() <= touching * touching;
}

}  // namespace

BroadPhase::BroadPhase(const Tree& model_tree, const std::vector<PlacedShape>& shapes,
                       const PairTable& pairs)
    : center(shapes.size()),
      reach(shapes.size()),
      normal(shapes.size()),
      moved(model_tree.parent.size()),
      turned(model_tree.parent.size()),
      motion(shapes.size()),
      held_center(shapes.size()),
      held_reach(shapes.size()),
      row(shapes.size() + 1) {
  for (int i = 0; i < static_cast<int>(shapes.size()); ++i) {
    ball.push_back({shapes[i].joint, shapes[i].X_JG.p, bounding_radius(shapes[i].shape)});
    if (pairs.is_used(i)) (ball[i].size == plane ? unbounded : bounded).push_back(i);
  }
  candidates.reserve(std::min(static_cast<std::size_t>(pairs.size()), most_reserved));
  const std::size_t n = bounded.size();
  near.reserve(std::min(n * (n + unbounded.size()), most_reserved));
  met.reserve(near.capacity());
  reserve(n, tree);
  start_anew(*this);
}

void find_candidates(const Tree& tree, const std::vector<PlacedShape>& shapes,
                     const PairTable& pairs, const Kinematics& kin, const VecRef& dq, double margin,
                     BroadPhase& bp) {
  bound_joints(tree, kin, dq, bp);
  place_balls(tree, kin, dq, margin, bp);
  place_planes(tree, shapes, kin, margin, bp);
  ++bp.age;
  if (!is_gathered(bp)) gather(pairs, bp);
  bp.candidates.clear();
  for (const BroadPhase::Near& near : bp.near) {
    if (!meet(bp, near.i, near.j)) continue;
    const auto [first, count] = near.numbers;
    for (int k = 0; k < count; ++k) bp.candidates.push_back(first + k);
  }
}

void start_anew(BroadPhase& bp) {
  bp.calls_left = 0;
  std::fill(bp.held_reach.begin(), bp.held_reach.end(), -1);
}

}  // namespace saltus
