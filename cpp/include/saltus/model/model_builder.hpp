// Describe a model link by link, then freeze it with build(). The only class with add_ verbs.
#pragma once

#include <functional>
#include <string>
#include <unordered_set>
#include <vector>

#include "saltus/model/description.hpp"
#include "saltus/model/solids.hpp"

namespace saltus {

/// A homogeneous solid that moves: a link, its shape and the joint above it. The frames of the
/// three are one.
struct BodySpec {
  std::string name;                    ///< of the link
  Shape shape;                         ///< its form and sizes
  std::optional<double> mass = {};     ///< [kg] this or density; neither where the joint is fixed
  std::optional<double> density = {};  ///< [kg/m^3]
  Pose X = {};                         ///< in the parent link's frame, at displacement 0
  JointType joint = JointType::floating;  ///< how it moves
  std::string joint_name = {};            ///< "": the body's
  std::string parent = {};                ///< link; "": the root
  Vec3 axis = Vec3::UnitX();              ///< of a joint that has one, in the body's frame
};

/// The solid below a plane, fixed to the world, of a material of its own.
struct FloorSpec {
  std::string name = "floor";   ///< as in pair names
  Vec3 normal = Vec3::UnitZ();  ///< out of the solid, of any length but 0
  double offset = 0;            ///< [m] normal.x on the plane
  /// With all that no set_contact is said of; the default contact where there is none.
  std::optional<ContactProperties> contact = {};
  std::string material = {};  ///< "": the floor's name
};

/// How ModelBuilder::add puts another description into its own.
struct AddSpec {
  std::string prefix = {};     ///< of all its names
  std::string parent = {};     ///< link that carries its root link; "": the root
  Pose X = {};                 ///< its root link's frame in the parent's
  bool own_materials = false;  ///< materials get the prefix, too; else equal names are one material
};

/// Local mistakes throw at once, in add_ and set_; those that need the whole (unknown parents,
/// cycles, two roots, joints that move no mass) in check() and build(). All are ModelError and
/// carry the element and its name.
class SALTUS_EXPORT ModelBuilder {
 public:
  /// `root` is the link that is fixed to the world; its frame is the world frame.
  explicit ModelBuilder(std::string name = "model", std::string root = "world");
  /// Goes on from what another builder gathered; its local checks are not made again.
  explicit ModelBuilder(ModelDescription description) : d_(std::move(description)) {}

  /// [m/s^2]
  ModelBuilder& set_gravity(const Vec3& gravity);
  /// Text that the model was read from, which it keeps.
  ModelBuilder& set_source(std::string text);
  /// How steps solve for velocities, on all trees: a matter of speed, answers differ by rounding.
  /// `automatic` goes by each tree's shape; Model::solvers tells what became of it.
  ModelBuilder& set_solver(TreeSolver solver);

