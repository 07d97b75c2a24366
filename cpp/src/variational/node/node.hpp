// A node: the point (t, q, p) where arcs meet, and what touches there.
//
// Theory, section 6. A pair touches when |phi| <= pair.touch, or when it would close within
// epsilon_t h. Touching pairs approach (u < -epsilon_u: they collide here and now), leave
// (u > epsilon_u) or rest. epsilon_u = rest (sqrt(2 T / m) + h |g| + sum_k |phi_q[k] v_k|): a part
// of the speeds that there are, so that rounding is no impact.
//
// Written by this room; p and v also by an impact and by the half kick that closes an arc, both
// through `apply` (delassus.hpp) or with set_velocity_at_node. A flight reads it.
#pragma once

#include <array>
#include <vector>

#include "saltus/collision/broad_phase.hpp"
#include "saltus/lagrangian/packed_matrix.hpp"
#include "saltus/variational/report.hpp"
#include "variational/node/clearances.hpp"
#include "variational/node/contact_vector.hpp"
#include "variational/node/equalities.hpp"
#include "variational/node/pair_pool.hpp"
#include "variational/node/scene.hpp"

namespace saltus {

struct Contact {
  enum class Motion { approaches, rests, leaves };
  int slot = -1;         ///< its pair's in the pool
  double phi = 0;        ///< [m]
  double u = 0;          ///< [m/s] gap rate
  double epsilon_u = 0;  ///< [m/s]
  Motion motion = Motion::rests;
  double restitution = 1, friction = 0;
  double bound = 0;      ///< [N s] above 0: no contact but a joint with dry friction, |p| <= bound
  Vec3 n_W;              ///< from b to a
  Vec3 p_WB, point_W;    ///< [m] witness on b; where the two touch, see contact_point
  ContactVector n;       ///< phi_q
  ContactVector column;  ///< M^-1 n, written where W is
  // where friction > 0
  std::array<Vec3, 2> t_W;                   ///< tangents t0, t1
  std::array<ContactVector, 2> t, t_column;  ///< the rows T along them, slip.hpp; M^-1 T

  int rates() const { return friction > 0 ? 3 : 1; }
  /// Row or column k: n, t0, t1.
  const ContactVector& row(int k) const { return k == 0 ? n : t[k - 1]; }
  const ContactVector& response(int k) const { return k == 0 ? column : t_column[k - 1]; }
};

struct Node {
  Node(const Scene& scene, PairPool& pool);

  double t = 0;
  VecX q, p, v;  ///< v = M^-1 p where has_factors; else that of the arc that ended here
  PairPool& pool;
  std::vector<Contact> contacts;  ///< a pool; the first `touching` are valid
  int touching = 0;
  /// Joints with dry friction, as rows of one rate v_c; whoever lists one writes its bound.
  std::vector<Contact> dry;
  std::vector<double> dry_force;  ///< (dry) [N m | N]
  std::vector<int> contact_of;    ///< (pool) index in contacts, or -1
  std::vector<double> sunk;  ///< (pool) [m] phi of a pair that is silent here; else 0. Edges that
                             ///< meet at their ends, which corners watch: minus infinity
  std::vector<int> silent;   ///< slots with an entry in `sunk`
  Packed w;                  ///< frames at q
  Kinematics kin;
  PackedMatrix M;
  bool has_factors = false;  ///< M is that of q
  NodeEqualities loops;

  int driven_together = -1;  ///< slot of a pair that loops, or what is told, close; or -1

  Clearances clearances;

  // scratch
  BroadPhase broad;
  VecX dq, column;
  VecX dense;  ///< (n_v) zero between uses

