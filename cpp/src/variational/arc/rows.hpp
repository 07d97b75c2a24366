// Rows: what contacts that rest at an arc's start may push in it, and how far.
//
// A row block is one contact with 1 rate and impulse along its normal, or 3 with friction. Over the
// arc the law (Signorini's, with Coulomb's) is asked of
//
//   u_n = (phi(q (+) tau v) - target) / tau,  u_t,   and p = (lambda, beta)
//
// A joint with dry friction is a row of one rate v_c, always solved for, |p| <= tau f / 2: half of
// what it may push in the arc; the other half is in the closing half kick (theory, F4).
//
// Not all rows are solved for: a contact without friction that was not pressed in the arc before
// joins where the arc would press it. Then the law says who is pressed, sticks and slides.
//
// A sharp corner on a face is held in the plane that the face has at the arc's start, within its
// border and beyond; so is the end of a rod that slides lengthwise over a border. What bears there
// at the arc's end is another pair (edges that cross, a second table), and that rests from the next
// node on. A rim is held where it is lowest, so that it rolls; in an arc that it comes to lie flat
// in, at the point that it rests on at the arc's start. A point's rates are its chord over the arc,
// seen from the face's body, so that those of several corners of one body never contradict each
// other.
#pragma once

#include <array>
#include <deque>
#include <limits>
#include <vector>

#include "variational/arc/arc.hpp"
#include "variational/node/delassus.hpp"

namespace saltus {

struct Row {
  const Contact* contact = nullptr;  ///< at the arc's start, of the node or of `ahead`; or
  int dry = -1;                      ///< index in node.dry
  int slot = -1;                     ///< of its pair in the pool; -2 - k of dry[k]
  const Pair* pair = nullptr;        ///< likewise; none of a joint
  bool is_frozen = false;            ///< held in a plane of b: `frozen` is the pair
  bool is_point = false;             ///< and there at a point of a: a corner, or one of a rim
  Pair frozen;
  Vec3 point_B;             ///< where a frozen row starts, in the frame of b's joint
  std::array<Vec3, 2> t_B;  ///< and its tangents there
  int axis = 0;             ///< tangent_axis of its normal at the start
  bool slides = false;      ///< in the arc solved: p is on its cone, against the sliding
  double target = 0;        ///< [m] lowest gap by the arc's end
  Vec3 p = Vec3::Zero();    ///< [N s] guess in, solution out; of what is not solved for 0
  Mat3 own = Mat3::Zero();  ///< W_ii once solved for; before, that of the arc before, or 0
  bool is_active = false;   ///< solved for
  std::array<ContactVector, 3> rate;    ///< du/dv, of the linearised arc; written if active
  std::array<ContactVector, 3> column;  ///< J^-1 of the forces, which act at the arc's start
  Vec3 by_launch = Vec3::Zero();        ///< what each changes of the launch's impulse
  Vec3 of_launch = Vec3::Zero();        ///< what that changes of each rate
  std::array<VecX, 3> by_loops;         ///< (m) and of the loops'; where there are some

  bool is_joint() const { return dry >= 0; }
  const Pair& watched() const { return is_frozen ? frozen : *pair; }
  bool is_pressed() const { return is_active && !is_joint() && p[0] > 0; }
};

/// What an impulse was in an arc, for a guess.
struct ImpulseMemory {
  Vec3 p = Vec3::Zero();    ///< [N s] over `tau`
  double tau = 0;           ///< [s]
  int arc = -1;             ///< its number; of an older one it is no guess
  Mat3 own = Mat3::Zero();  ///< W_ii, which says what is large
};

/// Written by make_rows and what follows here; impulses by `solve`.
struct Rows {
  explicit Rows(const Scene& scene);

  std::vector<Row> row;  ///< a pool; the first `count` are used
  int count = 0;
  std::vector<int> active;      ///< those that are solved for
  std::vector<int> of_contact;  ///< (touching) number of its row, or -1
  /// Pairs that are open at the node and close by the arc's end: a pool, at addresses that stay;
  /// the first `count_ahead` are used.
  std::deque<Contact> ahead;
  int count_ahead = 0;
  double tau = 0;       ///< [s] the arc that their impulses are over
  double residual = 0;  ///< of the law in the arc just solved

