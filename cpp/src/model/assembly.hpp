// build()'s worker: orders the links, composes joints into frames, welds masses, lists pairs.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "saltus/model/model_builder.hpp"

namespace saltus {

inline std::string quoted(const std::string& name) { return "\"" + name + "\""; }

/// The item of this name. @throws ModelError with the names there are, which `others` calls so.
template <class Items>
auto& named(Items& items, const std::string& element, const std::string& name,
            const std::string& others = "there") {
  for (auto& item : items) {
    if (item.name == name) return item;
  }
  std::vector<std::string> names;
  for (const auto& item : items) names.push_back(item.name);
  throw ModelError(
      "no " + element + " " + quoted(name) + "; " + others + " are " + list_names(names), element,
      name);
}

/// "restitution 0.5 and friction 0.2".
std::string in_words(const ContactProperties& properties);

/// Are these two half-spaces one? To 1e-9, [m] for the offset.
bool same_plane(const Pose& X_WA, const Pose& X_WB);

/// Where a link is that only fixed joints hold to the root; nothing where it may move.
std::optional<Pose> fixed_pose(const ModelDescription& description, const std::string& link);

class Assembly {
 public:
  explicit Assembly(const ModelDescription& description) : d_(description) {}

  void check();
  Model build();
  static bool has_one_coordinate(JointType type);

 private:
  /// A frame under construction: placement X_JF in tree joint J.
  struct Place {
    int joint = -1;
    Pose X_JF;
  };

  /// One of the one-degree joints, or the ball, that a joint is composed of.
  struct Axis {
    const char* suffix;           ///< of the coordinate's name; before x, y, z, w of a ball
    const char* velocity_suffix;  ///< likewise of the velocity's
    Joint::Kind kind;
    Vec3 axis;  ///< in the joint's own frame turned so that its axis is z; not of a ball
  };

  // topology.cpp
  void find_links();     // parents, children; unknown names, two parents
  void order_joints();   // depth first from the root; cycles, two roots
  void resolve_mimic();  // flattens chains of mimics into drives
  void number_coordinates();
  static std::vector<Axis> composition(JointType type);
  /// Index of a link, or ModelError: "<user> link "<name>", which does not exist; links are ...".
  int link_index(const std::string& name, const std::string& user, const std::string& element,
                 const std::string& culprit) const;

  // assembly.cpp
  void add_frames();  // joints -> tree, links -> places
  Place add_frame(const Place& at, const Axis& axis, int spec, int velocity);
  Place add_joint_frames(const Place& parent, int spec);
  void describe(const JointSpec& joint, JointInfo& info) const;

  // masses.cpp
  void add_masses();
  void check_moments();  // of what is welded together; warns of links impossible alone
  std::string reading_of(const LinkSpec& link, int joint) const;
  void check_masses() const;  // joints that move no mass

  // joint_forces.cpp
  void add_forces();  // armature and springs; damping, friction and actuators
  void add_actuator(const ActuatorSpec& spec);
  void add_curve(const JointSpec& joint, int velocity, const Drive& drive);

  // point_forces.cpp
  void add_springs();        // and their dampers
  void add_compensations();  // of links' weights
  void add_functions();      // forces and potentials
  BodyPoint body_point(const At& point, const std::string& user, const std::string& culprit) const;
  void add_limits();
  int joint_index(const std::string& name, const std::string& user) const;

  // loops.cpp
  void add_loops();
  int moved_frame(const std::string& joint, const std::string& user) const;
  Equality::End end_of(const At& at, const std::string& loop) const;

  // filter.cpp
  void add_filter();  // exclusions of links and of groups
  std::vector<std::pair<int, int>> adjacent_links() const;

  // materials.cpp
  void add_materials();
  std::vector<std::string> materials_of_links() const;

  // unsaid.cpp
  void warn_of_unsaid_contacts();  // of free roots that meet half-spaces
  std::vector<int> flying_links() const;
  bool is_unsaid(int i, int j) const;  // of two shapes

  // named_states.cpp
  void warn_of_states();  // of those outside of limits

  // visuals.cpp
  void check_visuals() const;  // their links

  // pairs.cpp
  void add_shapes();
  void add_pairs();

  const ModelDescription& d_;
  ModelData m_;
  std::map<std::string, int> link_;      // name -> index
  std::map<std::string, int> joint_;     // name -> index of spec
  std::vector<int> parent_joint_;        // (links) spec of the joint above, -1 at the root
  std::vector<std::vector<int>> below_;  // (links) specs of the joints that start there
  std::vector<int> order_;               // specs, depth first
  std::vector<Drive> drive_;             // (specs) multiplier and offset on the base joint
  std::vector<int> base_;                // (specs) the joint whose coordinate drives this one
  std::vector<int> first_velocity_;      // (specs)
  std::vector<Place> place_;             // (links)
  std::vector<int> group_;               // (links) first link of those welded together
  using Pairs = std::set<std::pair<int, int>>;  // of indices, the lesser first
  Pairs excluded_;                              // links
  Pairs excluded_bodies_;                       // links, where neither shape is a half-space
  std::vector<int> collision_group_;            // (links) -1: in none
  Pairs excluded_groups_;
  std::vector<char> said_;  // (materials * materials) is anything said of this contact?
};

}  // namespace saltus
