// What is watched: two shapes, or a part of one and the other, and the joints between them.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "saltus/collision/shapes.hpp"
#include "saltus/tree/tree.hpp"

namespace saltus {

/// One joint between the two bodies of a pair.
struct ChainJoint {
  int joint;
  double sign;  ///< +1 on a's branch, -1 on b's
};

/// A shape and the joint frame that carries it (-1: the world).
struct Placed {
  Shape shape;
  int joint = -1;
  Pose X_JG;  ///< placement in the joint's frame
};

/// A shape of a link.
struct PlacedShape : Placed {
  int link = 0;      ///< index of the link it belongs to
  std::string name;  ///< unique: the link's name, "#k" added where a link has several shapes
  Pose X_LG = {};    ///< in its link's frame
};

// How the gap of a pair is found; see parts.hpp. What is `out` goes out of the shape, in the part's
// frame: of an edge between its two faces, with n.out >= 1 for all n from one's normal to the
// other's; along the axis for a rim and its points; 0 for an axis.

/// The signed distance of two solids.
struct Whole {
  bool skips_corners = false;  ///< corners have gaps of their own: none where one is nearest
};
/// That of a corner or end of a from b.
struct Corner {
  Vec3 out;
};
/// That of two edges, where they cross; nothing where they do not.
struct Crossing {
  Vec3 out_a, out_b;
};
/// That of a rim of a cylinder, which is a disc, from all of b.
struct Rim {
  Vec3 out;
  bool lists_edges = false;  ///< those of the two shapes have gaps of their own where they cross
};
/// That of the rims of a cylinder, which is all of a, and an edge or the rims of b, at one place.
struct RimCrossing {
  enum class Place {
    in,     ///< where an edge goes in over a rim: seen along its own axis
    out,    ///< where it comes out
    left,   ///< where two rims cross that lie flat on each other: one place
    right,  ///< and the other
  };
  Place place;
  Vec3 out_b;
};
using PartKind = std::variant<Whole, Corner, Crossing, Rim, RimCrossing>;

/// What a kind is to a step: whether one has a gap everywhere, how it is held.
enum class PairKind { whole, corner, crossing };

inline bool operator==(const PartKind& kind, PairKind other) {
  constexpr PairKind kinds[] = {PairKind::whole, PairKind::corner, PairKind::crossing,
                                PairKind::whole, PairKind::crossing};
  return kinds[kind.index()] == other;
}

/// A stop of a joint, in place of shapes: phi = side (s - bound) of its displacement s.
struct Stop {
  int side = 0;      ///< +1 a lower, -1 an upper limit; 0: the pair is of shapes
  double bound = 0;  ///< [rad | m]
};

/// epsilon_phi by the size of the smaller shape: far above the rounding of positions (1e-16 of the
/// scene) and far below what anybody can see.
inline constexpr double relative_touch = 1e-10;

/// One gap that is watched: two shapes, or a part of one and the other, or a stop.
struct Pair {
  int a = -1, b = -1;  ///< indices of shapes; -1 of a stop
  Stop stop;
  int part = 0;  ///< which of the gaps of these two shapes
  PartKind kind;
  Placed on_a, on_b;         ///< the parts that face each other; b alone may be a half-space
  std::vector<Vec3> inward;  ///< corner, rim: along the edges that meet in it, in its frame; none
                             ///< where it is round or the other has no flat faces
  std::vector<ChainJoint> chain;  ///< from b to a: nearest to b first
  double touch = 0;               ///< [m] epsilon_phi: |phi| below this is touching

  bool is_stop() const { return stop.side != 0; }
};

/// The stop of a one-degree joint of the tree; phi has the unit of its displacement.
SALTUS_EXPORT Pair make_stop(const Tree& tree, int joint, const Stop& stop);

/// Joints between two joint frames (-1: the world), ordered from b to a.
SALTUS_EXPORT std::vector<ChainJoint> chain_between(const Tree& tree, int joint_b, int joint_a);

}  // namespace saltus
