// The kinds of gap of two shapes: overloads, each in the kind's own file.
#pragma once

#include "collision/shapes/facts.hpp"
#include "saltus/collision/gap.hpp"
#include "saltus/collision/pair.hpp"

namespace saltus {

/// Faces that lie on one another, or on an edge, may be this far from parallel [rad].
inline constexpr double tilt = 1e-3;

/// [pair.touch] Edges that are farther on the wrong side of each other, by a hundredth of the
/// smaller shape, are on the far sides of both.
inline constexpr double deepest = 1e8;

/// Of the greatest angle between a cap and an edge, or another cap, that it lies flat on: while one
/// place bears, the other is not missed as they come down on each other. Its sine is 0.1.
inline constexpr double cosine_flat = 0.99498743710662;

/// Below this sine of an edge and a rim's tangent the two places are near to one: the rim as a
/// whole has it.
inline constexpr double along_rim = 0.05;

/// The parts that face each other, and the kind of their gap.
struct Parts {
  PartOfShape a, b;
  PartKind kind;
};

inline PartOfShape all_of(const Shape& shape, const std::string& name = "") {
  return {name, shape};
}

// The gap number k of this kind: of a part of a, against b.
Parts corner_parts(const Shape& a, const Shape& b, int k);
Parts crossing_parts(const Shape& a, const Shape& b, int k);
Parts rim_parts(const Shape& a, const Shape& b, int k);
/// Edge k / 2 of b over the rims of a: where it goes in, or comes out.
Parts edge_over_rim_parts(const Shape& a, const Shape& b, int k);
/// Where the rims of two cylinders cross.
Parts rim_over_rim_parts(const Shape& a, const Shape& b, int k);

// As part_gap.
Gap gap_of(const Whole&, const Pair& pair, const Pose& X_WA, const Pose& X_WB, const Vec3&);
Gap gap_of(const Corner&, const Pair& pair, const Pose& X_WA, const Pose& X_WB,
           const Vec3& motion_W);
Gap gap_of(const Crossing& at, const Pair& pair, const Pose& X_WA, const Pose& X_WB, const Vec3&);
Gap gap_of(const Rim& rim, const Pair& pair, const Pose& X_WA, const Pose& X_WB, const Vec3&);
Gap gap_of(const RimCrossing&, const Pair& pair, const Pose& X_WA, const Pose& X_WB, const Vec3&);

// As is_silent.
bool silent(const Whole& whole, const Pair& pair, const Pose&, const Pose&, const Gap& gap);
bool silent(const Corner&, const Pair&, const Pose& X_WA, const Pose& X_WB, const Gap& gap);
bool silent(const Crossing&, const Pair&, const Pose& X_WA, const Pose& X_WB, const Gap& gap);
bool silent(const Rim&, const Pair&, const Pose& X_WA, const Pose& X_WB, const Gap& gap);
bool silent(const RimCrossing&, const Pair&, const Pose& X_WA, const Pose& X_WB, const Gap& gap);

/// False where it is always heard, which saves the poses.
bool may_be_silent(const Pair& pair);

/// True where the body of a corner or rim goes on below a plane through it across n_A.
bool goes_below(const Pair& pair, const Vec3& n_A);

/// False where it is beyond the ends of an edge b (its axis), by its witness.
bool is_within_ends(const Shape& edge, const Pose& X_WE, const Vec3& p_W);

/// True where n, which is across an edge, is from one of its faces' normals to the other's; `out_W`
/// as in Pair.
bool is_in_cone(const Vec3& n_W, const Vec3& out_W);

/// [m] At most the distance of the two shapes of a crossing, at little cost: of the ball round a
/// cylinder from the other. Minus infinity where neither is one.
double distance_around_cylinder(const Pair& pair, const Pose& X_WA, const Pose& X_WB);

/// True where an edge, or a rim, crosses the rim of `pair` no farther off than its gap.
bool is_rim_crossed(const Rim& rim, const Pair& pair, bool by_rim, const Pose& X_WA,
                    const Pose& X_WB, const Gap& gap);

/// The part of a pair that moves with a body and is near its place here: the half of the edge on
/// that side, or a line across the cap. False where there is none.
struct NearRim {
  bool of_a;  ///< it stands for a part of a; else of b
  Placed part;
};
bool near_rim(const RimCrossing& at, const Pair& pair, const Pose& X_BA, NearRim& out);

}  // namespace saltus
