// Describe a model link by link, then freeze it with build(). The only class with add_ verbs.
#pragma once

#include <string>
#include <vector>

#include "saltus/model/description.hpp"

namespace saltus {

/// Local mistakes throw at once, in add_ and set_; those that need the whole (unknown parents,
/// cycles, two roots, joints that move no mass) in check() and build(). All are ModelError and
/// carry the element and its name.
class SALTUS_EXPORT ModelBuilder {
 public:
  /// `root` is the link that is fixed to the world; its frame is the world frame.
  explicit ModelBuilder(std::string name = "model", std::string root = "world");
  /// Goes on from what another builder gathered; its local checks are not made again.
  explicit ModelBuilder(ModelDescription description) : d_(std::move(description)) {}

  ModelBuilder& set_gravity(const Vec3& gravity);
  ModelBuilder& set_source(std::string text);
  /// How steps solve for velocities, on all trees: a matter of speed, answers differ by rounding.
  /// `automatic` goes by each tree's shape; Model::solvers tells what became of it.
  ModelBuilder& set_solver(TreeSolver solver);

  ModelBuilder& add_link(const LinkSpec& link);
  ModelBuilder& add_joint(const JointSpec& joint);
  /// Shapes are named after their link, "#2" added for its second, and so on.
  ModelBuilder& add_shape(const std::string& link, const Shape& shape, const Pose& X_LG = {});
  /// The solid below the plane normal.x = offset, fixed to the world; `name` as in pair names.
  ModelBuilder& add_half_space(const std::string& name, const Vec3& normal, double offset = 0);
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
  /// Of all pairs that no set_contact is said of. Elastic and without friction otherwise.
  ModelBuilder& set_default_contact(const ContactProperties& properties);
  /// What happens between two materials, in any order; the last word holds.
  ModelBuilder& set_contact(const std::string& material_a, const std::string& material_b,
                            const ContactProperties& properties);
  ModelBuilder& add_warning(std::string text);

  void check() const;  ///< the checks of build() alone
  Model build() const;

  const std::vector<std::string>& warnings() const { return d_.warnings; }
  const ModelDescription& description() const { return d_; }

 private:
  ModelDescription d_;
};

/// @throws ModelError where no link can have this mass or inertia: negative mass, not symmetric,
/// an inertia without mass. Principal moments are judged by build(), which knows what is welded to
/// what: many robots' files have links that are impossible alone (1e-6 kg as a place holder).
SALTUS_EXPORT void check_inertia(const BodyInertia& inertia, const std::string& link);

/// Inertia of a homogeneous ball about its centre, a frequent need.
/// @throws ModelError where the mass or a size is not finite and positive; so the other solids.
SALTUS_EXPORT BodyInertia solid_sphere(double mass, double radius);
/// The same of a box and of a cylinder along z, by the sizes of their shapes.
SALTUS_EXPORT BodyInertia solid_box(double mass, const Vec3& half);
SALTUS_EXPORT BodyInertia solid_cylinder(double mass, double radius, double half_length);

}  // namespace saltus
