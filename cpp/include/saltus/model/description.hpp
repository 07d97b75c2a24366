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

struct LinkSpec {
  std::string name;
  BodyInertia inertia = {};  ///< in the link's frame; not used of what cannot move
  InertiaCheck check = InertiaCheck::strict;
  double compensation = 0;  ///< part of its weight that something else carries
};

/// This joint's displacement is `multiplier * (displacement of joint) + offset`.
struct Mimic {
  std::string joint;
  double multiplier = 1;
  double offset = 0;
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
constexpr JointEffects operator|(JointEffects a, JointEffects b) {
  return static_cast<JointEffects>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}
constexpr bool has(JointEffects set, JointEffects one) {
  return (static_cast<unsigned>(set) & static_cast<unsigned>(one)) != 0;
}

struct JointSpec {
  std::string name;
  JointType type = JointType::revolute;
  std::string parent, child;        ///< links
  Pose X_PJ = {};                   ///< joint (= child link) frame in the parent link's frame
  Vec3 axis = Vec3::UnitX();        ///< in the joint's frame, any length but 0
  double pitch = 0;                 ///< [m/rad] helical only
  std::optional<Mimic> mimic = {};  ///< one-coordinate joints only
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double velocity = std::numeric_limits<double>::infinity();
  double effort = std::numeric_limits<double>::infinity();
  double damping = 0, friction = 0;
  double armature = 0;             ///< [kg m^2 | kg] of a motor's rotor, as the joint feels it
  double stiffness = 0, rest = 0;  ///< of a spring; [N m/rad | N/m], [rad | m]
  double limit_restitution = 0;    ///< at its stops
  JointEffects effects = JointEffects::all;
  /// Instead of stiffness and rest: the spring resists with `curve_f` at `curve_x` and a cubic
  /// spline between, of given slopes at its ends or natural ones (curve.hpp). Empty: none.
  std::vector<double> curve_x = {}, curve_f = {};  ///< [rad | m], [N m | N]
  std::optional<std::array<double, 2>> curve_slopes = {};
};

/// Work is told by actuator and by these, whose names actuators cannot have.
inline constexpr std::array<const char*, 3> other_sources{"damping", "friction", "applied"};

/// A motor, a servo or any force that is affine in what it moves: force_model.hpp.
struct ActuatorSpec {
  std::string name;
  std::vector<std::pair<std::string, double>> joints;  ///< of one coordinate each, with ratios
  double gain = 1;
  double bias = 0, bias_l = 0, bias_v = 0;
  double effort = std::numeric_limits<double>::infinity();
  double lower = -std::numeric_limits<double>::infinity();  ///< of the control
  double upper = std::numeric_limits<double>::infinity();
};

struct ShapeSpec {
  std::string link;
  std::string name;  ///< of a half-space; "" for shapes that are named after their link
  Shape shape;
  Pose X_LG;
  std::string material = {};  ///< of a half-space; "": that of its link, as all other shapes
  /// Of a half-space: with all that no set_contact is said of.
  std::optional<ContactProperties> contact = {};
};

/// Are gaps watched between links on both sides of one joint? They overlap at it by design; a
/// joint that lets them fly (floating, planar) is none of these.
enum class AdjacentLinks { excluded, watched };

/// Which pairs are not watched, each by two names.
struct FilterSpec {
  using Names = std::vector<std::pair<std::string, std::string>>;
  Names links, bodies, groups;                  ///< of links; the same, half-spaces left aside
  std::map<std::string, std::string> group_of;  ///< link -> group
  AdjacentLinks adjacent = AdjacentLinks::excluded;
};

struct MaterialSpec {
  std::map<std::string, std::string> of_link;
  std::map<std::pair<std::string, std::string>, ContactProperties> contact;  ///< the lesser first
  std::optional<ContactProperties> standard;  ///< of all pairs that nothing else is said of
};

struct ModelDescription {
  std::string name, root;
  std::string source;  ///< text it was read from; "" if built in code
  Vec3 gravity = Vec3(0, 0, -9.81);
  TreeSolver solver = TreeSolver::automatic;
  std::vector<LinkSpec> links;  ///< the root first
  std::vector<JointSpec> joints;
  std::vector<ActuatorSpec> actuators;
  std::vector<LoopSpec> loops;
  std::vector<CouplingSpec> couplings;
  std::vector<PrescribedSpec> prescribed;
  std::vector<SpringSpec> springs;
  std::vector<ForceSpec> forces;
  std::vector<PotentialFunction> potentials;
  std::vector<ShapeSpec> shapes;
  std::vector<Visual> visuals;
  FilterSpec filter;
  MaterialSpec materials;
  std::vector<StateSpec> states;
  std::vector<SensorSpec> sensors;
  std::vector<std::string> warnings;
};

}  // namespace saltus
