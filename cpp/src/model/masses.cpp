// Links' inertias welded into the bodies of joints; joints that move no mass.
#include <Eigen/Eigenvalues>
#include <cmath>
#include <sstream>

#include "model/assembly.hpp"
#include "saltus/lagrangian/packed_matrix.hpp"
#include "saltus/tree/coordinates.hpp"

namespace saltus {
namespace {

/// The inertia that a force on one coordinate feels [kg m^2 | kg].
struct FeltInertia {
  double free;    ///< with all coordinates after it free: its pivot in the mass matrix
  double locked;  ///< with all others held: its entry on the diagonal
  double scale;   ///< bound of the terms that `locked` is the sum of
};

/// What is wrong with the principal moments of a body; "" if nothing is.
struct Moments {
  std::string wrong;
  bool are_near = false;  ///< possible if none were changed by more than 2 % of the greatest
};

Moments judge(const BodyInertia& body) {
  const Vec3 moments = Eigen::SelfAdjointEigenSolver<Mat3>(body.I_J).eigenvalues();
  // 1e-5: thin rods and plates lie on the boundary, and three moments of six digits leave so much.
  // 1e-12 m^2: a body of a micrometre is a point, whatever noise is written for its moments.
  const double slack = 1e-5 * body.I_J.norm() + 1e-12 * body.mass;
  // a negative moment is in the way of the rule for the greatest, too
  const double excess = moments[2] - moments[0] - moments[1];
  if (excess <= slack) return {};
  std::ostringstream text;
  text << "principal moments of inertia (" << moments[0] << " " << moments[1] << " " << moments[2]
       << ") that no body can have: each must be at least 0 and at most the sum of the other two";
  return {text.str(), moments[0] > 0 && excess <= 3 * 0.02 * moments[2]};
}

bool has_no_mass(const BodyInertia& body) { return body.mass == 0 && body.I_J.norm() > 0; }

/// Pivots of a symmetric matrix eliminated from its last row up.
VecX pivots_from_last(MatX M) {
  for (Eigen::Index k = M.rows() - 1; k > 0; --k) {
    M.topLeftCorner(k, k) -= M.col(k).head(k) * (M.row(k).head(k) / M(k, k));
  }
  return M.diagonal();
}

/// Bound of the terms of S.(Ic S) in one slot.
double scale_of(const PackedTree& t, const Packed& w, int slot) {
  const double *S = at(w.S_W, slot), *I_h = at(w.I_h, slot);
  const auto norm = [](const double* x) { return std::hypot(x[0], x[lanes], x[2 * lanes]); };
  const double a = norm(S), l = norm(S + 3 * lanes);
  const double trace = I_h[0] + I_h[3 * lanes] + I_h[5 * lanes];
  return a * a * trace + 2 * a * l * norm(I_h + 6 * lanes) + l * l * *at(t.weight, slot);
}

/// S.U, a joint's own entry of the mass matrix.
double locked_inertia(const Packed& w, int slot) {
  double sum = 0;
  for (int c = 0; c < 6; ++c) sum += at(w.S_W, slot)[c * lanes] * at(w.U_F_G, slot)[c * lanes];
  return sum;
}

std::vector<FeltInertia> felt_inertias(const Tree& tree, const PackedTree& t) {
  Packed w(t);
  PackedMatrix M(tree, t);
  VecX q = neutral(tree), step(tree.n_v);
  for (int i = 0; i < step.size(); ++i) step[i] = 0.3 + 0.1 * (i % 7);  // no special configuration
  integrate(tree, q, 1, step, q);
  set_coordinates(tree, t, q, w);
  place(t, w);
  mass_pass(t, w);

  std::vector<FeltInertia> felt(static_cast<std::size_t>(tree.n_v), {0, 0, 0});
  for (int i = 0; i < tree.joints(); ++i) {
    const Drive& drive = tree.drive[i];
    felt[drive.velocity].scale += drive.multiplier * drive.multiplier * scale_of(t, w, t.slot[i]);
  }
  const auto armature = [&](int c) {
    return t.own.empty() ? 0.0 : *at(t.own, t.slot_of_velocity[c]);
  };
  factorize(tree, t, w, 0, M);
  const VecX dense_pivots = tree.one_to_one ? VecX() : pivots_from_last(M.dense);
  for (int c = 0; c < tree.n_v; ++c) {
    felt[c].free = tree.one_to_one ? 1 / *at(M.inverse, t.slot[c]) : dense_pivots[c];
    felt[c].locked = tree.one_to_one ? locked_inertia(w, t.slot[c]) + armature(c) : M.dense(c, c);
    felt[c].scale += armature(c);
  }
  return felt;
}

}  // namespace

void Assembly::add_masses() {
  m_.mass.body.resize(m_.tree.parent.size());
  for (std::size_t i = 0; i < d_.links.size(); ++i) {
    if (place_[i].joint < 0) continue;  // fixed to the world: cannot move
    BodyInertia& body = m_.mass.body[place_[i].joint];
    body = weld(body, transform(place_[i].X_JF, d_.links[i].inertia));
  }
}

// Bodies with possible moments have possible ones when welded, so some link is to blame where the
// sum has none.
void Assembly::check_moments() {
  std::map<std::string, std::pair<std::string, int>> notes;  // how they are read -> first, count
  for (std::size_t i = 0; i < d_.links.size(); ++i) {
    const LinkSpec& link = d_.links[i];
    if (i == 0 && !has_no_mass(link.inertia)) continue;  // the root cannot move
    const std::string reading = reading_of(link, place_[i].joint);
    if (reading.empty()) continue;
    const std::string what =
        has_no_mass(link.inertia) ? "an inertia but no mass" : judge(link.inertia).wrong;
    auto& [first, count] = notes[reading];
    if (++count == 1) first = "link " + quoted(link.name) + " has " + what + "; " + reading;
  }
  for (const auto& [reading, of] : notes) {
    const std::string more = " (and " + std::to_string(of.second - 1) + " more like it)";
    m_.warnings.push_back(of.first + (of.second > 1 ? more : ""));
  }
}

/// How the inertia of a link is read that no body can have; "" where a body can.
/// @throws ModelError where it is not read.
std::string Assembly::reading_of(const LinkSpec& link, int joint) const {
  const auto refuse = [&](const std::string& what) {
    throw ModelError("link " + quoted(link.name) + " has " + what, "link", link.name);
  };
  const BodyInertia* body = joint < 0 ? nullptr : &m_.mass.body[joint];
  if (has_no_mass(link.inertia)) {
    if (body == nullptr) return "it is fixed to the world and it is not used";
    if (body->mass == 0) refuse("an inertia but no mass, and what moves has one");
    return "it is added to that of what it is fixed to";
  }
  const Moments moments = judge(link.inertia);
  if (moments.wrong.empty()) return "";
  if (body == nullptr) return "it is fixed to the world and they are not used";
  if (judge(*body).wrong.empty()) return "those of all that it is fixed to are possible";
  if (link.check == InertiaCheck::as_given) return "they are used as they are";
  if (link.check == InertiaCheck::strict) refuse(moments.wrong);
  if (!moments.are_near) {
    refuse(moments.wrong + "; inertia=\"as_given\" of load_urdf uses them as they are");
  }
  return "they are off by less than 2 % and used as they are";
}

// Where `free` vanishes against `locked`, no force is needed to move the coordinate: what is below
// gives way. Where `locked` vanishes against `scale`, all mass lies on the axis. Elimination ends
// at the first such pivot, the last in order, and those before it are not to be looked at.
void Assembly::check_masses() const {
  const std::vector<FeltInertia> felt = felt_inertias(m_.tree, m_.packed);
  for (int c = m_.tree.n_v - 1; c >= 0; --c) {
    // 1e-12, 1e-14: rounding of the sweep and of one sum, with a few digits to spare
    if (felt[c].free > 1e-12 * felt[c].locked && felt[c].locked > 1e-14 * felt[c].scale) continue;
    const int coordinate = m_.tree.coordinate[c];
    const JointSpec& joint = d_.joints[joint_.at(m_.coordinates[coordinate].joint)];
    const bool gives_way = felt[c].locked > 1e-14 * felt[c].scale;
    const bool is_empty = d_.links[link_.at(joint.child)].inertia.mass == 0;
    const std::string link = "link " + quoted(joint.child);
    throw ModelError(
        "joint " + quoted(joint.name) + " moves no mass" +
            (gives_way ? " of its own: " + (is_empty ? link + " has none, and " : std::string()) +
                             "a joint below it undoes its motion, as one on the same axis does"
                       : ": give " + link + " or a link below it a mass and an inertia"),
        "joint", joint.name);
  }
}

}  // namespace saltus
