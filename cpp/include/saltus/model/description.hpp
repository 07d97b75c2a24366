// What a model is built of, as plain data: what ModelBuilder gathers and build() reads.
//
// A model keeps it, so that it can be sent elsewhere and built again, in the same bits.
#pragma once

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "saltus/model/force_specs.hpp"
#include "saltus/model/loop_spec.hpp"
#include "saltus/model/model.hpp"
#include "saltus/model/named_state.hpp"
#include "saltus/model/sensor.hpp"
#include "saltus/model/visual.hpp"

namespace saltus {

/// How far the inertia of a link may be from what a body can have.
enum class InertiaCheck {
  strict,   ///< not at all
  lenient,  ///< as files have it, with a warning: moments that are possible once none is changed by
            ///< more than 2 % of the greatest, and moments without a mass of what is welded
  as_given,  ///< moments may be anything; a warning tells of those that are impossible
};

/// A link, as add_link takes it.
struct LinkSpec {
  std::string name;                           ///< of the link
  BodyInertia inertia = {};                   ///< in the link's frame; not used of what cannot move
  InertiaCheck check = InertiaCheck::strict;  ///< what becomes of an impossible inertia
  double compensation = 0;                    ///< part of its weight that something else carries
};

/// This joint's displacement is `multiplier * (displacement of joint) + offset`.
struct Mimic {
  std::string joint;      ///< that is followed
  double multiplier = 1;  ///< of its displacement
  double offset = 0;      ///< [rad | m]
};

/// What of a joint acts in steps; the rest is kept as information.
enum class JointEffects : unsigned {
  none = 0,
  limits = 1,    ///< a stop at each end of the range
  damping = 2,   ///< with armature and spring
  friction = 4,  ///< dry
  motors = 8,    ///< actuators on it, and the effort they are limited to
  all = 15,
};
/// Both sets together.
constexpr JointEffects operator|(JointEffects a, JointEffects b) {
  return static_cast<JointEffects>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}
/// Whether a set has one of them.
constexpr bool has(JointEffects set, JointEffects one) {
  return (static_cast<unsigned>(set) & static_cast<unsigned>(one)) != 0;
}

/// A joint, as add_joint takes it.
struct JointSpec {
  std::string name;                      ///< of the joint
  JointType type = JointType::revolute;  ///< how its child moves
  std::string parent;                    ///< link
  std::string child;                     ///< link
  Pose X_PJ = {};                        ///< joint (= child link) frame in the parent link's frame
  Vec3 axis = Vec3::UnitX();             ///< in the joint's frame, any length but 0
  double pitch = 0;                      ///< [m/rad] helical only
  std::optional<Mimic> mimic = {};       ///< one-coordinate joints only
  double lower = -std::numeric_limits<double>::infinity();  ///< [rad | m] lowest displacement
  double upper = std::numeric_limits<double>::infinity();   ///< [rad | m] highest
  /// [rad/s | m/s] limit, for information
  double velocity = std::numeric_limits<double>::infinity();
  /// [N m | N] limit of its actuators together
  double effort = std::numeric_limits<double>::infinity();
  double damping = 0;            ///< [N m s/rad | N s/m]
  double friction = 0;           ///< [N m | N] dry
  double armature = 0;           ///< [kg m^2 | kg] of a motor's rotor, as the joint feels it
  double stiffness = 0;          ///< [N m/rad | N/m] of a spring
  double rest = 0;               ///< [rad | m] where it pulls no more
  double limit_restitution = 0;  ///< at its stops
  JointEffects effects = JointEffects::all;  ///< what of these acts
  /// Instead of stiffness and rest: the spring resists with `curve_f` at `curve_x` and a cubic
  /// spline between, of given slopes at its ends or natural ones (curve.hpp). Empty: none.
  std::vector<double> curve_x = {};
  std::vector<double> curve_f = {};  ///< [N m | N] at each of curve_x [rad | m]
  /// f' at both ends, where they are not natural
  std::optional<std::array<double, 2>> curve_slopes = {};
};

/// Work is told by actuator and by these, whose names actuators cannot have.
inline constexpr std::array<const char*, 3> other_sources{"damping", "friction", "applied"};

/// A motor, a servo or any force that is affine in what it moves: force_model.hpp.
struct ActuatorSpec {
  std::string name;                                         ///< of the control
  std::vector<std::pair<std::string, double>> joints;       ///< of one coordinate each, with ratios
  double gain = 1;                                          ///< of f by u
  double bias = 0;                                          ///< of f, constant
  double bias_l = 0;                                        ///< of f by l
  double bias_v = 0;                                        ///< of f by l'
  double effort = std::numeric_limits<double>::infinity();  ///< [N m | N] limit of f
  double lower = -std::numeric_limits<double>::infinity();  ///< of the control
  double upper = std::numeric_limits<double>::infinity();   ///< likewise
};

/// A shape on a link, as add_shape and add_half_space take it.
struct ShapeSpec {
  std::string link;           ///< that carries it
  std::string name;           ///< of a half-space; "" for shapes that are named after their link
  Shape shape;                ///< its form and sizes
  Pose X_LG;                  ///< its frame in the link's
  std::string material = {};  ///< of a half-space; "": that of its link, as all other shapes
  /// Of a half-space: with all that no set_contact is said of.
  std::optional<ContactProperties> contact = {};
};

/// Are gaps watched between links on both sides of one joint? They overlap at it by design; a
/// joint that lets them fly (floating, planar) is none of these.
enum class AdjacentLinks { excluded, watched };

/// Which pairs are not watched, each by two names.
struct FilterSpec {
  /// Pairs of names.
  using Names = std::vector<std::pair<std::string, std::string>>;
  Names links;                                       ///< of links
  Names bodies;                                      ///< of links, whose half-spaces stay watched
  Names groups;                                      ///< of groups
  std::map<std::string, std::string> group_of;       ///< link -> group
  AdjacentLinks adjacent = AdjacentLinks::excluded;  ///< of links that a joint connects
};

/// What shapes are made of, and what happens between materials.
struct MaterialSpec {
  std::map<std::string, std::string> of_link;                                ///< link -> material
  std::map<std::pair<std::string, std::string>, ContactProperties> contact;  ///< the lesser first
  std::optional<ContactProperties> standard;  ///< of all pairs that nothing else is said of
};

/// A whole model.
struct ModelDescription {
  std::string name;                           ///< of the model
  std::string root;                           ///< the link that is fixed to the world
  std::string source;                         ///< text it was read from; "" if built in code
  Vec3 gravity = Vec3(0, 0, -9.81);           ///< [m/s^2]
  TreeSolver solver = TreeSolver::automatic;  ///< how steps solve for velocities
  std::vector<LinkSpec> links;                ///< the root first
  std::vector<JointSpec> joints;              ///< in the order they were added
  std::vector<ActuatorSpec> actuators;        ///< likewise, and so are all lists below
  std::vector<LoopSpec> loops;                ///< beyond the tree
  std::vector<CouplingSpec> couplings;        ///< of two joints
  std::vector<PrescribedSpec> prescribed;     ///< joints that move as they are told
  std::vector<SpringSpec> springs;            ///< between points
  std::vector<ForceSpec> forces;              ///< functions of users
  std::vector<PotentialFunction> potentials;  ///< likewise
  std::vector<ShapeSpec> shapes;              ///< half-spaces among them
  std::vector<Visual> visuals;                ///< what links look like
  FilterSpec filter;                          ///< pairs that are not watched
  MaterialSpec materials;                     ///< of links, and between them
  std::vector<StateSpec> states;              ///< by name
  std::vector<SensorSpec> sensors;            ///< by name
  std::vector<std::string> warnings;          ///< what was understood but is not used
};

}  // namespace saltus
