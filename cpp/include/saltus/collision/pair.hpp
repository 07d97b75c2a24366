// What is watched: two shapes, or a part of one and the other, and the joints between them.
#pragma once

#include <string>
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
};

/// How the gap of a pair is found; see parts.hpp.
enum class PairKind {
  whole,     ///< the signed distance of two solids
  corner,    ///< that of a corner or end of one of them, which is a, from the other
  crossing,  ///< that of two edges, where they cross; nothing where they do not
};

/// Which place of a cylinder's rims a part is about.
enum class RimPart {
  none,
  nearest,  ///< of one rim, against all of the other shape
  in,       ///< where an edge goes in over a rim: seen along its own axis
  out,      ///< where it comes out
  left,     ///< where two rims cross that lie flat on each other: one place
  right,    ///< and the other
};

/// epsilon_phi by the size of the smaller shape: far above the rounding of positions (1e-16 of the
/// scene) and far below what anybody can see.
inline constexpr double relative_touch = 1e-10;

/// One gap that is watched: two shapes, or a part of one and the other.
struct Pair {
  int a = -1, b = -1;  ///< indices of shapes
  int part = 0;        ///< which of the gaps of these two shapes
  PairKind kind = PairKind::whole;
  Placed on_a, on_b;            ///< the parts that face each other; b alone may be a half-space
  RimPart rim = RimPart::none;  ///< not none: a is the cylinder
  /// Out of the shape, in the part's frame: of an edge between its two faces, with n.out >= 1 for
  /// all n from one's normal to the other's; along the axis for a rim
  /// and its points; 0 for an axis.
  Vec3 out_a = Vec3::Zero(), out_b = Vec3::Zero();
  std::vector<Vec3> inward;    ///< corner, rim: along the edges that meet in it, in its frame; none
                               ///< where it is round or the other has no flat faces
  bool lists_edges = false;    ///< those of the two shapes have gaps of their own where they cross
  bool skips_corners = false;  ///< corners have gaps of their own: none where one is nearest
  std::vector<ChainJoint> chain;  ///< from b to a: nearest to b first
  double touch = 0;               ///< [m] epsilon_phi: |phi| below this is touching
};

/// Joints between two joint frames (-1: the world), ordered from b to a.
SALTUS_EXPORT std::vector<ChainJoint> chain_between(const Tree& tree, int joint_b, int joint_a);

}  // namespace saltus
