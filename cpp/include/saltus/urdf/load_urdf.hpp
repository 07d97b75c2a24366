// URDF to ModelBuilder and Model.
//
// urdfdom parses; what it lets pass or drops (negative mass, zero axis, unknown mimic, a joint that
// closes a cycle, shapes it does not know) is checked first, with file and line. URDF 1.0, 1.1 and
// 1.2 are read alike. Beyond URDF:
//   * joints of type "spherical" or "ball": a unit quaternion;
//   * `<capsule radius length>` inside `<geometry>` (URDF 1.1): `length` is that along z without
//     the two half balls;
//   * limits may be "inf"; `<limit>` may lack effort and velocity, which then are infinite;
//   * a block `<saltus>` below `<robot>`, which other readers skip:
//       <half_space name="floor" normal="0 0 1" offset="0"/>    solid where normal.x <= offset
//       <capsule link="arm" radius="0.03" length="0.3"> <origin xyz="0 0 0" rpy="0 0 0"/>
//       </capsule>                             and other shapes, listed in urdf/shape_elements.cpp
//       <mesh link="arm" use="none"/>              its collision meshes are not used (hull: are)
//       <exclude link1="a" link2="b"/>                      no gap is watched between these
//       <group name="pins" links="pin_1 pin_2"/>            a link is in one group at most
//       <exclude group1="pins" group2="pins"/>              nor between links of these groups
//       <adjacent_links gaps="watched"/>       see ModelBuilder::set_adjacent_links
//       <motor name="m" joint="j" gear="1" effort="2"/>           see ModelBuilder::add_motor
//       <position_servo name="m" joint="j" kp="90" kd="3"/>       likewise; effort may be said
//       <velocity_servo name="m" joint="j" kv="5"/>
//       <joint name="j" armature="0.1" stiffness="2" rest="0" limit_restitution="0.5"/>   of these
//                                                damping and friction what is said is set
//     half_space: all three may be left out (the values above; the name is then "half_space").
//
// A simple `<transmission>` is a motor of its actuator's name; one warning names the others.
//
// Collision meshes (STL, OBJ, DAE) become their convex hulls, and one warning names them; one tells
// of those that are not found or of another format. A flat one becomes a thin plate. A mesh that is
// there and cannot be read is an error. Visuals are kept for pictures; those that are missing or
// broken are left out, which one warning tells.
//
// Wrong, and read with a warning unless `strict` is said, as other readers do: an inertia without
// mass of what is fixed or welded; moments of inertia that are off by 2 % of the greatest; sizes of
// 0 (contact points), which are 10^-5 m; limits that are missing or crossed, which are none;
// `<mimic>` of a joint that is fixed, which stands still, or is not there; names with expressions
// of xacro; commas between numbers, and more of them than needed; a second element where one is
// meant; products of inertia that are missing; zero bytes at the end; bytes that are no UTF-8.
// Other encodings are read by the XML declaration. Warnings of a kind are one line: the first, and
// how many more.
//
// Not used, and named in a warning: shapes without a gap function, elements and attributes that
// URDF does not know, `<mimic>` of a fixed joint. Skipped without a word: safety controllers,
// limits of acceleration and jerk, and other programs' elements (gazebo, sensor, `ns:name`). The
// text itself stays available as the model's `source`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saltus/model/model_builder.hpp"

namespace saltus {

/// What becomes of collision meshes: convex solids around them, or nothing.
enum class MeshUse { hull, none };

/// Where the inertias of links come from.
enum class InertiaUse {
  checked,   ///< the file; those that no body can have are refused, but see below
  as_given,  ///< the file, whatever the moments are
  /// As as_given; links without a mass get that of their collision shapes, or where there are none
  /// of their visuals, filled with water (1000 kg/m^3).
  from_shapes,
};

/// How a file is read.
struct UrdfOptions {
  Vec3 gravity = Vec3(0, 0, -9.81);  ///< [m/s^2]
  /// Where `package://name/rest` is looked up: a folder that holds `name`, or `name` itself. The
  /// folders above the URDF file are searched too.
  std::vector<std::string> package_dirs = {};
  /// How the file's root link hangs on the world: fixed (its frame is the world's), or by a joint
  /// named "root" (floating, planar, spherical; continuous or prismatic with axis z) below a link
  /// named "world". Underscores are added where the file has these names already.
  JointType root_joint = JointType::fixed;
  /// How steps solve for velocities, see ModelBuilder::set_solver.
  TreeSolver solver = TreeSolver::automatic;
  /// Of links for which the file has no `<mesh use=...>`.
  MeshUse meshes = MeshUse::hull;
  /// SRDF, a file or text as read_urdf's argument: its `<disable_collisions>`,
  /// `<disable_default_collisions>` and `<enable_collisions>` say which links never collide.
  /// Half-spaces stay watched; its `<group_state>` are states by name. Links and joints that the
  /// robot has not are named in warnings.
  std::optional<std::string> srdf = {};
  /// What of its joints acts; the rest is kept as information.
  JointEffects effects = JointEffects::all;
  /// The default contact, in place of the file's own `<contact>` without materials.
  std::optional<ContactProperties> contact = {};
  /// Adds the half-space z <= 0, as ModelBuilder::add_floor does, unless the file has it.
  bool floor = false;
  /// Reads what links look like, Model::visuals; it takes time where they are meshes.
  bool visuals = true;
  /// Where the inertias of links come from.
  InertiaUse inertia = InertiaUse::checked;
  /// Refuses what is wrong and else read with a warning, see above.
  bool strict = false;
};

/// Reads a URDF file, or URDF text where the argument begins with '<' (after white space), into a
/// builder, to add to before it is built.
/// Bounds: 64 MiB of text, elements nested as deep as tinyxml2 goes (500; 100 in old versions);
/// entities are not expanded.
/// @throws ModelError with "file:line:" where known ("URDF text:line:"), element and name.
SALTUS_EXPORT ModelBuilder read_urdf(const std::string& path_or_text,
                                     const UrdfOptions& options = {});

/// The model of read_urdf(...).build(). What was understood but is not used is in its `warnings`.
/// @throws as read_urdf and ModelBuilder::build
SALTUS_EXPORT Model load_urdf(const std::string& path_or_text, const UrdfOptions& options = {});

}  // namespace saltus
