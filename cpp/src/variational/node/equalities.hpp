// Loops at a node: they hold h(q, t) = 0 and A^T v = drive there.
//
// All rates of contacts and all impulses are in the metric of what the loops leave free,
// M_N^-1 = M^-1 - M^-1 A (A^T M^-1 A)^+ A^T M^-1 (theory, F6): columns M^-1 n become M_N^-1 n by
// `hold`, and momenta are those with A^T M^-1 p = 0.
#pragma once

#include "saltus/constraint/equality_solver.hpp"
#include "saltus/model/model.hpp"

namespace saltus {

struct Node;
struct Scene;
struct ContactVector;

/// Written by set_velocity_at_node.
struct NodeEqualities {
  NodeEqualities() = default;
  explicit NodeEqualities(const ModelData& model);
  bool some = false;      ///< the model has loops; all below is empty where not
  EqualityValues values;  ///< at the node's q
  EqualitySolver solver;  ///< of M and A there
  /// (m) What p was away from momenta that keep the loops closed: rate that had to be taken out,
  /// and the root of twice the energy that went with it [sqrt J].
  VecX rate, kick;
  VecX impulse;             ///< (m) what they pushed there: what `p` has gained along A
  std::vector<char> still;  ///< (dry) joints that the loops let not move
};

/// Holds loops at a node whose M is factored, p and v = M^-1 p written.
/// @return false where the rank of the loops changes
bool hold_loops(const Scene& scene, Node& node);

/// True where no impulse along the row moves anything: loops, or what is told, hold it. Needs the
/// node's factors; writes node.column.
bool is_held_by_loops(const Scene& scene, const ContactVector& row, Node& node);
void note_still_joints(const Scene& scene, Node& node);

/// The same of a v = M^-1 p that impulses have changed since: changes p and v.
void hold_velocity(Node& node);

/// The same of a p that impulses have changed, where v has been held all along.
void take_momentum(const Scene& scene, Node& node);

/// The nearest q with h(q, t) = 0, in the metric of the node's M, from one that is near it: where
/// an arc's end was found by velocities alone. Needs the node's factors; writes poses and loops of
/// `scratch`.
/// @return false where there is none near
bool close_near(const Scene& scene, const Node& node, double t, VecX& q, Node& scratch);

}  // namespace saltus