  /// Index of the contact of a slot, or -1; also of one that the pool has got since.
  int contact_at(int slot) const {
    return slot < static_cast<int>(contact_of.size()) ? contact_of[slot] : -1;
  }
  /// Loops let joint dry[k] not move.
  bool is_still(std::size_t k) const { return loops.some && loops.still[k] != 0; }
  double sunk_at(int slot) const { return slot < static_cast<int>(sunk.size()) ? sunk[slot] : 0; }
};

/// Those of the scene's joints with dry friction.
void add_dry_joints(const Scene& scene, Node& node);

/// With room for the rows of any pair.
Contact fresh_contact(const Scene& scene);

Contact::Motion motion_of(double u, double epsilon_u);

/// Writes the contact of the pair at `slot`, with gap `g` and rows of the pair `as`. Needs v.
/// @param dense (n_v) scratch, zero between uses
void write_contact(const Scene& scene, double speed, int slot, const Pair& as, const Gap& g,
                   const Node& node, VecX& dense, Contact& c);

/// Restitution and friction of a pair.
ContactProperties properties_of(const Scene& scene, int slot, const Node& node);

/// M and v = M^-1 p at the node; loops take out of p and v what would open them.
/// @return false where the mass matrix is singular, or the rank of the loops changes
bool set_velocity_at_node(const Scene& scene, Node& node);

/// [m] Of the origins of the pair's two bodies, for PairPool::know_ulps.
double largest_coordinate(const Scene& scene, const Pair& pair, const Node& node);

/// [m] No pair's touch is larger at the node.
double most_touch(const Scene& scene, const Node& node);

/// Frames at q.
void place_frames(const Scene& scene, Node& node);

/// Puts the node there. M and v stay those of before.
void place_node(const Scene& scene, double t, const VecX& q, const VecX& p, Node& node);

/// Puts the node at the end of an arc that starts where it is.
/// @param motion (shapes) [m] how far any point of a shape moves in it, at most
/// @param placed frames that `place` put there, to be exchanged for others; nullptr: there are none
void move_node(const Scene& scene, double t, const VecX& q, const VecX& p,
               const std::vector<double>& motion, Packed* placed, Node& node);

/// Writes contacts (motion included), and v where pairs are near.
/// @return false where the mass matrix is singular.
bool find_contacts(const Scene& scene, Node& node);

/// Writes u, epsilon_u and motion from n and the node's v. Needs typical_speed.
void classify(const Scene& scene, const Node& node, double speed, Contact& c);

/// u and motion of all contacts, where v has changed.
void refresh_motions(const Scene& scene, Node& node);

/// [m] The deepest overlap, or 0.
double lowest_gap(const Node& node);

/// True where some touching pair approaches.
bool has_approach(const Node& node);

/// True where some pair that touches has friction.
bool has_friction(const Node& node);

/// A speed of the whole model, [m/s].
double typical_speed(const Scene& scene, const Node& node);

/// The gap below which a pair that rests at the node is pressed: it may not sink any further.
double floor_of(const Node& node, int slot);

/// Below which a pair that rests at the node is pressed in the arc, and one that does not touch
/// hits: floor_of, but for stops. A stop
/// is a number, exact to rounding, and a joint that sank by less than its touch in each arc would
/// creep for ever under a small force; it sinks by next to nothing, and once. Gaps of shapes are no
/// better than their touch.
double press_below(const Node& node, int slot);

/// H(q, p) [J] at a node. Needs v = M^-1 p.
double node_energy(const Scene& scene, const Node& node);

/// Forgets the pairs that have been met, and with them what touched.
void forget_pairs(Node& node);

/// The friction of an impulse (lambda, beta) at a contact, in the world.
inline Vec3 across(const Contact& c, const Vec3& p) {
  return c.friction > 0 ? Vec3(p[1] * c.t_W[0] + p[2] * c.t_W[1]) : Vec3(Vec3::Zero());
}

/// An impulse at a contact for the report, by the pair's number.
inline ContactImpulse acted(const Node& node, const Contact& c, double lambda, const Vec3& p_W) {
  return {node.pool.number(c.slot), lambda, p_W, c.point_W, c.n_W};
}

}  // namespace saltus
