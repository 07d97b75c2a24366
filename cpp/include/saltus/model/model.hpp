// A model: frozen, checked, cheap to copy. Made by ModelBuilder; the floors below meet here.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "saltus/collision/pair_table.hpp"
#include "saltus/constraint/equality.hpp"
#include "saltus/error.hpp"
#include "saltus/force/force_model.hpp"
#include "saltus/lagrangian/partials.hpp"
#include "saltus/model/materials.hpp"
#include "saltus/model/state.hpp"

namespace saltus {

/// How a joint lets its child move against its parent.
enum class JointType {
  fixed,
  revolute,
  continuous,
  prismatic,
  helical,
  planar,     ///< x, y, yaw in the plane normal to the axis
  floating,   ///< x, y, z, then a ball
  spherical,  ///< a ball: a unit quaternion, nowhere singular
};

/// A rigid link: a frame that moves with a joint frame.
struct Link {
  std::string name;  ///< of the link
  int joint = -1;    ///< index in the tree; -1: fixed to the world
  Pose X_JL;         ///< the link's frame in the joint's frame
  double mass = 0;   ///< [kg] own mass

  BodyInertia inertia = {};  ///< own, in the link's frame
  int index = 0;             ///< in the model's links
};

/// What a coordinate is measured in: one of a quaternion's four numbers has no unit.
enum class Unit { metre, radian, one };

/// A number of q and what its joint is said to have. What of it acts is in ModelData::forces and
/// among the pairs: JointEffects.
struct Coordinate {
  std::string name;          ///< the joint's name; `<joint>_x` ... for joints of several
  std::string joint;         ///< name of the joint that it belongs to
  Unit unit = Unit::radian;  ///< of this number
  double lower;              ///< [rad | m] infinite where there is none
  double upper;              ///< likewise
  double velocity;           ///< [rad/s | m/s] limit, infinite where there is none
  double effort;             ///< [N m | N] likewise
  double damping = 0;        ///< [N m s/rad | N s/m]
  double friction = 0;       ///< [N m | N] dry
};

/// A joint as its author named it, after multi-coordinate joints are composed.
struct JointInfo {
  std::string name;              ///< as its author named it
  JointType type;                ///< how its child moves
  std::string parent;            ///< link
  std::string child;             ///< link
  std::vector<int> frames;       ///< joints of the tree, outermost last; none where fixed
  std::vector<int> coordinates;  ///< indices in q of those that move it
  std::vector<int> velocities;   ///< likewise in v and p

  int index = 0;                  ///< in the model's joints
  Pose X_PJ = {};                 ///< the joint's frame in the parent link's, at displacement 0
  std::optional<Vec3> axis = {};  ///< unit, in the joint's frame; where it has one
  double pitch = 0;               ///< [m/rad] of a helical one
  std::string mimics = {};        ///< the joint that it follows; "" of all others
  double multiplier = 1;          ///< of one that follows, as in Mimic
  double offset = 0;              ///< [rad | m] likewise
  double lower = 0;               ///< [rad | m] as its author gave it; infinite where there is none
  double upper = 0;               ///< likewise
};

/// Trees that are solved together: one, or equal ones side by side in lanes.
struct TreeSolution {
  TreeSolver solver;  ///< lu or sweep, never automatic
  int trees;          ///< as many equal ones as there are, 1 where they share no lanes
  int joints;         ///< of one coordinate each, of one tree
  int depth;          ///< joints on the longest path from the root
};

/// A stop that a joint's limit is. It is a gap like that of two shapes: phi = side (q - bound).
struct JointLimit {
  std::string name;        ///< "elbow lower limit"
  int joint;               ///< of the tree
  int coordinate;          ///< in q
  Stop stop;               ///< its side and bound
  double restitution = 0;  ///< e in [0, 1]
};

struct ModelDescription;
struct Visual;

/// All that a model holds; `model->tree` and so on.
struct ModelData {
  std::string name;                         ///< of the model
  Tree tree;                                ///< its joints, of one degree each
  MassModel mass;                           ///< its bodies' inertias, gravity, springs
  PackedTree packed;                        ///< tree and mass, for the kernels
  ForceModel forces;                        ///< damping, friction, motors
  EqualityModel equalities;                 ///< loops, then couplings
  std::vector<Link> links;                  ///< the root first
  std::vector<JointInfo> joints;            ///< as their author named them
  std::vector<Coordinate> coordinates;      ///< (n_q)
  std::vector<std::string> velocity_names;  ///< (n_v) coordinates' names but for balls, and for
                                            ///< the free joints' `_vx` `_vy` `_vz`
  std::vector<PlacedShape> shapes;          ///< in the order of their numbers
  PairTable pairs;                          ///< that are watched
  /// Numbered as pairs are, from `first_limit` on, which is pairs.size() as it was built.
  std::vector<JointLimit> limits;
  int first_limit = 0;                ///< number of the first
  MaterialTable materials;            ///< of its shapes
  std::vector<std::string> warnings;  ///< what was understood but is not used
  std::string source;                 ///< text the model was read from; "" if built in code
  std::shared_ptr<const ModelDescription> description;  ///< what build() made it of
  /// True once the derivatives of its functions have been looked at; null where it has none.
  std::shared_ptr<std::atomic<bool>> has_checked_functions;