  /// A link that has no shape yet.
  ModelBuilder& add_link(const LinkSpec& link);
  /// A joint between two links, which may be added later.
  ModelBuilder& add_joint(const JointSpec& joint);
  /// Shapes are named after their link, "#2" added for its second, and so on.
  ModelBuilder& add_shape(const std::string& link, const Shape& shape, const Pose& X_LG = {});
  /// What a link looks like; see check_visual for what is refused.
  ModelBuilder& add_visual(const Visual& visual);
  /// The solid below the plane normal.x = offset, fixed to the world; `name` as in pair names.
  ModelBuilder& add_half_space(const std::string& name, const Vec3& normal, double offset = 0);
  /// Link, shape and joint in one; nothing is added where it throws.
  ModelBuilder& add_body(const BodySpec& body);
  /// A half-space with a material and, perhaps, contact properties of its own.
  ModelBuilder& add_floor(const FloorSpec& floor = {});
  /// Puts another description into this one, its root link fixed to a link of this one.
  ///
  /// Half-spaces of one plane become one, and default contacts that only one of the two has hold
  /// for both. Gravity, solver and source stay those of this builder.
  /// @throws ModelError on names that both have, half-spaces that would move, and default contacts,
  /// contacts of materials, floors or rules for adjacent links that contradict each other; nothing
  /// is added then.
  ModelBuilder& add(ModelDescription other, const AddSpec& how = {});
  /// No gap is watched between these links; half-spaces belong to the root link.
  ModelBuilder& add_exclusion(const std::string& link_a, const std::string& link_b);
  /// The same, but half-spaces of these links stay watched: for lists that know of none (SRDF).
  ModelBuilder& add_body_exclusion(const std::string& link_a, const std::string& link_b);
  /// Puts a link into a group, of which it has one at most; the last word holds.
  ModelBuilder& set_group(const std::string& link, const std::string& group);
  /// No gap is watched between links of these groups; a group may be named twice.
  ModelBuilder& add_group_exclusion(const std::string& group_a, const std::string& group_b);
  /// Excluded unless said otherwise. What is welded together is never watched.
  ModelBuilder& set_adjacent_links(AdjacentLinks adjacent);
  /// What all shapes of a link are made of; half-spaces belong to the root link.
  ModelBuilder& set_material(const std::string& link, const std::string& material);
  /// Of all pairs that nothing else is said of: neither by set_contact of their materials, nor by
  /// the floor. Elastic and without friction otherwise.
  ModelBuilder& set_default_contact(const ContactProperties& properties);
  /// What happens between two materials, in any order; the last word holds.
  ModelBuilder& set_contact(const std::string& material_a, const std::string& material_b,
                            const ContactProperties& properties);

  /// Forces; joints are of one coordinate where nothing else is said.
  ///
  /// A motor: the control is its torque, at most `effort`; the joint gets `gear` times it.
  ModelBuilder& add_motor(const std::string& name, const std::string& joint, double gear = 1,
                          double effort = no_bound);
  /// kp (control - q) - kd v, of at most `effort`: the control is the position to reach.
  ModelBuilder& add_position_servo(const std::string& name, const std::string& joint, double kp,
                                   double kd = 0, double effort = no_bound);
  /// kv (control - v), of at most `effort`: the control is the rate to reach.
  ModelBuilder& add_velocity_servo(const std::string& name, const std::string& joint, double kv,
                                   double effort = no_bound);
  /// Any force that is affine in what it moves.
  ModelBuilder& add_actuator(const ActuatorSpec& actuator);
  /// [kg m^2 | kg] of a motor's rotor, as the joint feels it.
  ModelBuilder& set_armature(const std::string& joint, double armature);
  /// Of all coordinates of a planar joint, of the ball of a floating or spherical one.
  ModelBuilder& set_damping(const std::string& joint, double damping);
  /// [N m | N] dry; of joints of one coordinate.
  ModelBuilder& set_friction(const std::string& joint, double friction);
  /// [rad | m] Stops; infinite where there is none.
  ModelBuilder& set_limit(const std::string& joint, double lower, double upper,
                          double restitution = 0);
  /// e at the stops that the joint has.
  ModelBuilder& set_limit_restitution(const std::string& joint, double restitution);
  /// V = stiffness (x - rest)^2 / 2; [N m/rad | N/m], [rad | m].
  ModelBuilder& add_joint_spring(const std::string& joint, double stiffness, double rest = 0);

  /// Holds two links together beyond the tree; simulate from a configuration that closes it
  /// (close_loops). `distance` [m] is of type distance.
  ModelBuilder& add_loop(const std::string& name, LoopType type, const At& a, const At& b,
                         double distance = 0);
  /// The displacement of `joint` is a polynomial, by rising powers, of that of another. A joint
  /// that mimics another is the same of degree 1, and has no coordinate.
  ModelBuilder& add_coupling(const std::string& joint, const std::string& of,
                             const std::vector<double>& polynomial);
  /// The joint moves by a cubic spline (ends are not bent, a line goes on beyond) through `values`
  /// [rad | m] at `times` [s], whatever that takes.
  ModelBuilder& set_prescribed(const std::string& joint, std::vector<double> times,
                               std::vector<double> values);
  /// The same by a function of time. A model that has one cannot be sent elsewhere.
  ModelBuilder& set_prescribed(const std::string& joint,
                               std::function<PrescribedMotion(double t)> function);
  /// Either, as PrescribedSpec says.
  ModelBuilder& set_prescribed(const PrescribedSpec& spec);

