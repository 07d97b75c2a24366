// Rows: what contacts that rest at an arc's start may push in it, and how far.
//
// A row block is one contact with 1 rate and impulse along its normal, or 3 with friction. Over the
// arc the law (Signorini's, with Coulomb's) is asked of
//
//   u_n = (phi(q (+) tau v) - target) / tau,  u_t,   and p = (lambda, beta)
//
// Not all rows are solved for: a contact without friction that was not pressed in the arc before
// joins where the arc would press it. Then the law says who is pressed, sticks and slides.
//
// A sharp corner on a face is held in the plane that the face has at the arc's start, within its
// border and beyond; so is the end of a rod that slides lengthwise over a border. What bears there
// at the arc's end is another pair (edges that cross, a second table), and that rests from the next
// node on. Its rates are the chord of the corner over the arc, seen from the face's body, so that
// those of several corners of one body never contradict each other.
#pragma once

#include <array>
#include <vector>

#include "variational/arc/arc.hpp"
#include "variational/law/pile.hpp"
#include "variational/node/node.hpp"

namespace saltus {

struct Row {
  int contact = -1;            ///< its index in node.contacts, at the arc's start
  int place = -1;              ///< of its pair in the stepper's pool
  const Pair* pair = nullptr;  ///< likewise
  bool is_frozen = false;      ///< held in a plane of b: `frozen` is the pair
  Pair frozen;
  Vec3 point_B;              ///< in the frame of b's joint: the point that a frozen row starts at,
  std::array<Vec3, 2> t_B;   ///< and its tangents
  double target = 0;         ///< [m] lowest gap by the arc's end
  Vec3 p = Vec3::Zero();     ///< [N s] guess in, solution out; of what is not solved for 0
  bool is_active = false;    ///< solved for
  std::array<VecX, 3> rate;  ///< (n_v) du/dv, of the linearised arc; written if active
  std::array<VecX, 3> column;     ///< (n_v) J^-1 of the forces, which act at the arc's start
  Vec3 by_launch = Vec3::Zero();  ///< what each changes of the launch's impulse
  Contact closing;                ///< as it is at the arc's end

  const Pair& watched() const { return is_frozen ? frozen : *pair; }
};

/// What an impulse was in the last arc, for a guess.
struct ImpulseMemory {
  Vec3 p = Vec3::Zero();  ///< [N s] over `tau`
  double tau = 0;         ///< [s]
  int flight = -1;        ///< its number; an older one is no guess
};

struct Rows {
  Rows(const ModelData& model, bool with_friction);

  std::vector<Row> row;  ///< a pool; the first `count` are used
  int count = 0;
  std::vector<int> active;            ///< those that are solved for
  double tau = 0;                     ///< [s] the arc that their impulses are over
  double residual = 0;                ///< of Coulomb's law in the arc or half kick just solved
  std::vector<ImpulseMemory> memory;  ///< (pool of pairs)
  int flight = 0;                     ///< the number of this flight

  // scratch
  ContactBlocks W;  ///< of the active rows, or of those that the closing half kick is shared by
  std::vector<Vec3> u, p, before;
  PileScratch pile;
  VecX momentum;  ///< (n_v) the node's with all impulses, written by set_row_rates
  VecX size;      ///< (n_v) of all that is summed up in it, likewise
  std::vector<Contact*> closing;
  int deepest_chain = 0;  ///< joints between two bodies, at most
};

/// Number k of the rows that an arc is solved with.
inline Row& active_row(Rows& rows, std::size_t k) { return rows.row[rows.active[k]]; }

/// How many of them push.
int count_pressed(const Rows& rows);

/// A row for everything that rests at the node; active is what has friction, and what the arc
/// before pressed.
void make_rows(const ModelData& model, double tau, Node& node, Rows& rows);

/// A contact that leaves, and does not from now on: it has a row that is solved for.
void rest_from_now(const ModelData& model, int contact, Node& node, Rows& rows);

/// Rows of pairs that the next arc presses join those it is solved with: their gap at the end of
/// the arc (q_end in s) is below where it may be.
/// @return true where there are some
bool press_rows(const ModelData& model, const VecX& q_end, const Node& node, Rows& rows,
                ArcScratch& s);

/// The round end of a rod goes round the border of a face, if the rod lies along the border. One
/// that lies across it is borne by the border behind its end, which stays level: where the rod as a
/// whole sinks, though its ends do not, they are held in the plane of the face from now on.
/// @return true where one is that was not. A part of press_rows.
bool level_rods(const ModelData& model, const VecX& q_end, const Node& node, Rows& rows,
                ArcScratch& s);

/// For an arc without a solution: one that holds the round end of a rod on two flush tables can
/// follow neither round its border. All ends are held in the planes of their faces from now on.
/// @return false if they are already
bool level_held_ends(const ModelData& model, const Node& node, Rows& rows);

/// Impulses of the rows for an arc of another duration.
void scale_impulses(double tau, Rows& rows);

/// No guess: where that of before leads to no arc.
void forget_impulses(Rows& rows);

/// For the next flight's start.
void remember_impulses(Rows& rows);

/// No impulse of before is a guess, and none was pressed.
void forget_memory(Rows& rows);

/// The gap below which a pair that rests at the node is pressed: it may not sink any further.
double floor_of(const Node& node, int place);

}  // namespace saltus
