// A node: the point (t, q, p) where arcs meet. What touches there, and what an impact does to p.
//
// Theory, section 6. A pair touches when |phi| <= pair.touch, or when it would close within
// epsilon_t h. Touching pairs approach (u < -epsilon_u: they collide here and now), leave
// (u > epsilon_u) or rest. epsilon_u = rest (sqrt(2 T / m) + h |g| + sum_k |phi_q[k] v_k|): a part
// of the speeds that there are, so that rounding is no impact.
#pragma once

#include <array>
#include <vector>

#include "saltus/collision/broad_phase.hpp"
#include "saltus/lagrangian/packed_matrix.hpp"
#include "saltus/model/model.hpp"
#include "saltus/variational/cascade.hpp"
#include "saltus/variational/report.hpp"
#include "variational/law/friction_scratch.hpp"
#include "variational/node/contact_vector.hpp"
#include "variational/node/pair_pool.hpp"

namespace saltus {

struct Contact {
  enum class Motion { approaches, rests, leaves };
  int pair = -1;         ///< its place in the pool
  double phi = 0;        ///< [m]
  double u = 0;          ///< [m/s] gap rate
  double epsilon_u = 0;  ///< [m/s]
  Motion motion = Motion::rests;
  double restitution = 1, friction = 0;
  Vec3 n_W;              ///< from b to a
  Vec3 p_WB, point_W;    ///< [m] witness on b; where the two touch, see contact_point
  ContactVector n;       ///< phi_q
  ContactVector column;  ///< M^-1 n, written by the impact
  // where friction > 0
  std::array<Vec3, 2> t_W;                   ///< tangents t0, t1
  std::array<ContactVector, 2> t, t_column;  ///< the rows T along them, slip.hpp; M^-1 T
};

/// What laws other than nodal_energy ask of the arc after an impact: this energy, by a change of
/// the last strong impulse, along n.
struct Launch {
  bool pending = false;
  double energy = 0;         ///< [J] what the law conserves, less what restitution took
  double normal_energy = 0;  ///< [J] u^2 / 2G of the last strong impulse
  VecX n;                    ///< (n_v)
  int impulse = -1;          ///< that impulse's index in the report
  double change = 0;         ///< [N s] of it, by a kick at the node
};

struct Node {
  explicit Node(const ModelData& model);

  double t = 0;
  VecX q, p, v;                   ///< v = M^-1 p, written by find_contacts where pairs touch
  std::vector<Contact> contacts;  ///< a pool; the first `touching` are valid
  int touching = 0;
  PairPool pool;
  std::vector<int> contact_of;  ///< (pool) index in contacts, or -1
  std::vector<double> sunk;  ///< (pool) [m] phi of a pair that is silent here; else 0. Edges that
                             ///< meet at their ends, which corners watch: minus infinity
  Launch launch;
  FrictionScratch friction;

  // scratch
  Packed w;
  Kinematics kin;
  PackedMatrix M;
  BroadPhase broad;
  bool has_factors = false;  ///< M is that of q
  TreeCoordinates trees;
  VecX dq, u, rest, restitution, column;
  VecX dense;  ///< (n_v) zero between uses
  ContactMatrix G;
  CascadeScratch cascade;
  std::vector<Contact*> colliding;            ///< with friction
  std::vector<std::vector<int>> contacts_on;  ///< (trees) contacts that touch it
  std::vector<Impulse> impulses;
  std::vector<int> silent;  ///< pairs with an entry in `sunk`
  double total_mass = 0;
  double most_touch = 0;  ///< [m] no pair's epsilon_phi is larger
};

// contacts.cpp

/// With room for the rows of any pair.
Contact fresh_contact(const TreeCoordinates& trees, bool with_friction);

Contact::Motion motion_of(double u, double epsilon_u);

/// Writes the contact of the pair at `place`, with gap `g` and rows of the pair `as`. Needs M and
/// v.
void write_contact(const ModelData& model, const StepOptions& options, double speed, int place,
                   const Pair& as, const Gap& g, Node& node, Contact& c);

/// M and v = M^-1 p at the node. @return false where the mass matrix is singular
bool set_velocity_at_node(const ModelData& model, Node& node);

/// v = M^-1 p where nothing else of the node is known but q and p. @return as above
bool start_from_momenta(const ModelData& model, Node& node);

/// Writes u, epsilon_u and motion from n and the node's v. Needs typical_speed.
void classify(const Node& node, double speed, double relative, Contact& c);

/// The friction of an impulse (lambda, beta) at a contact, in the world.
inline Vec3 across(const Contact& c, const Vec3& p) {
  return c.friction > 0 ? Vec3(p[1] * c.t_W[0] + p[2] * c.t_W[1]) : Vec3(Vec3::Zero());
}

/// An impulse at a contact for the report, by the pair's number.
inline ContactImpulse acted(const Node& node, const Contact& c, double lambda, const Vec3& p_W) {
  return {node.pool.number(c.pair), lambda, p_W, c.point_W, c.n_W};
}

/// A speed of the whole model, [m/s].
double typical_speed(const ModelData& model, const StepOptions& options, const Node& node);

/// The place of a pair in the pool; the lists by place grow with it.
int place_of(const ModelData& model, int number, Node& node);

/// Forgets the pairs that have been met, and with them what touched.
void forget_pairs(Node& node);

/// Places the frames at q. M is that of another q then.
void place_node(const ModelData& model, Node& node);

/// Writes contacts (motion included) and v, where pairs are near. Needs t, q, p, v and the frames.
/// @return false where the mass matrix is singular.
bool find_contacts(const ModelData& model, const StepOptions& options, Node& node);

// node.cpp

/// u and motion of all contacts, where v has changed.
void refresh_motions(Node& node);

/// True where some touching pair approaches.
bool impact_pending(const Node& node);

/// Columns, rates, restitution and G of all contacts.
void set_contact_matrix(const ModelData& model, Node& node);

/// H(q, p) [J] at a node. Needs set_configuration at q in node.kin and v.
double node_energy(const ModelData& model, const Node& node);

// delassus.cpp

/// Writes t_W and t of a contact. Needs the parts of c.n.
void set_tangents(const ModelData& model, const Gap& gap, const Pair& pair, Node& node, Contact& c);

/// True where some pair that touches has friction.
bool has_friction(const Node& node);

/// The impact with friction: changes p and v, writes node.friction.impulses.
/// @return false when it does not end
bool collide_at_node(const ModelData& model, const CascadeOptions& options, Node& node);

// impact.cpp

/// Is there a motion that opens all contacts? Needs the contact matrix.
bool can_open(const Node& node);

/// Resolves the impact at the node: changes p, v and launch, appends to the report.
/// @param energy [J] what options.law conserves, before the impact; of no use to nodal_energy
/// @return false when the cascade does not end (JammedError is the caller's)
bool resolve_node_impact(const ModelData& model, const StepOptions& options, double energy,
                         Node& node, StepReport& report);

}  // namespace saltus