  /// A spring that resists with `f` at the displacements `x` [rad | m], ascending, and with a cubic
  /// spline between; V is its integral from the first. Ends are natural, or have these slopes.
  ModelBuilder& add_joint_spring(const std::string& joint, std::vector<double> x,
                                 std::vector<double> f,
                                 const std::optional<std::array<double, 2>>& slopes = {});
  /// V = stiffness (d - length)^2 / 2 and the force -damping d' along the line between two points.
  /// @throws ModelError on unknown links, negative numbers, both points on one body
  ModelBuilder& add_spring(const SpringSpec& spring);
  /// Something carries `part` of the link's weight: gravity pulls at the rest of it alone.
  ModelBuilder& set_gravity_compensation(const std::string& link, double part = 1);
  /// A force that is a function of (t, q, v). A model that has one cannot be sent elsewhere.
  ModelBuilder& add_force(const ForceSpec& force);
  /// A potential V(q) with its gradient and Hessian along velocities. Likewise.
  ModelBuilder& add_potential(const PotentialFunction& potential);
  /// What of these acts, of one joint or of all there are now.
  ModelBuilder& set_effects(const std::string& joint, JointEffects effects);
  /// Of all joints there are now.
  ModelBuilder& set_effects(JointEffects effects);

  /// A state by name, see named_state.hpp. Joints are those there are now; joints that mimic others
  /// have no numbers of their own.
  ModelBuilder& add_state(const StateSpec& state);
  /// What the model measures by name.
  ModelBuilder& add_sensor(const SensorSpec& sensor);

  /// Adds to what Model tells as `warnings`.
  ModelBuilder& add_warning(std::string text);

  /// What was said of a link or joint, or ModelError with the names there are.
  const LinkSpec& link_spec(const std::string& name) const;
  /// Likewise, of a joint.
  const JointSpec& joint_spec(const std::string& name) const;
  /// Says it anew: `change` gets a copy, which is checked as by add_link or add_joint, then kept.
  /// The text that a model was read from is forgotten, since it says something else.
  /// @throws ModelError where the name changes, too.
  ModelBuilder& change_link(const std::string& name, const std::function<void(LinkSpec&)>& change);
  /// Likewise, a joint.
  ModelBuilder& change_joint(const std::string& name,
                             const std::function<void(JointSpec&)>& change);
  /// [kg] The centre of mass stays, and the inertia about it grows with the mass.
  ModelBuilder& set_mass(const std::string& link, double mass);

  void check() const;  ///< the checks of build() alone
  /// The model, once all checks hold.
  Model build() const;

  /// The description once its local checks are made again: for what comes from elsewhere.
  /// @throws ModelError as the add_ and set_ that it was made by would.
  static ModelDescription checked(const ModelDescription& description);

  /// What was understood but is not used.
  const std::vector<std::string>& warnings() const { return d_.warnings; }
  /// What was gathered.
  const ModelDescription& description() const { return d_; }

 private:
  static constexpr double no_bound = std::numeric_limits<double>::infinity();
  JointSpec& joint(const std::string& name);
  /// The names of the first so many: adding one is then no walk over all.
  struct KnownNames {
    std::unordered_set<std::string> names;
    std::size_t count = 0;
  };
  template <class Items>
  static bool is_taken(const Items& items, const std::string& name, KnownNames& known);
  template <class Items>
  static void check_new_name(const Items& items, const std::string& element,
                             const std::string& name, KnownNames& known);

  ModelDescription d_;
  KnownNames links_, joints_;
};

/// @throws ModelError where no link can have this mass or inertia: negative mass, not symmetric,
/// an inertia without mass (unless the check is lenient, then build() looks at it). Principal
/// moments are judged by build(), which knows what is welded to what: many robots' files have links
/// that are impossible alone (1e-6 kg as a place holder).
SALTUS_EXPORT void check_inertia(const BodyInertia& inertia, const std::string& link,
                                 InertiaCheck check = InertiaCheck::strict);

}  // namespace saltus