  // scratch
  ContactBlocks W;  ///< of the active rows
  Neighbours neighbours;
  std::vector<Vec3> u, p, before;
  PileScratch pile;
  std::vector<int> sticking;   ///< (trees) joints that stick
  VecX dense, column;          ///< (n_v) the first zero between uses
  std::array<VecX, 2> change;  ///< (n_v) likewise zero
  VecX momentum;               ///< (n_v) the node's with all impulses, written by set_row_residual
  VecX size;                   ///< (n_v) of all that is summed up in it, likewise
};

/// Number k of the rows that an arc is solved with.
inline Row& active_row(Rows& rows, std::size_t k) { return rows.row[rows.active[k]]; }

/// [m] Rounding of a contact's gap; of a joint's stop, which is linear, it is far less.
inline double gap_rounding(const Contact& c, const Pair& pair) {
  if (pair.is_stop()) return 0;
  constexpr double eps = std::numeric_limits<double>::epsilon();
  // touch is 1e-10 of the size of what touches
  return 4 * eps * c.point_W.cwiseAbs().maxCoeff() + 1e-5 * pair.touch;
}

/// The bodies move so little in the arc that all of the row is linear in v.
bool is_still(const Scene& scene, const Contact& c, const Row& row, const Arc& arc);

/// What a row is at the node.
inline const Contact& contact_of(const Node& node, const Row& row) {
  return row.is_joint() ? node.dry[row.dry] : *row.contact;
}

/// Counts a joint with dry friction as sticking in its tree, where its impulse is below its bound
/// and its rate u is rounding: far below what the bound changes, by W.
void note_sticking(const Contact& joint, double p, double bound, double u, double W,
                   std::vector<int>& sticking);

/// A tree whose joints all stick stands still: its entries of x are 0, not rounding that would add
/// up to creep. @param sticking (trees) joints that do, see note_sticking
void still_trees(const Scene& scene, const std::vector<int>& sticking, VecX& x);

/// How many contacts push.
int count_pressed(const Rows& rows);

struct Memory;

/// A row for everything that rests at the node; active is what has friction, and what the arc
/// before pressed. None for an arc of no duration.
void make_rows(const Scene& scene, double tau, const Node& node, const Memory& memory, Rows& rows);

/// A contact that leaves, and does not from now on: it has a row that is solved for.
void rest_from_now(const Scene& scene, int contact, const Node& node, Rows& rows);

/// A pair that is open at the node, and would close in the arc so softly that it comes to rest
/// there: it has a row that is solved for, and closes by the arc's end. `c` is it at the node.
void rest_ahead(const Scene& scene, const Contact& c, const Node& node, Rows& rows);

/// Rows of pairs that the next arc presses join those it is solved with: their gap at the end of
/// the arc (q_end in s) is below where it may be.
/// @return true where there are some
bool press_rows(const Scene& scene, const VecX& q_end, const Node& node, Rows& rows, ArcScratch& s);

/// For an arc without a solution: one that holds the round end of a rod on two flush tables can
/// follow neither round its border, and one in which a can slaps down flat has no lowest point of
/// its rim to follow. All ends are held in the planes of their faces from now on, and all rims at
/// the point that they rest on.
/// @return false if they are already
bool level_held_ends(const Scene& scene, const Node& node, Rows& rows);

/// A rim whose lowest point went by more than a quarter of it in the arc has passed level, where
/// that point leaps to the other side: it is held at the point that it rests on from now on. The
/// arc that did so is no guess.
/// @return true where there is one
bool hold_rims_at_points(const Scene& scene, const VecX& q_end, const Node& node, Rows& rows,
                         ArcScratch& s);

/// Impulses of the rows for an arc of another duration.
void scale_impulses(double tau, Rows& rows);

/// No guess: where that of before leads to no arc.
void forget_impulses(Rows& rows);

}  // namespace saltus