  /// Anything can touch.
  bool has_gaps() const { return !pairs.empty() || !limits.empty(); }
  /// A pair of this number is a joint's limit.
  bool is_limit(int pair) const { return pair >= first_limit; }
  /// The limit that has this number among the pairs.
  const JointLimit& limit(int pair) const {
    return limits[static_cast<std::size_t>(pair - first_limit)];
  }
  /// Restitution and friction of a pair, by its number.
  ContactProperties contact_properties(int pair) const;
};

/// Gaps of all pairs at one configuration, dense, for people.
struct Gaps {
  std::vector<std::string> names;  ///< (m) "a ~ b"
  VecX phi;                        ///< (m) [m] infinite where two parts do not face each other
  MatX phi_q;                      ///< (m, n_v)
  std::vector<MatX> phi_qq;        ///< (m) of (n_v, n_v)
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;  ///< (m, 3)
  Rows normal;                                                             ///< unit, from b to a
  Rows p_WA;  ///< [m] witness on a's surface
  Rows p_WB;  ///< [m] witness on b's surface
};

/// A model: frozen, cheap to copy, the same for all threads.
class SALTUS_EXPORT Model {
 public:
  /// ModelBuilder::build does this.
  explicit Model(ModelData data) : data_(std::make_shared<const ModelData>(std::move(data))) {}
  /// All that it holds.
  const ModelData* operator->() const { return data_.get(); }
  /// All that it holds.
  const ModelData& operator*() const { return *data_; }

  int n_q() const { return data_->tree.n_q; }  ///< numbers in q: a ball has four
  int n_v() const { return data_->tree.n_v; }  ///< numbers in v and p: a ball has three

  /// State from values by name (others as in `neutral`); `v` are velocities, p = M(q) v.
  /// @throws ModelError on an unknown name, a value that is not finite, or a quaternion that is not
  ///         of length 1 (to 1e-6).
  State state(const std::map<std::string, double>& q = {},
              const std::map<std::string, double>& v = {}, double t = 0) const;
  /// The same from arrays (n_q), (n_v).
  State state(const VecRef& q, const VecRef& v, double t = 0) const;

  /// All numbers 0, or where limits that act leave that out the nearest that they allow; but
  /// quaternions, which are the identity.
  VecX neutral() const;
  /// q (+) dv: coordinates after motion at the constant velocities dv for 1 s. Of a ball dv are
  /// axis times angle, in its parent's axes.
  VecX integrate(const VecRef& q, const VecRef& dv) const;
  /// The dv (n_v) with integrate(q0, dv) = q1; of balls the shortest, at most half a turn.
  VecX difference(const VecRef& q0, const VecRef& q1) const;
  /// q with its quaternions made of length 1, whatever they were.
  /// @throws ModelError where one has no length.
  VecX normalized(const VecRef& q) const;
  /// Uniform: quaternions over all orientations, others within their limits, where there are none
  /// within +-pi rad and +-1 m.
  VecX random_configuration(std::mt19937_64& random) const;
  /// q as the model takes it: (n_q), finite, quaternions of length 1; those off by less than 1e-6
  /// are normalised. @throws ModelError otherwise; `what` names the array in the message.
  VecX checked_q(const VecRef& q, const std::string& what) const;

  VecX velocity(const State& state) const;  ///< v = M(q)^-1 p, (n_v)
  /// L and its partials, see LagrangianPartials.
  LagrangianPartials lagrangian(const VecRef& q, const VecRef& v) const;
  /// The same into `out`, whose arrays are used again.
  void lagrangian(const VecRef& q, const VecRef& v, LagrangianPartials& out) const;
  /// M(q), (n_v, n_v).
  MatX mass_matrix(const VecRef& q) const;
  /// @throws ModelError where the dense result would not fit into 1 GiB.
  Gaps gaps(const VecRef& q) const;
  double kinetic_energy(const State& state) const;  ///< [J]
  double potential_energy(const VecRef& q) const;   ///< [J] zero at the world's origin
  Pose X_WL(const VecRef& q, int link) const;       ///< pose of a link in the world

  int coordinate(const std::string& name) const;  ///< index, or ModelError with the names there are
  int velocity_index(const std::string& name) const;  ///< likewise, in v and p
  int link(const std::string& name) const;  ///< index, or ModelError with the names there are
  Pair pair(int pair) const;                ///< what the pair or limit of this number is of
  std::string pair_name(int pair) const;    ///< "a ~ b", "a[part] ~ b", "elbow lower limit"
  ContactProperties contact_properties(int pair) const;  ///< by the materials of its shapes
  /// How many pairs there are of each two kinds of shape, by shape_name in alphabetical order.
  std::map<std::pair<std::string, std::string>, int> pair_kinds() const;
  std::vector<TreeSolution> solvers() const;   ///< how steps solve its trees
  const std::vector<Visual>& visuals() const;  ///< what its links look like

  int joint(const std::string& name) const;  ///< index in the joints, or ModelError with the names

  /// A copy of this model without any pair: bodies pass through each other.
  Model without_collisions() const;

 private:
  std::shared_ptr<const ModelData> data_;
};

/// @throws ModelError unless x has n entries, all finite; `what` names the array in the message,
/// `unit` what it has n of.
SALTUS_EXPORT void check_vector(const VecRef& x, int n, const std::string& what,
                                const std::string& unit = "coordinates");

/// "a, b, c": the alternatives in an error message, at most 20 of them.
SALTUS_EXPORT std::string list_names(const std::vector<std::string>& names);

/// "1 pair", "2 pairs", "2 entries", for messages.
SALTUS_EXPORT std::string counted(long number, const std::string& noun);

}  // namespace saltus
